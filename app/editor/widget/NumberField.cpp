#include "app/editor/widget/NumberField.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/Arithmetic.h"
#include "app/editor/widget/StatusHint.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QStyle>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kPixelsPerRange = 300; // a drag over the soft range
constexpr int kClickSlop = 3;           // pixels a click may wander
constexpr int kTenthsNormal = 10, kTenthsFine = 1, kTenthsCoarse = 100;

int tenths(Qt::KeyboardModifiers modifiers) {
    if (modifiers & Qt::ShiftModifier)
        return kTenthsFine;
    return modifiers & Qt::ControlModifier ? kTenthsCoarse : kTenthsNormal;
}

bool startsNumber(const QKeyEvent& event) {
    const QString text = event.text();
    return !text.isEmpty() && !(event.modifiers() & (Qt::ControlModifier | Qt::AltModifier)) &&
           (text[0].isDigit() || QStringLiteral("-+.,(").contains(text[0]));
}

// A hundredth of the range, as a round number: 1, 2 or 5 times a power of ten.
double roundStep(double range) {
    const double raw = range / 100;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double digit = raw / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

} // namespace

NumberField::NumberField(const NumberFormat& format, QWidget* parent)
    : QLineEdit(parent)
    , m_format(format) {
    setReadOnly(true);
    setCursor(Qt::SizeHorCursor);
    setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setFixedHeight(tokens::kRowHeight - 2);
    setContextMenuPolicy(Qt::NoContextMenu);
    showValue();
    connect(this, &QLineEdit::textEdited, this, [this] { markRefused(false); });
}

void NumberField::setValue(double value) {
    m_value = value;
    if (m_mode != Mode::Editing)
        showValue();
}

void NumberField::setUnit(const QString& unit) {
    m_format.unit = unit;
    if (m_mode != Mode::Editing)
        showValue();
}

void NumberField::setFormat(const NumberFormat& format) {
    m_format = format;
    if (m_mode != Mode::Editing)
        showValue();
}

void NumberField::showValue() {
    const QString name = m_format.name ? m_format.name(m_value) : QString();
    setText(name.isEmpty() ? format(m_value, m_format.decimals) + m_format.unit : name);
    setCursorPosition(0);
}

QString NumberField::format(double value, int decimals) {
    QString text = QString::number(value, 'f', decimals);
    // "-0.000" is zero.
    if (text.startsWith(QLatin1Char('-')) && text.toDouble() == 0)
        text.remove(0, 1);
    // Three decimals for small steps, but no trailing zeros beyond the first one.
    if (decimals > 1)
        while (text.endsWith(QLatin1Char('0')) && !text.endsWith(QLatin1String(".0")) &&
               text.size() - text.indexOf(QLatin1Char('.')) > 3)
            text.chop(1);
    return text;
}

std::optional<double> NumberField::parse(const QString& text, const QString& unit) {
    QString number = text.trimmed();
    if (!unit.trimmed().isEmpty() && number.endsWith(unit.trimmed(), Qt::CaseInsensitive))
        number.chop(unit.trimmed().size());
    return evaluate(number);
}

double NumberField::bounded(double value) const {
    const double power = std::pow(10.0, m_format.decimals);
    value = std::round(value * power) / power;
    const double span = m_format.hardMax - m_format.hardMin;
    if (m_format.wraps && (value < m_format.hardMin || value > m_format.hardMax))
        return value - span * std::floor((value - m_format.hardMin) / span);
    return std::clamp(value, m_format.hardMin, m_format.hardMax);
}

// --- Mouse ---------------------------------------------------------------------------------------

void NumberField::mousePressEvent(QMouseEvent* event) {
    if (m_mode == Mode::Editing || event->button() != Qt::LeftButton) {
        QLineEdit::mousePressEvent(event);
        return;
    }
    m_mode = Mode::Pressed;
    m_lastX = qRound(event->globalPosition().x());
    m_scrubOffset = 0;
    m_scrubStart = m_value;
    event->accept();
}

void NumberField::mouseMoveEvent(QMouseEvent* event) {
    const int x = qRound(event->globalPosition().x());
    if (m_mode == Mode::Pressed && std::abs(x - m_lastX) >= kClickSlop) {
        m_mode = Mode::Scrubbing;
        Q_EMIT dragStarted();
    }
    if (m_mode == Mode::Scrubbing) {
        scrubBy(x - m_lastX, event->modifiers());
        m_lastX = x;
    } else if (m_mode == Mode::Editing) {
        QLineEdit::mouseMoveEvent(event);
    }
}

void NumberField::scrubBy(int pixels, Qt::KeyboardModifiers modifiers) {
    m_scrubOffset += qint64{pixels} * tenths(modifiers);
    const double perTenth = (m_format.softMax - m_format.softMin) / kPixelsPerRange / 10;
    const double value =
        m_scrubOffset == 0 ? m_scrubStart
                           : bounded(m_scrubStart + static_cast<double>(m_scrubOffset) * perTenth);
    setValue(value);
    Q_EMIT dragged(value);
}

void NumberField::finishScrub() {
    m_mode = Mode::Idle;
    Q_EMIT dragFinished();
}

void NumberField::mouseReleaseEvent(QMouseEvent* event) {
    if (m_mode == Mode::Scrubbing)
        finishScrub();
    else if (m_mode == Mode::Pressed)
        beginEditing();
    else if (m_mode == Mode::Editing)
        QLineEdit::mouseReleaseEvent(event);
}

