#include "app/editor/viewport/ViewSplitModel.h"

#include "app/editor/document/QtText.h"
#include "app/editor/viewport/ViewState.h"

namespace patina::editor {
namespace {

QString choiceName(const render::ViewChoice& choice) {
    const QString label = toQString(viewInfo(choice.kind).label);
    return choice.mode == render::ViewMode::Contribution
               ? SplitModel::tr("%1, contribution").arg(label)
               : label;
}

} // namespace

ViewSplitModel::ViewSplitModel(ViewState& views, QObject* parent)
    : SplitModel(parent)
    , m_views(views) {
    connect(&views, &ViewState::changed, this, &SplitModel::lineChanged);
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

QString ViewSplitModel::leftName() const {
    return choiceName(m_views.settings().shown);
}

QString ViewSplitModel::rightName() const {
    const auto& split = m_views.settings().split;
    return split ? choiceName(split->other) : QString();
}

} // namespace patina::editor
