#include "app/editor/trace/TracedSide.h"

#include "app/editor/trace/PathError.h"
#include "app/editor/trace/WhittedHeat.h"
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/viewport/ViewState.h"

#include <QCursor>
#include <QWidget>
#include <utility>

namespace patina::editor {
namespace {

const render::ViewChoice& choiceOn(const render::ViewSettings& settings, ViewSide side) {
    return side == ViewSide::Other && settings.split ? settings.split->other : settings.shown;
}

} // namespace

TracedSide::TracedSide(ViewState& views, PathView& paths, PathError& error, WhittedHeat& heat,
                       QObject* parent)
    : QObject(parent)
    , m_views(views)
    , m_paths(paths)
    , m_error(error)
    , m_heat(heat) {
    connect(&views, &ViewState::changed, this, &TracedSide::follow);
    connect(&paths, &PathView::changed, this, &TracedSide::follow);
}

void TracedSide::setViewport(QWidget& viewport) {
    m_viewport = &viewport;
}

const render::ViewChoice& TracedSide::choiceOf(ViewSide side) const {
    return choiceOn(m_views.settings(), side);
}

std::optional<ViewSide> TracedSide::side() const {
    return m_paths.isOn() && m_views.settings().split ? std::optional(m_side) : std::nullopt;
}

bool TracedSide::showsPicture() const {
    return m_views.settings().isOrdinary(choiceOf(m_side));
}

std::optional<TracedBy> TracedSide::wholeBy() const {
    return m_paths.isOn() && !m_views.settings().split && showsPicture()
               ? std::optional(m_paths.tracer())
               : std::nullopt;
}

bool TracedSide::isShown() const {
    return m_paths.isOn() && m_paths.picture() != nullptr && showsPicture();
}

render::ViewSettings TracedSide::drawn(const render::ViewSettings& chosen) const {
    render::ViewSettings settings = chosen;
    if (!side() || !isShown())
        return settings;
    if (m_side == ViewSide::Shown)
        settings.shown = chosen.split->other;
    settings.split.reset();
    return settings;
}

render::ViewSplit TracedSide::line() const {
    render::ViewSplit line = m_views.settings().split.value_or(render::ViewSplit());
    if (m_side == ViewSide::Shown)
        line.angleDeg += 180.0f;
    return line;
}

ViewSide TracedSide::meant() const {
    const auto& split = m_views.settings().split;
    if (!split)
        return ViewSide::Shown;
    // Legends lie over it, so that its own mouse events do not tell.
    if (m_viewport != nullptr)
        if (const QPoint pointer = m_viewport->mapFromGlobal(QCursor::pos());
            m_viewport->rect().contains(pointer))
            return SplitLine(*split, m_viewport->size()).distance(pointer) > 0.0 ? ViewSide::Other
                                                                                 : ViewSide::Shown;
    return m_paths.isOn() ? m_side : ViewSide::Other;
}

void TracedSide::toggle(TracedBy tracer) {
    const ViewSide side = meant();
    if (m_paths.isOn() && side == m_side && m_paths.tracer() == tracer) {
        end();
        return;
    }
    if (!m_paths.isOn() || side != m_side) {
        restoreView();
        m_side = side;
        if (m_views.settings().split && !m_views.settings().isOrdinary(choiceOf(side))) {
            m_before = choiceOf(side).kind;
            if (side == ViewSide::Shown)
                m_views.show(shading::kViewFinal);
            else
                m_views.showOther(shading::kViewFinal);
        }
    }
    m_paths.setTracer(tracer);
    m_paths.setOn(true);
    follow();
}

void TracedSide::restoreView() {
    const std::optional<ViewKind> before = std::exchange(m_before, std::nullopt);
    // Something else has been chosen meanwhile, or there is no such side any more.
    if (!before || !m_views.settings().split || choiceOf(m_side).kind != shading::kViewFinal)
        return;
    if (m_side == ViewSide::Shown)
        m_views.show(*before);
    else
        m_views.showOther(*before);
}

// Two sides that show the same are none.
void TracedSide::end() {
    m_paths.setOn(false);
    restoreView();
    const render::ViewSettings& settings = m_views.settings();
    if (settings.split && settings.split->other == settings.shown)
        m_views.toggleSplit();
}

void TracedSide::follow() {
    if (!m_views.settings().split) {
        m_before.reset();
        // What is left of the line stays.
        if (std::exchange(m_side, ViewSide::Shown) == ViewSide::Other)
            m_paths.setOn(false);
    }
    m_views.setTraced(m_paths.isOn());
    const std::optional<ViewSide> now = side();
    if (now) { // these cover the whole picture
        m_error.setShown(PathPicture::Traced);
        m_heat.setShown(std::nullopt);
        m_heat.setLevel(std::nullopt);
    }
    const std::optional<TracedBy> whole = wholeBy();
    const bool otherSide = std::exchange(m_announced, now) != now;
    if (std::exchange(m_announcedWhole, whole) != whole || otherSide)
        Q_EMIT changed();
}

} // namespace patina::editor