void NumberField::mouseDoubleClickEvent(QMouseEvent* event) {
    if (m_mode == Mode::Editing)
        selectAll();
    else
        mousePressEvent(event);
}

void NumberField::wheelEvent(QWheelEvent* event) {
    if (!hasFocus()) {
        event->ignore(); // the panel scrolls
        return;
    }
    // Alt and Ctrl may turn the wheel's axis.
    const QPoint angle = event->angleDelta();
    step((angle.y() != 0 ? angle.y() : angle.x()) / 120.0, event->modifiers());
    event->accept();
}

// --- Keys ----------------------------------------------------------------------------------------

void NumberField::step(double steps, Qt::KeyboardModifiers modifiers) {
    endEditing(true);
    const double size =
        roundStep(m_format.softMax - m_format.softMin) * tenths(modifiers) / double{kTenthsNormal};
    const double smallest = std::pow(10.0, -m_format.decimals);
    const double value = bounded(m_value + steps * std::max(size, smallest));
    if (value == m_value)
        return;
    setValue(value);
    Q_EMIT stepped(value);
}

bool NumberField::event(QEvent* event) {
    // Keys that end a scrub or an entry, or begin one, must not trigger shortcuts of the window.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        const bool ends = m_mode != Mode::Idle && key.key() == Qt::Key_Escape;
        if (ends || startsNumber(key)) {
            event->accept();
            return true;
        }
    }
    return QLineEdit::event(event);
}

void NumberField::keyPressEvent(QKeyEvent* event) {
    const int key = event->key();
    if (key == Qt::Key_Up || key == Qt::Key_Down) {
        step(key == Qt::Key_Up ? 1 : -1, event->modifiers());
        return;
    }
    switch (m_mode) {
    case Mode::Scrubbing:
        if (key == Qt::Key_Escape) {
            setValue(m_scrubStart);
            Q_EMIT dragged(m_scrubStart);
            finishScrub();
        }
        return;
    case Mode::Editing:
        if (key == Qt::Key_Return || key == Qt::Key_Enter)
            enter();
        else if (key == Qt::Key_Escape)
            endEditing(false);
        else
            QLineEdit::keyPressEvent(event);
        return;
    case Mode::Idle:
    case Mode::Pressed:
        break;
    }
    if (key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_F2) {
        beginEditing();
    } else if (startsNumber(*event)) {
        beginEditing();
        QLineEdit::keyPressEvent(event);
    } else {
        event->ignore();
    }
}

void NumberField::beginEditing() {
    m_mode = Mode::Editing;
    qApp->installEventFilter(this);
    setReadOnly(false);
    setCursor(Qt::IBeamCursor);
    // The whole value, not the rounded one on display.
    setText(QString::number(static_cast<float>(m_value), 'g', 7));
    selectAll();
}

void NumberField::endEditing(bool accept) {
    if (m_mode != Mode::Editing)
        return;
    const QString entered = isModified() ? text() : QString();
    const std::optional<double> typed = parse(entered, m_format.unit);
    leaveEditing();
    if (accept && typed) {
        // Typed values keep the digits that were typed.
        const double value = std::clamp(*typed, m_format.hardMin, m_format.hardMax);
        const double span = m_format.hardMax - m_format.hardMin;
        m_value = m_format.wraps && value != *typed
                      ? *typed - span * std::floor((*typed - m_format.hardMin) / span)
                      : value;
        showValue();
        Q_EMIT edited(m_value);
    } else {
        showValue();
        if (accept && !entered.trimmed().isEmpty())
            showHint(*this, tr("“%1” is not a number. The value is still %2").arg(entered, text()));
    }
}

void NumberField::leaveEditing() {
    m_mode = Mode::Idle;
    qApp->removeEventFilter(this);
    markRefused(false);
    setReadOnly(true);
    setCursor(Qt::SizeHorCursor);
    deselect();
}

void NumberField::enter() {
    if (isModified() && !text().trimmed().isEmpty() && !parse(text(), m_format.unit)) {
        markRefused(true);
        showHint(*this, tr("“%1” is not a number. Type a number or a sum like 1/3 or "
                           "2*(0.5+1); Esc restores the value")
                            .arg(text()));
        return;
    }
    endEditing(true);
}

void NumberField::markRefused(bool refused) {
    if (refused == m_refused)
        return;
    m_refused = refused;
    setProperty("refused", refused); // in the style sheet
    style()->unpolish(this);
    style()->polish(this);
}

void NumberField::abandonEdit() {
    if (m_mode == Mode::Editing)
        leaveEditing();
    m_mode = Mode::Idle; // of a scrub, too
    showValue();
}

// While it is being typed into: whoever clicks elsewhere, or gives a command by its shortcut, means
// the number that is there, whether or not the focus goes.
bool NumberField::eventFilter(QObject* watched, QEvent* event) {
    if (watched != this &&
        ((event->type() == QEvent::MouseButtonPress && watched->isWidgetType()) ||
         event->type() == QEvent::Shortcut))
        endEditing(true);
    return QLineEdit::eventFilter(watched, event);
}

void NumberField::focusInEvent(QFocusEvent* event) {
    QLineEdit::focusInEvent(event);
    if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason)
        beginEditing();
}

void NumberField::focusOutEvent(QFocusEvent* event) {
    endEditing(true);
    QLineEdit::focusOutEvent(event);
}

} // namespace patina::editor
