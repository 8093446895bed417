#include "app/editor/wall/WallOverlay.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/wall/WallState.h"

#include <QKeyEvent>
#include <QPainter>
#include <QStringList>

namespace patina::editor {
namespace {

constexpr int kFrame = 2;

} // namespace

WallOverlay::WallOverlay(WallState& wall, QWidget& viewport)
    : QWidget(&viewport)
    , m_wall(wall)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("wallOverlay"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
    viewport.installEventFilter(this);
    connect(&wall, &WallState::changed, this, &WallOverlay::follow);
    connect(&wall, &WallState::cellsChosen, this, &WallOverlay::follow);
    connect(&wall, &WallState::textsChanged, this, qOverload<>(&QWidget::update));
}

void WallOverlay::follow() {
    setVisible(m_wall.isOn());
    setGeometry(m_viewport.rect());
    m_layout = WallLayout::of(m_wall, size(), m_viewport.fontMetrics());
    QStringList captions;
    for (const WallLayout::Caption& caption : m_layout.captions)
        captions << caption.text;
    setAccessibleName(tr("Wall"));
    setAccessibleDescription(m_wall.problem().isEmpty() ? captions.join(QStringLiteral(", "))
                                                        : m_wall.problem());
    update();
}

bool WallOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        follow();
    if (event->type() == QEvent::KeyPress && m_wall.isOn()) {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
        return plain && pressKey(key->key());
    }
    return false;
}

bool WallOverlay::pressKey(int key) {
    switch (key) {
    case Qt::Key_Left:
        m_wall.moveCurrent(-1, 0);
        return true;
    case Qt::Key_Right:
        m_wall.moveCurrent(1, 0);
        return true;
    case Qt::Key_Up:
        m_wall.moveCurrent(0, -1);
        return true;
    case Qt::Key_Down:
        m_wall.moveCurrent(0, 1);
        return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
        m_wall.enlarge(m_wall.enlarged() ? std::nullopt : m_wall.current());
        return true;
    default:
        return false;
    }
}

void WallOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto say = [&](const QRect& place, const QString& text) {
        painter.fillRect(place, QColor(tokens::kWell));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(place.adjusted(tokens::kGap, 0, -tokens::kGap, 0),
                         Qt::AlignCenter | Qt::TextWordWrap, text);
    };
    if (m_layout.cells.empty())
        say(rect(), m_wall.problem());
    for (const WallLayout::Caption& caption : m_layout.captions) {
        painter.setPen(QColor(tokens::kText));
        painter.drawText(
            caption.place, static_cast<int>(caption.alignment),
            fontMetrics().elidedText(caption.text, Qt::ElideMiddle, caption.place.width()));
    }
    for (std::size_t i = 0; i < m_layout.cells.size(); ++i)
        if (const QString text = m_wall.text(i); !text.isEmpty() && !m_layout.cells[i].isNull())
            say(m_layout.cells[i], text);
    const auto current = m_wall.current();
    if (current && *current < m_layout.cells.size() && !m_wall.enlarged()) {
        painter.setPen(QPen(QColor(tokens::kAccent), kFrame));
        painter.drawRect(m_layout.cells[*current].adjusted(1, 1, -1, -1));
    }
}

} // namespace patina::editor
