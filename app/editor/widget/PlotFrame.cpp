#include "app/editor/widget/PlotFrame.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"

#include <QClipboard>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kPad = 6.0;
constexpr double kScale = 8.0; // width of a bar of colours
constexpr int kLow = 170;      // pixels; a plot below this height has fewer numbers

QPoint wayOf(int key) {
    switch (key) {
    case Qt::Key_Left:
        return {-1, 0};
    case Qt::Key_Right:
        return {1, 0};
    case Qt::Key_Up:
        return {0, 1};
    case Qt::Key_Down:
        return {0, -1};
    default:
        return {};
    }
}

double& along(QPointF& place, int axis) {
    return axis == 0 ? place.rx() : place.ry();
}

double along(const QPointF& place, int axis) {
    return axis == 0 ? place.x() : place.y();
}

bool picks(int key) {
    return key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Space;
}

} // namespace

QString PlotReadout::text() const {
    QStringList values;
    for (const ReadoutRow& row : rows)
        values << row.text;
    return QStringLiteral("%1: %2").arg(place, values.join(QStringLiteral(", ")));
}

// --- What it is about ----------------------------------------------------------------------------

PlotFrame::PlotFrame(const QString& title, Cursor cursor, Press press, QWidget* parent)
    : QWidget(parent)
    , m_title(title)
    , m_emptyText(tr("Nothing to show yet"))
    , m_moved(cursor == Cursor::Both     ? std::vector{0, 1}
              : cursor == Cursor::Across ? std::vector{0}
                                         : std::vector{1})
    , m_press(press) {
    m_axes.resize(2);
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(title);
}

void PlotFrame::setTitle(const QString& title) {
    m_title = title;
    update();
}

void PlotFrame::setHelp(const QString& help) {
    setStatusTip(help);
    setDescription(help);
}

void PlotFrame::setDescription(const QString& description) {
    m_description = description;
    describe();
}

void PlotFrame::setMessage(const QString& message) {
    m_message = message;
    update();
}

void PlotFrame::setEmptyText(const QString& text) {
    m_emptyText = text;
    update();
}

QString PlotFrame::message() const {
    return m_message.isEmpty() && !hasValues() ? m_emptyText : m_message;
}

void PlotFrame::setAxes(std::vector<PlotAxis> axes) {
    m_axes = std::move(axes);
    update();
}

// --- Places --------------------------------------------------------------------------------------

QRectF PlotFrame::area() const {
    if (m_painted)
        return *m_painted;
    const QFontMetricsF metrics(plotFont(font()));
    double numbers = 0.0;
    for (const double tick : m_axes[1].ticks(height() < kLow ? 3 : 5))
        numbers = std::max(numbers, metrics.horizontalAdvance(upNumber(tick)));
    const double left = kPad + numbers + kPad;
    const double top = (m_title.isEmpty() ? kPad : plotTitleHeight(font())) + 4.0;
    const double right = isPicture() ? scaleWidth() : 0.0;
    return {left, top, std::max(width() - left - 2.0 * kPad - right, 10.0),
            std::max(height() - top - metrics.height() - kPad - 3.0, 10.0)};
}

QPointF PlotFrame::pointOf(const QPointF& place) const {
    const QRectF plot = area();
    return {plot.left() + plot.width() * m_axes[0].share(place.x()),
            plot.bottom() - plot.height() * m_axes[1].share(place.y())};
}

std::optional<QPointF> PlotFrame::placeAt(const QPointF& point) const {
    const QRectF plot = area();
    const double shares[] = {(point.x() - plot.left()) / plot.width(),
                             (plot.bottom() - point.y()) / plot.height()};
    QPointF place;
    for (const int axis : m_moved)
        along(place, axis) = m_axes[axis].value(shares[axis]);
    return place;
}

QPointF PlotFrame::startPlace() const {
    QPointF place;
    for (const int axis : m_moved)
        along(place, axis) = m_axes[axis].value(0.5);
    return place;
}

