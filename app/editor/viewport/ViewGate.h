// Decides which view the next frame shows: the wanted one, or for a moment the last one, while the
// driver compiles what the wanted one needs. So no frame stalls because somebody looks at a term.
#pragma once

#include "app/editor/viewport/ProgramWarmer.h"
#include "render/view/ViewSettings.h"

#include <QObject>
#include <QTimer>

namespace patina::editor {

class DocumentController;

class ViewGate : public QObject {
    Q_OBJECT
  public:
    explicit ViewGate(DocumentController& controller, QObject* parent = nullptr);

    // What the next frame shows of what is wanted.
    [[nodiscard]] render::ViewSettings choose(const render::ViewSettings& wanted);
    // The last frame is not the view that was asked for: it is being compiled.
    [[nodiscard]] bool waiting() const { return m_waiting; }
    // Whether frames of that kind can be drawn without a stall.
    [[nodiscard]] bool isOpen(render::SurfaceOutput output) const;
    [[nodiscard]] bool compiling() const { return m_warmer.busy(); }
    // Somebody waits for such frames.
    void prepare(render::SurfaceOutput output);
    // Nobody needs the processor: what may be looked at next is prepared.
    void rest();

  Q_SIGNALS:
    void opened();         // more can be drawn now
    void waitingChanged(); // waiting() is another

  private:
    void setWaiting(bool waiting);

    DocumentController& m_controller;
    ProgramWarmer m_warmer;
    QTimer m_limit;              // runs out when a view has been waited for too long
    bool m_passes = false;       // nothing is held back: the limit is reached
    render::ViewSettings m_view; // of the last frame
    bool m_waiting = false;
};

} // namespace patina::editor
