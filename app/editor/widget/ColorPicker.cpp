#include "app/editor/widget/ColorPicker.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/NumberField.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLinearGradient>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

namespace patina::editor {
namespace {

QColor displayOf(const Hsv& hsv) {
    return toDisplay(linearOf(hsv));
}

float fraction(double position, int size) {
    return static_cast<float>(std::clamp(position / std::max(1, size - 1), 0.0, 1.0));
}

} // namespace

// --- Saturation and value ------------------------------------------------------------------------

SaturationValueSquare::SaturationValueSquare(QWidget* parent)
    : QWidget(parent) {
    setFixedHeight(160);
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Saturation and brightness"));
}

void SaturationValueSquare::setColor(const Hsv& color) {
    m_color = color;
    update();
}

void SaturationValueSquare::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    QLinearGradient saturation(0, 0, width(), 0);
    saturation.setColorAt(0, Qt::white);
    saturation.setColorAt(1, displayOf({m_color.hue, 1, 1}));
    painter.fillRect(rect(), saturation);
    QLinearGradient value(0, 0, 0, height());
    value.setColorAt(0, Qt::transparent);
    value.setColorAt(1, Qt::black);
    painter.fillRect(rect(), value);

    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF at(m_color.saturation * (width() - 1), (1 - m_color.value) * (height() - 1));
    painter.setBrush(displayOf(m_color));
    painter.setPen(QPen(m_color.value > 0.6f ? Qt::black : Qt::white, 1.6));
    painter.drawEllipse(at, 5.5, 5.5);
}

void SaturationValueSquare::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    Q_EMIT dragStarted();
    mouseMoveEvent(event);
}

void SaturationValueSquare::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & Qt::LeftButton)
        Q_EMIT dragged(fraction(event->position().x(), width()),
                       1 - fraction(event->position().y(), height()));
}

void SaturationValueSquare::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        Q_EMIT dragFinished();
}

// --- Hue -----------------------------------------------------------------------------------------

HueStrip::HueStrip(QWidget* parent)
    : QWidget(parent) {
    setFixedHeight(16);
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Hue"));
}

void HueStrip::setHue(float hue) {
    m_hue = hue;
    update();
}

void HueStrip::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    QLinearGradient hues(0, 0, width(), 0);
    for (int sextant = 0; sextant <= 6; ++sextant)
        hues.setColorAt(sextant / 6.0,
                        displayOf({static_cast<float>(sextant % 6) / 6.0f, 0.85f, 0.95f}));
    painter.fillRect(rect(), hues);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(Qt::white, 2));
    painter.setBrush(Qt::NoBrush);
    const double x = std::clamp<double>(m_hue * (width() - 1), 3, width() - 4);
    painter.drawRoundedRect(QRectF(x - 3, 1, 6, height() - 2), 2, 2);
}

void HueStrip::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    Q_EMIT dragStarted();
    mouseMoveEvent(event);
}

void HueStrip::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & Qt::LeftButton)
        Q_EMIT dragged(fraction(event->position().x(), width()));
}

void HueStrip::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        Q_EMIT dragFinished();
}

// --- The picker ----------------------------------------------------------------------------------

