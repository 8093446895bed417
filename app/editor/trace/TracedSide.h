// Where the traced picture is shown: in the whole viewport, or on one side of the split beside what
// the viewport draws on the other.
#pragma once

#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/ViewState.h"
#include "render/view/ViewSettings.h"

#include <QObject>
#include <optional>

class QWidget;

namespace patina::editor {

class PathError;
class WhittedHeat;

class TracedSide : public QObject {
    Q_OBJECT
  public:
    TracedSide(ViewState& views, PathView& paths, PathError& error, WhittedHeat& heat,
               QObject* parent = nullptr);

    void setViewport(QWidget& viewport); // where the pointer is in it says which side is meant

    // What a tracer's key does. Without a split: on, or off. With one, for the side that the
    // pointer is on (away from the picture: the traced one, or the right one): on, over to there,
    // or off. The side shows the picture then, and afterwards the view that it had before.
    void toggle(TracedBy tracer);

    // The side that is traced; nothing: no tracer is on, or there is no split.
    [[nodiscard]] std::optional<ViewSide> side() const;
    // What it stands in place of is the ordinary picture, not another view.
    [[nodiscard]] bool showsPicture() const;
    // The tracer that the whole picture is by; nothing: the viewport draws it, or a side of it.
    [[nodiscard]] std::optional<TracedBy> wholeBy() const;
    // And there is a traced one.
    [[nodiscard]] bool isShown() const;
    // What the viewport itself is to draw: the other side alone where one shows the traced picture.
    [[nodiscard]] render::ViewSettings drawn(const render::ViewSettings& chosen) const;
    // Of the right side of the line, as Presentation::split wants it, for side().
    [[nodiscard]] render::ViewSplit line() const;
    [[nodiscard]] const PathView& paths() const { return m_paths; }
    [[nodiscard]] const ViewState& views() const { return m_views; }

  Q_SIGNALS:
    void changed(); // side() or wholeBy()

  private:
    void follow();
    void end();
    void restoreView();
    [[nodiscard]] ViewSide meant() const;
    [[nodiscard]] const render::ViewChoice& choiceOf(ViewSide side) const;

    ViewState& m_views;
    PathView& m_paths;
    PathError& m_error;
    WhittedHeat& m_heat;
    QWidget* m_viewport = nullptr;
    ViewSide m_side = ViewSide::Shown;   // of a split; without one it is the whole
    std::optional<ViewKind> m_before;    // what that side showed before it was traced
    std::optional<ViewSide> m_announced; // side() at the last changed()
    std::optional<TracedBy> m_announcedWhole;
};

} // namespace patina::editor
