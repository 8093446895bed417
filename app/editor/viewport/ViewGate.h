// Decides which view the next frame shows: the wanted one, or for a moment the last one, while the
// driver compiles what the wanted one needs. So no frame stalls because somebody looks at a term,
// or at the picture in another light.
#pragma once

#include "app/editor/viewport/ProgramWarmer.h"
#include "render/view/ViewSettings.h"

#include <QObject>
#include <QTimer>
#include <map>
#include <vector>

namespace patina::editor {

class DocumentController;

class ViewGate : public QObject {
    Q_OBJECT
  public:
    explicit ViewGate(DocumentController& controller, QObject* parent = nullptr);
    void setRenderer(const std::string& renderer) { m_warmer.setRenderer(renderer); }

    // What the next frame shows of what is wanted.
    [[nodiscard]] render::ViewSettings choose(const render::ViewSettings& wanted);
    // The last frame is not the view that was asked for: it is being compiled.
    [[nodiscard]] bool waiting() const { return m_waiting; }
    // Whether such frames can be drawn without a stall.
    [[nodiscard]] bool isOpen(const render::FrameKind& frame) const;
    [[nodiscard]] bool isOpenForSheets(ViewKind kind) const; // thumbnails of that view
    [[nodiscard]] bool isOpenForInspection() const;
    [[nodiscard]] bool compiling() const { return m_warmer.busy(); }
    // Somebody waits for thumbnails of these views, or for the explanation of a pixel.
    void prepareSheets(const std::vector<ViewKind>& kinds);
    void prepareInspection();
    // Whether cells of a wall that are drawn as these can be drawn without a stall; else they are
    // prepared. Cells that nobody asks for any more are dropped.
    [[nodiscard]] bool admitCells(const std::vector<render::FrameKind>& frames);
    void dropCells() { m_cellFrames.clear(); }
    // Nobody needs the processor: what may be looked at next is prepared.
    void rest();

  Q_SIGNALS:
    void opened();         // more can be drawn now
    void waitingChanged(); // waiting() is another

  private:
    void setWaiting(bool waiting);
    // For all who wait: the newest request of the warmer takes the place of those before.
    void prepareAwaited();
    [[nodiscard]] render::FrameKind inspection() const;
    [[nodiscard]] render::ViewSettings lastView() const;

    DocumentController& m_controller;
    ProgramWarmer m_warmer;
    QTimer m_limit;       // runs out when a view has been waited for too long
    bool m_passes = true; // nothing is held back: the limit is reached, or the document is new
    render::ViewSettings m_view;                       // of the last frame
    LightingMode m_lighting{};                         // of its document
    std::vector<render::FrameKind> m_drawn;            // what it was drawn as
    mutable std::map<render::FrameKind, bool> m_known; // what the warmer says of this document
    bool m_waiting = false;
    std::vector<render::FrameKind> m_sheetFrames; // that somebody waits for
    std::vector<render::FrameKind> m_cellFrames;  // likewise
    bool m_inspectionAwaited = false;
};

} // namespace patina::editor
