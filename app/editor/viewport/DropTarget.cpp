#include "app/editor/viewport/DropTarget.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/DraggedSources.h"
#include "app/editor/document/DropPlan.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/style/Tokens.h"
#include "core/edit/EditSession.h"

#include <QDragEnterEvent>
#include <QMimeData>
#include <QPainter>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kTargetFrame = 3; // round the target
constexpr int kMostLines = 12;  // of a folder full of files
constexpr int kVeilAlpha = 150; // over the picture, of 255

} // namespace

DropHint::DropHint(QWidget& viewport)
    : QWidget(&viewport) {
    setObjectName(QStringLiteral("dropHint"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
}

void DropHint::setLines(const QStringList& lines, const QRect& target, bool veiled) {
    m_lines = lines;
    m_veiled = veiled;
    m_target = target;
    setAccessibleName(m_lines.join(QLatin1Char('\n')));
    setVisible(!m_lines.isEmpty());
    if (m_lines.isEmpty())
        return;
    setGeometry(parentWidget()->rect());
    raise();
    update();
}

void DropHint::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    QColor veil(tokens::kWell);
    veil.setAlpha(kVeilAlpha);
    if (m_veiled)
        painter.fillRect(rect(), veil);
    const QRect target = m_target.isNull() ? rect() : m_target;
    painter.setPen(QPen(QColor(tokens::kAccent), kTargetFrame));
    painter.drawRect(target.adjusted(kTargetFrame / 2, kTargetFrame / 2, -kTargetFrame / 2 - 1,
                                     -kTargetFrame / 2 - 1));

    QStringList shown = m_lines.mid(0, kMostLines);
    if (m_lines.size() > kMostLines)
        shown << tr("… and %1 more").arg(m_lines.size() - kMostLines);
    const int line = fontMetrics().lineSpacing() + 2, margin = tokens::kMargin;
    int widest = 0;
    for (QString& text : shown) {
        text = fontMetrics().elidedText(text, Qt::ElideMiddle, width() - 4 * margin);
        widest = std::max(widest, fontMetrics().horizontalAdvance(text));
    }
    QRect box(0, 0, widest + 2 * margin, static_cast<int>(shown.size()) * line + 2 * margin);
    box.moveCenter(target.center());
    if (!m_target.isNull()) // beside the picture that hangs from the pointer
        box.moveTop(target.top() + margin);
    const QRect room = rect().adjusted(margin, margin, -margin, -margin);
    box.moveLeft(std::clamp(box.left(), room.left(), std::max(room.right() - box.width(), 0)));
    box.moveTop(std::clamp(box.top(), room.top(), std::max(room.bottom() - box.height(), 0)));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kPanel));
    painter.drawRoundedRect(box, tokens::kRadius, tokens::kRadius);
    painter.setPen(QColor(tokens::kText));
    int y = box.top() + margin;
    for (const QString& text : shown) {
        painter.drawText(QRect(box.left() + margin, y, widest, line),
                         Qt::AlignLeft | Qt::AlignVCenter, text);
        y += line;
    }
}

DropTarget::DropTarget(QWidget& window, QWidget& viewport, DocumentController& controller,
                       SelectionModel& selection, const WallDrop& wall, const ElementDrop& elements)
    : QObject(&window)
    , m_window(window)
    , m_viewport(viewport)
    , m_controller(controller)
    , m_selection(selection)
    , m_wall(wall)
    , m_elements(elements)
    , m_hint(new DropHint(viewport)) {
    window.installEventFilter(this);
}

bool DropTarget::takeElements(QDropEvent& event) {
    const auto elements = draggedElements(*event.mimeData(), m_controller.session());
    if (!elements)
        return false;
    const ElementDropPlan plan = m_elements.plan(*elements, inViewport(event.position()));
    const bool taken = !plan.parts.empty();
    event.setDropAction(taken ? Qt::CopyAction : Qt::IgnoreAction);
    event.setAccepted(taken || event.type() == QEvent::DragEnter); // moves are to follow
    if (event.type() != QEvent::Drop) {
        m_hint->setLines(plan.lines, plan.area, false);
        return true;
    }
    m_hint->setLines({});
    m_elements.drop(elements->element, plan);
    return true;
}

bool DropTarget::eventFilter(QObject*, QEvent* event) {
    switch (event->type()) {
    case QEvent::DragEnter:
    case QEvent::DragMove: {
        if (takeElements(*static_cast<QDropEvent*>(event)))
            return true;
        const auto* drag = static_cast<QDragMoveEvent*>(event); // which entering is, too
        showHint(draggedSources(*drag->mimeData()), drag->position());
        break;
    }
    case QEvent::Drop:
        if (takeElements(*static_cast<QDropEvent*>(event)))
            return true;
        m_hint->setLines({});
        break;
    case QEvent::DragLeave:
        m_hint->setLines({});
        break;
    default:
        break;
    }
    return false; // the window takes or refuses it
}

QPointF DropTarget::inViewport(const QPointF& position) const {
    return m_viewport.mapFrom(&m_window, position);
}

void DropTarget::showHint(const QStringList& files, const QPointF& position) {
    const WallDropPlan plan = m_wall.plan(files, inViewport(position));
    if (plan.parts.empty())
        m_hint->setLines(planDrop(files).lines(m_controller.document(), m_selection.material()));
    else
        m_hint->setLines(plan.lines, plan.area);
}

bool DropTarget::drop(const QStringList& files, const QPointF& position) {
    const WallDropPlan plan = m_wall.plan(files, inViewport(position));
    m_wall.drop(plan);
    return !plan.parts.empty();
}

} // namespace patina::editor
