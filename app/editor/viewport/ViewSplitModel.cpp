#include "app/editor/viewport/ViewSplitModel.h"

#include "app/editor/document/QtText.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/viewport/ViewState.h"

#include <utility>

namespace patina::editor {
namespace {

QString choiceName(const render::ViewChoice& choice) {
    const QString label = toQString(viewInfo(choice.kind).label);
    return choice.mode == render::ViewMode::Contribution
               ? SplitModel::tr("%1, contribution").arg(label)
               : label;
}

} // namespace

ViewSplitModel::ViewSplitModel(ViewState& views, const TracedSide& traced, QObject* parent)
    : SplitModel(parent)
    , m_views(views)
    , m_traced(traced) {
    connect(&views, &ViewState::changed, this, &SplitModel::lineChanged);
    connect(&traced, &TracedSide::changed, this, &SplitModel::lineChanged);
    connect(&traced.paths(), &PathView::changed, this, [this] {
        if (std::exchange(m_whitted, m_traced.paths().isWhitted()) != m_whitted)
            Q_EMIT lineChanged();
    });
}

std::optional<render::ViewSplit> ViewSplitModel::line() const {
    return m_views.settings().split;
}

// Keys may have changed what is shown during a drag; only the line moves.
void ViewSplitModel::moveLine(const render::ViewSplit& line) {
    m_views.edit([&](render::ViewSettings& settings) {
        if (!settings.split)
            return;
        settings.split->position = line.position;
        settings.split->angleDeg = line.angleDeg;
    });
}

void ViewSplitModel::removeLine() {
    if (m_views.settings().split)
        m_views.toggleSplit();
}

QString ViewSplitModel::nameOf(const render::ViewChoice& choice, ViewSide side) const {
    const QString name = choiceName(choice);
    if (!m_traced.side() || !m_views.settings().isOrdinary(choice))
        return name;
    if (m_traced.side() != side)
        return tr("%1, as drawn").arg(name);
    return m_traced.paths().isWhitted() ? tr("%1, Whitted").arg(name)
                                        : tr("%1, path traced").arg(name);
}

QString ViewSplitModel::leftName() const {
    return nameOf(m_views.settings().shown, ViewSide::Shown);
}

QString ViewSplitModel::rightName() const {
    const auto& split = m_views.settings().split;
    return split ? nameOf(split->other, ViewSide::Other) : QString();
}

} // namespace patina::editor