QPointF PlotFrame::readoutPoint(const QPointF& place) const {
    QPointF at = area().center(), point = pointOf(place);
    for (const int axis : m_moved)
        along(at, axis) = along(point, axis);
    return at;
}

// --- The cursor ----------------------------------------------------------------------------------

void PlotFrame::setProbe(const std::optional<QPointF>& place) {
    if (place == m_probe)
        return;
    m_probe = place;
    update();
}

void PlotFrame::read(const std::optional<QPointF>& place, Reader reader) {
    m_reader = place ? reader : Reader::Nobody;
    m_probe = place;
    describe();
    update();
    Q_EMIT probed(place);
}

void PlotFrame::readByKeys(const QPointF& place) {
    if (message().isEmpty())
        read(allowed(place), Reader::Keys);
}

// Screen readers are told where the keys are; a pointer is followed by eyes.
void PlotFrame::describe() {
    QStringList parts{m_description};
    if (m_reader == Reader::Keys && m_probe)
        parts.prepend(readoutAt(*m_probe).text());
    parts.removeAll(QString());
    setAccessibleDescription(parts.join(QStringLiteral(". ")));
}

bool PlotFrame::pick(const QPointF&, Qt::KeyboardModifiers) {
    return false;
}

bool PlotFrame::moveHandle(const QPointF&) {
    return false;
}

// --- Reading -------------------------------------------------------------------------------------

const PlotAxis& PlotFrame::valueAxis() const {
    return m_moved.size() > 1 ? m_axes[2] : m_axes[1 - m_moved.front()];
}

QString PlotFrame::placeText(const QPointF& place) const {
    QStringList parts;
    for (const int axis : m_moved)
        parts << QStringLiteral("%1 = %2").arg(m_axes[axis].name,
                                               m_axes[axis].number(along(place, axis)));
    return parts.join(QStringLiteral(", "));
}

std::vector<QPointF> PlotFrame::places() const {
    constexpr int kParts = 24; // of an axis
    std::vector<QPointF> all(1);
    for (const int axis : m_moved) {
        const PlotAxis& a = m_axes[axis];
        const int parts = a.whole ? qRound(std::abs(a.max - a.min)) : kParts;
        std::vector<QPointF> more;
        for (QPointF place : all)
            for (int i = 0; i <= parts; ++i) {
                along(place, axis) = std::lerp(a.min, a.max, i / std::max(1.0, double(parts)));
                more.push_back(place);
            }
        all = std::move(more);
    }
    return all;
}

PlotReadout PlotFrame::readoutAt(const QPointF& place) const {
    PlotReadout readout{placeText(place), {}};
    for (const PlotValue& value : valuesAt(place)) {
        QStringList numbers;
        for (const double number : value.numbers)
            numbers << plotNumber(number);
        QStringList parts{value.name, value.note,
                          value.numbers.empty()
                              ? QString()
                              : numbers.join(QStringLiteral("  ")) + valueAxis().unit};
        parts.removeAll(QString());
        readout.rows.push_back({value.look, parts.join(QStringLiteral("  ")), value.name.size()});
    }
    return readout;
}

QString PlotFrame::valuesText() const {
    const bool named = m_axes[m_moved.front()].whole; // by words, not by numbers
    const auto exact = [](double number) { return QString::number(number, 'g', 7); };
    QStringList head, lines;
    if (named)
        head << tr("place");
    for (const int axis : m_moved)
        if (!named)
            head << m_axes[axis].title();
    for (const QPointF& place : places()) {
        QStringList line;
        if (named)
            line << placeText(place);
        for (const int axis : m_moved)
            if (!named)
                line << exact(along(place, axis));
        for (const PlotValue& value : valuesAt(place))
            for (const double number : value.numbers) {
                line << exact(number);
                if (lines.isEmpty()) // as many columns as numbers
                    head << (value.name.isEmpty() ? QString() : value.name + QStringLiteral(", ")) +
                                valueAxis().title();
            }
        lines << line.join(QLatin1Char('\t'));
    }
    lines.prepend(head.join(QLatin1Char('\t')));
    return lines.join(QLatin1Char('\n'));
}