ColorPicker::ColorPicker(QWidget* parent)
    : QFrame(parent, Qt::Popup)
    , m_square(new SaturationValueSquare)
    , m_strip(new HueStrip)
    , m_hex(new QLineEdit)
    , m_swatch(new QWidget) {
    setObjectName(QStringLiteral("popup"));
    setFixedWidth(276);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(tokens::kMargin, tokens::kMargin, tokens::kMargin, tokens::kMargin);
    grid->setSpacing(tokens::kGap);
    grid->addWidget(m_square, 0, 0, 1, 4);
    grid->addWidget(m_strip, 1, 0, 1, 4);

    auto* hexLabel = new QLabel(tr("sRGB"));
    hexLabel->setObjectName(QStringLiteral("dim"));
    m_hex->setAccessibleName(tr("sRGB colour as a hexadecimal number"));
    m_hex->setMaxLength(9);
    m_swatch->setAutoFillBackground(true);
    m_swatch->setFixedHeight(tokens::kRowHeight - 2);
    grid->addWidget(hexLabel, 2, 0);
    grid->addWidget(m_hex, 2, 1, 1, 2);
    grid->addWidget(m_swatch, 2, 3);

    auto* linearLabel = new QLabel(tr("Linear"));
    linearLabel->setObjectName(QStringLiteral("dim"));
    linearLabel->setToolTip(tr("The components as the shading computes with them, without the "
                               "display's curve."));
    grid->addWidget(linearLabel, 3, 0);
    const QString names[3] = {tr("Red, linear"), tr("Green, linear"), tr("Blue, linear")};
    for (int i = 0; i < 3; ++i) {
        auto* field = m_components[i] = new NumberField({0, 1, 0, 1, 3, false, {}});
        field->setAccessibleName(names[i]);
        field->setToolTip(names[i]);
        field->setMinimumWidth(48);
        grid->addWidget(field, 3, 1 + i);
        const auto with = [this, i](double value) {
            glm::vec3 color = m_linear;
            color[i] = static_cast<float>(value);
            setColor(color);
            return m_linear;
        };
        connect(field, &NumberField::dragStarted, this, &ColorPicker::dragStarted);
        connect(field, &NumberField::dragFinished, this, &ColorPicker::dragFinished);
        connect(field, &NumberField::dragged, this,
                [=, this](double v) { Q_EMIT dragged(with(v)); });
        connect(field, &NumberField::stepped, this,
                [=, this](double v) { Q_EMIT edited(with(v)); });
        connect(field, &NumberField::edited, this, [=, this](double v) { Q_EMIT edited(with(v)); });
    }

    connect(m_square, &SaturationValueSquare::dragStarted, this, &ColorPicker::dragStarted);
    connect(m_square, &SaturationValueSquare::dragFinished, this, &ColorPicker::dragFinished);
    connect(m_square, &SaturationValueSquare::dragged, this, [this](float saturation, float value) {
        drag({m_hsv.hue, saturation, value});
    });
    connect(m_strip, &HueStrip::dragStarted, this, &ColorPicker::dragStarted);
    connect(m_strip, &HueStrip::dragFinished, this, &ColorPicker::dragFinished);
    connect(m_strip, &HueStrip::dragged, this, [this](float hue) {
        drag({hue, m_hsv.saturation, m_hsv.value});
    });
    connect(m_hex, &QLineEdit::editingFinished, this, [this] {
        const auto color = parseHex(m_hex->text());
        if (color && m_hex->isModified()) {
            setColor(*color);
            Q_EMIT edited(*color);
        } else {
            refresh(false);
        }
    });
}

void ColorPicker::setColor(const glm::vec3& linear) {
    if (linear == m_linear && m_hsv.value > 0)
        return;
    m_linear = linear;
    const Hsv hsv = hsvOf(linear);
    // Greys have no hue and black no saturation: keep the ones the hand had chosen.
    m_hsv = {hsv.saturation > 0 ? hsv.hue : m_hsv.hue,
             hsv.value > 0 ? hsv.saturation : m_hsv.saturation, hsv.value};
    refresh(false);
}

void ColorPicker::drag(const Hsv& hsv) {
    m_hsv = hsv;
    m_linear = linearOf(hsv);
    refresh(true);
    Q_EMIT dragged(m_linear);
}

void ColorPicker::refresh(bool fromSquare) {
    m_square->setColor(m_hsv);
    m_strip->setHue(m_hsv.hue);
    if (fromSquare || !m_hex->hasFocus() || !m_hex->isModified())
        m_hex->setText(hexOf(m_linear));
    QPalette colors = m_swatch->palette();
    colors.setColor(QPalette::Window, toDisplay(m_linear));
    m_swatch->setPalette(colors);
    for (int i = 0; i < 3; ++i)
        m_components[i]->setValue(m_linear[i]);
}

} // namespace patina::editor
