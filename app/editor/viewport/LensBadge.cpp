#include "app/editor/viewport/LensBadge.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/viewport/SplitHandle.h"
#include "core/document/Document.h"
#include "core/document/Views.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <algorithm>

namespace patina::editor {
namespace {

// Numbers of the surface that the middle of the lens sees have no mean.
bool isOfNumbers(const render::ViewChoice& choice) {
    return choice.mode == render::ViewMode::Raw && !viewInfo(choice.kind).exposed;
}

} // namespace

LensBadge::LensBadge(DocumentController& controller, const TracedSide& traced,
                     ViewportWidget& viewport)
    : QFrame(&viewport)
    , m_controller(controller)
    , m_traced(traced)
    , m_viewport(viewport)
    , m_text(new QLabel) {
    setObjectName(QStringLiteral("lensBadge"));
    setProperty("overlay", true);
    setAttribute(Qt::WA_TransparentForMouseEvents);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, tokens::kGap);
    row->addWidget(m_text);
    hide();
    viewport.installEventFilter(this);
    connect(&viewport, &ViewportWidget::frameRendered, this, [this](double, PictureState state) {
        m_state = state;
        refresh();
    });
    connect(&controller, &DocumentController::changed, this, &LensBadge::refresh);
    connect(&traced.views(), &ViewState::changed, this, &LensBadge::refresh);
    connect(&traced.paths(), &PathView::changed, this, &LensBadge::refresh);
    connect(&traced, &TracedSide::changed, this, &LensBadge::refresh);
}

QString LensBadge::text() const {
    if (m_controller.document().view.camera.lensRadius() <= 0.0f || m_viewport.showsWall() ||
        (m_traced.isShown() && !m_traced.side())) // which is seen through the lens
        return {};
    const render::ViewSettings drawn = m_traced.drawn(m_traced.views().settings());
    const bool numbers = isOfNumbers(drawn.shown),
               numbersBeside = drawn.split && isOfNumbers(drawn.split->other);
    if (numbers && (!drawn.split || numbersBeside))
        return tr("No depth of field in this view: drawn through a pinhole");
    if (m_state == PictureState::Moving)
        return tr("Pinhole during interaction: depth of field follows at rest");
    if (numbers || numbersBeside)
        return tr("Depth of field in the picture alone, not in the view beside it");
    return {};
}

void LensBadge::refresh() {
    const QString now = text();
    if (now == m_text->text() && isVisible() == !now.isEmpty())
        return;
    m_text->setText(now);
    setAccessibleName(now.isEmpty() ? tr("Depth of field") : now);
    setVisible(!now.isEmpty());
    if (!now.isEmpty())
        place();
}

// At the lower right, or at the lower left where the traced side's badge is.
void LensBadge::place() {
    adjustSize();
    const auto& split = m_traced.views().settings().split;
    const bool tracedIsRight = m_traced.side() && split &&
                               (SplitLine(*split, m_viewport.size()).right.x() >= 0.0) ==
                                   (m_traced.side() == ViewSide::Other);
    const int right = m_viewport.width() - width() - tokens::kMargin;
    move(tracedIsRight ? tokens::kMargin : std::max(right, tokens::kMargin),
         m_viewport.height() - height() - tokens::kMargin);
    raise();
}

bool LensBadge::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible())
        place();
    return false;
}

} // namespace patina::editor