void PlotFrame::copyValues() const {
    QGuiApplication::clipboard()->setText(valuesText());
}

int PlotFrame::axisOf(const QPoint& way) const {
    const int axis = way.x() != 0 ? 0 : 1;
    return !way.isNull() && std::ranges::count(m_moved, axis) > 0 ? axis : -1;
}

bool PlotFrame::wants(const QKeyEvent& event) const {
    if (!message().isEmpty())
        return false;
    const QPoint way = wayOf(event.key());
    return axisOf(way) >= 0 || (!way.isNull() && event.modifiers().testFlag(Qt::AltModifier)) ||
           event.matches(QKeySequence::Copy) || event.key() == Qt::Key_Home ||
           event.key() == Qt::Key_End || (picks(event.key()) && m_press != Press::Nothing) ||
           (event.key() == Qt::Key_Escape && m_reader == Reader::Keys);
}

// These keys are the plot's while it has the focus, whatever the window uses them for.
bool PlotFrame::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && wants(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void PlotFrame::keyPressEvent(QKeyEvent* event) {
    if (!message().isEmpty())
        return QWidget::keyPressEvent(event);
    const Qt::KeyboardModifiers modifiers = event->modifiers();
    const QPoint way = wayOf(event->key());
    const double factor = modifiers.testFlag(Qt::ShiftModifier)     ? 0.1
                          : modifiers.testFlag(Qt::ControlModifier) ? 10.0
                                                                    : 1.0;
    QPointF place = m_probe.value_or(startPlace());
    if (event->matches(QKeySequence::Copy))
        return copyValues();
    if (!way.isNull() && modifiers.testFlag(Qt::AltModifier)) {
        if (moveHandle(factor * QPointF(way)))
            return;
    } else if (const int axis = axisOf(way); axis >= 0) {
        const PlotAxis& a = m_axes[axis];
        const double by = (way.x() + way.y()) * a.step() * (a.whole ? 1.0 : factor);
        along(place, axis) = a.rounded(along(place, axis) + by);
        return readByKeys(place);
    } else if (event->key() == Qt::Key_Home || event->key() == Qt::Key_End) {
        // To the left or the right; to the top or the bottom of what only moves up.
        const int first = m_moved.front();
        along(place, first) =
            (event->key() == Qt::Key_Home) == (first == 0) ? m_axes[first].min : m_axes[first].max;
        return readByKeys(place);
    } else if (event->key() == Qt::Key_Escape && m_reader == Reader::Keys) {
        return read(std::nullopt, Reader::Nobody);
    } else if (picks(event->key()) && pick(place, modifiers)) {
        return readByKeys(place);
    }
    QWidget::keyPressEvent(event);
}

void PlotFrame::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !message().isEmpty())
        return;
    m_pressed = true;
    if (const std::optional<QPointF> place = placeAt(event->position()))
        pick(*place, event->modifiers());
}

void PlotFrame::mouseMoveEvent(QMouseEvent* event) {
    if (!message().isEmpty())
        return;
    const std::optional<QPointF> place = placeAt(event->position());
    const bool held = m_pressed && event->buttons().testFlag(Qt::LeftButton);
    if (!(held && m_press == Press::Drags) && !(m_reader == Reader::Nobody && !place))
        read(place, Reader::Pointer);
    if (held && place && (m_press == Press::Follows || m_press == Press::Drags))
        pick(*place, event->modifiers());
}

void PlotFrame::mouseReleaseEvent(QMouseEvent*) {
    m_pressed = false;
    update();
}

void PlotFrame::leaveEvent(QEvent*) {
    if (m_reader == Reader::Pointer)
        read(std::nullopt, Reader::Nobody);
}

// Who comes by the keys sees where they are.
void PlotFrame::focusInEvent(QFocusEvent* event) {
    if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason)
        readByKeys(m_probe.value_or(startPlace()));
    update();
}

