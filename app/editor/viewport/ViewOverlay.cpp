#include "app/editor/viewport/ViewOverlay.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/viewport/ViewLegend.h"
#include "app/editor/viewport/ViewSplitModel.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/wall/WallState.h"

#include <QEvent>

namespace patina::editor {

ViewOverlay::ViewOverlay(ViewState& views, const TracedSide& traced, DocumentController& controller,
                         const WallState& wall, QWidget& viewport)
    : QObject(&viewport)
    , m_views(views)
    , m_wall(wall)
    , m_viewport(viewport)
    , m_split(new SplitHandle(*new ViewSplitModel(views, traced, this), viewport))
    , m_shown(new ViewLegend(views, controller, ViewSide::Shown, &viewport))
    , m_other(new ViewLegend(views, controller, ViewSide::Other, &viewport)) {
    for (ViewLegend* legend : {m_shown, m_other}) {
        connect(legend, &ViewLegend::changed, this, &ViewOverlay::place);
        connect(legend, &ViewLegend::remedyWanted, this, &ViewOverlay::remedyWanted);
    }
    connect(&wall, &WallState::changed, this, &ViewOverlay::place);
    connect(&wall, &WallState::cellsChosen, this, &ViewOverlay::place);
    viewport.installEventFilter(this);
    place();
}

bool ViewOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        place();
    return false;
}

void ViewOverlay::place() {
    const int margin = tokens::kMargin;
    // Over the cells of a wall it is in the way unless the colours need it to be read.
    const bool cells = m_wall.isOn() && !m_wall.enlarged();
    for (ViewLegend* legend : {m_shown, m_other}) {
        legend->setVisible(legend->isWanted() && !(cells && legend->isOnlyANote()));
        legend->adjustSize(); // the content may be new
    }
    const auto& split = m_views.settings().split;
    const bool swapped = split && SplitLine(*split, m_viewport.size()).right.x() < -1e-3;
    ViewLegend* left = swapped ? m_other : m_shown;
    ViewLegend* right = swapped ? m_shown : m_other;
    left->move(margin, margin);
    // In a narrow viewport they lie in opposite corners.
    const bool beside = left->width() + right->width() + 3 * margin <= m_viewport.width();
    right->move(m_viewport.width() - right->width() - margin,
                beside ? margin : m_viewport.height() - right->height() - margin);
}

} // namespace patina::editor
