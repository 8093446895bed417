#include "app/editor/sweep/SweepPicture.h"

#include "app/editor/style/Tokens.h"
#include "core/image/ColorMap.h"
#include "core/math/Shading.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kMarkRadius = 6.0;
constexpr int kAround = 6; // pixels around surfaces

QRgb rgbOf(const glm::vec3& encoded) {
    const auto eight = [](float v) {
        return static_cast<int>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f)));
    };
    return qRgb(eight(encoded.x), eight(encoded.y), eight(encoded.z));
}

} // namespace

QImage displayedImage(const Image& shown, const View& view) {
    QImage image(shown.width(), shown.height(), QImage::Format_RGB32);
    const std::span<const float> light = shown.f32();
    std::size_t i = 0;
    for (int y = 0; y < image.height(); ++y) {
        auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < image.width(); ++x, i += 3)
            row[x] = rgbOf(shading::displayEncode({light[i], light[i + 1], light[i + 2]},
                                                  static_cast<int>(view.displayTransfer),
                                                  view.displayGamma));
    }
    return image;
}

QImage sensitivityImage(const SweepPixels& pixels, const Image& sensitivity, double from,
                        double to) {
    QImage image(pixels.width, pixels.height, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    for (const std::uint32_t place : pixels.places) {
        const int at = static_cast<int>(place);
        const double t = (double{sensitivity.f32()[place]} - from) / (to - from);
        image.setPixel(at % pixels.width, at / pixels.width,
                       rgbOf(mapColor(ColorMap::Sequential, static_cast<float>(t))));
    }
    return image;
}

QRect surfacesRect(const SweepPixels& pixels) {
    QRect rect;
    for (const std::uint32_t place : pixels.places) {
        const int at = static_cast<int>(place);
        rect |= QRect(at % pixels.width, at / pixels.width, 1, 1);
    }
    return rect.adjusted(-kAround, -kAround, kAround, kAround) &
           QRect(0, 0, pixels.width, pixels.height);
}

double largestSensitivity(const Image& sensitivity) {
    const std::span<const float> stops = sensitivity.f32();
    return stops.empty() ? 0.0 : double{*std::max_element(stops.begin(), stops.end())};
}

SweepPicture::SweepPicture(const QString& help, QWidget* parent)
    : QWidget(parent)
    , m_help(help) {
    setToolTip(help);
    setStatusTip(help);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void SweepPicture::setPicture(const QString& title, const QImage& picture,
                              const std::optional<QPoint>& marked) {
    m_title = title;
    m_picture = picture;
    m_marked = marked;
    setAccessibleName(title);
    setToolTip(title + QLatin1Char('\n') + m_help); // the title may be cut
    update();
}

void SweepPicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setRenderHint(QPainter::Antialiasing);
    const int line = fontMetrics().height();
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(QRect(0, 0, width(), line), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(m_title, Qt::ElideMiddle, width()));
    const QRect room = rect().adjusted(0, line + tokens::kGap / 2, 0, 0);
    if (m_picture.isNull()) {
        painter.fillRect(room, QColor(tokens::kWell));
        return;
    }
    const QSize size = m_picture.size().scaled(room.size(), Qt::KeepAspectRatio);
    const QRect place(room.topLeft(), size);
    painter.fillRect(place, QColor(tokens::kWell)); // behind what is transparent
    painter.drawImage(place, m_picture);
    if (!m_marked)
        return;
    const QPointF at(place.x() + (m_marked->x() + 0.5) * size.width() / m_picture.width(),
                     place.y() + (m_marked->y() + 0.5) * size.height() / m_picture.height());
    // Seen on light and on dark.
    painter.setPen(QPen(QColor(tokens::kWell), 3.5));
    painter.drawEllipse(at, kMarkRadius, kMarkRadius);
    painter.setPen(QPen(QColor(tokens::kCopper), 1.5));
    painter.drawEllipse(at, kMarkRadius, kMarkRadius);
}

} // namespace patina::editor