void PlotFrame::focusOutEvent(QFocusEvent* event) {
    if (m_reader == Reader::Keys && event->reason() != Qt::PopupFocusReason)
        read(std::nullopt, Reader::Nobody);
    update();
}

void PlotFrame::contextMenuEvent(QContextMenuEvent* event) {
    QMenu menu;
    QAction* values = menu.addAction(tr("Copy Values"), this, &PlotFrame::copyValues);
    values->setEnabled(message().isEmpty());
    menu.addAction(tr("Copy Picture"), this,
                   [this] { QGuiApplication::clipboard()->setPixmap(grab()); });
    menu.exec(event->globalPos());
}

// --- Painting ------------------------------------------------------------------------------------

void PlotFrame::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    m_painted = area(); // measuring numbers for each point of a curve would take milliseconds
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    paintGround(painter);
    painter.setFont(plotFont(font()));
    const QString words = message();
    if (!words.isEmpty()) {
        paintMessage(painter, words);
    } else {
        paintValues(painter);
        if (m_probe && !(m_pressed && m_press == Press::Drags)) {
            paintProbe(painter, *m_probe);
            const PlotReadout readout =
                reads() && boxesReadout() ? readoutAt(*m_probe) : PlotReadout();
            if (!readout.rows.empty())
                paintReadout(painter, QRectF(rect()).adjusted(2, 2, -2, -2), readoutPoint(*m_probe),
                             readout.place, readout.rows);
        }
    }
    m_painted.reset();
    if (!hasFocus())
        return;
    painter.setPen(QColor(tokens::kFocus));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), tokens::kRadius,
                            tokens::kRadius);
}

void PlotFrame::paintMessage(QPainter& painter, const QString& message) const {
    paintPlotMessage(painter, rect(), message);
}

QString PlotFrame::corner() const {
    return m_axes[isPicture() ? 2 : 1].title();
}

void PlotFrame::paintGround(QPainter& painter) const {
    paintPlotWell(painter, rect(), m_title);
    QString words = corner();
    const QFontMetricsF metrics(plotFont(font())), titleMetrics(font());
    const double room = width() - 28.0 - titleMetrics.horizontalAdvance(m_title);
    if (metrics.horizontalAdvance(words) >= room) // then the unit alone
        words = words.mid(std::max(words.indexOf(QLatin1Char('[')), qsizetype{0}));
    const double w = metrics.horizontalAdvance(words);
    if (m_title.isEmpty() || !message().isEmpty() || w >= room)
        return;
    painter.setFont(plotFont(font()));
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(QPointF(width() - 8.0 - w, 5.0 + titleMetrics.ascent()), words);
}

void PlotFrame::paintWords(QPainter& painter, const QPointF& at, const QString& words) {
    const QFontMetricsF metrics(painter.font());
    painter.fillRect(QRectF(at.x() - 2.0, at.y() - metrics.ascent(),
                            metrics.horizontalAdvance(words) + 4.0, metrics.height()),
                     QColor(tokens::kWell));
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(at, words);
}

// The unit stands in the corner, or behind each number where the corner is another axis's.
QString PlotFrame::upNumber(double value) const {
    return isPicture() ? m_axes[1].number(value) : plotNumber(value);
}

void PlotFrame::paintAxes(QPainter& painter) const {
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const QColor line(tokens::kLine), text(tokens::kTextDim);
    const PlotAxis &across = m_axes[0], &up = m_axes[1];
    const bool grid = !isPicture();
    double taken = plot.left() - 100.0; // numbers reach to here
    double step = 0.0, before = 0.0;    // between the last two
    for (const double x : across.ticks(4)) {
        const double at = std::round(plot.left() + plot.width() * across.share(x)) + 0.5;
        step = at - before;
        before = at;
        painter.setPen(QPen(line, std::abs(x) < 1e-9 && across.min < 0 ? 1.6 : 1.0));
        if (grid)
            painter.drawLine(QPointF(at, plot.top()), QPointF(at, plot.bottom()));
        const QString number = across.number(x);
        const double w = metrics.horizontalAdvance(number);
        const double from = std::clamp(at - w / 2, 0.0, std::max(width() - w - 3.0, 0.0));
        if (from < taken + 4.0)
            continue;
        painter.setPen(text);
        painter.drawText(QPointF(from, plot.bottom() + 2.0 + metrics.ascent()), number);
        taken = from + w;
    }
    for (const double y : up.ticks(height() < kLow ? 3 : 5)) {
        const double at = std::round(plot.bottom() - plot.height() * up.share(y)) + 0.5;
        painter.setPen(QPen(line, 1.0));
        if (grid)
            painter.drawLine(QPointF(plot.left(), at), QPointF(plot.right(), at));
        const QString number = upNumber(y);
        painter.setPen(text);
        painter.drawText(QPointF(plot.left() - kPad - metrics.horizontalAdvance(number),
                                 at + metrics.ascent() / 2 - 1.0),
                         number);
    }
    // The name between the last two numbers, or above them where these stand too close.
    const double name = metrics.horizontalAdvance(across.name);
    const double number = metrics.horizontalAdvance(across.number(across.max));
    if (step > name + 1.6 * number + 8.0)
        painter.drawText(QPointF(plot.right() - (step + name) / 2 - 0.3 * number,
                                 plot.bottom() + 2.0 + metrics.ascent()),
                         across.name);
    else if (grid)
        paintWords(painter, {plot.right() - name - 4.0, plot.bottom() - 5.0}, across.name);
    // Without a title there is no corner for what the values are.
    if (grid && m_title.isEmpty() && !corner().isEmpty())
        paintWords(painter,
                   {plot.right() - metrics.horizontalAdvance(corner()) - 4.0,
                    plot.top() + metrics.ascent() + 2.0},
                   corner());
}

double PlotFrame::scaleWidth() const {
    const QFontMetricsF metrics(plotFont(font()));
    return kScale + 3.0 +
           std::max(metrics.horizontalAdvance(m_axes[2].number(m_axes[2].min)),
                    metrics.horizontalAdvance(m_axes[2].number(m_axes[2].max)));
}

void PlotFrame::paintScale(QPainter& painter, const std::function<QColor(double)>& color) const {
    const QRectF plot = area(), bar(plot.right() + kPad, plot.top(), kScale, plot.height());
    QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
    for (int i = 0; i <= 16; ++i)
        gradient.setColorAt(i / 16.0, color(i / 16.0));
    painter.fillRect(bar, gradient);
    painter.setPen(QColor(tokens::kTextDim));
    const QFontMetricsF metrics(painter.font());
    for (const double share : {0.0, 0.5, 1.0}) {
        const double y = bar.bottom() - share * (bar.height() - metrics.ascent() + 1.0);
        if (share != 0.5 || bar.height() > 6.0 * metrics.height())
            painter.drawText(QPointF(bar.right() + 3.0, y),
                             m_axes[2].number(m_axes[2].value(share)));
    }
}

void PlotFrame::paintProbe(QPainter& painter, const QPointF& place) const {
    const QPointF at = pointOf(place);
    if (m_moved.size() > 1)
        return paintCross(painter, at);
    const QRectF plot = area();
    QColor line(tokens::kText);
    line.setAlpha(110);
    painter.setPen(QPen(line, 1.0));
    if (m_moved.front() == 0)
        painter.drawLine(QPointF(at.x(), plot.top()), QPointF(at.x(), plot.bottom()));
    else
        painter.drawLine(QPointF(plot.left(), at.y()), QPointF(plot.right(), at.y()));
}

void PlotFrame::paintCross(QPainter& painter, const QPointF& at, double arm) {
    for (const QPen& pen :
         {QPen(QColor(0, 0, 0, 170), 3.0), QPen(QColor(255, 255, 255, 230), 1.2)}) {
        painter.setPen(pen);
        painter.drawLine(at - QPointF(arm, 0.0), at + QPointF(arm, 0.0));
        painter.drawLine(at - QPointF(0.0, arm), at + QPointF(0.0, arm));
    }
}

} // namespace patina::editor
