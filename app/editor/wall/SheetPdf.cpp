#include "app/editor/wall/SheetPdf.h"

#include <QBuffer>
#include <QFont>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <span>

namespace patina::editor {
namespace {

constexpr int kPixelsPerInch = 96;
constexpr double kPointsPerInch = 72.0;

QColor colorOf(const glm::vec3& display) {
    return QColor::fromRgbF(display.r, display.g, display.b);
}

} // namespace

Bytes sheetPdf(const sheet::WallSheet& sheet, const Wall& wall, const std::vector<WallCell>& cells,
               const std::vector<sheet::DrawnCell>& drawn) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    {
        QPdfWriter writer(&buffer);
        const glm::ivec2 size = sheet.size();
        writer.setResolution(kPixelsPerInch);
        writer.setPageMargins(QMarginsF());
        writer.setPageSize(QPageSize(QSizeF(size.x, size.y) * (kPointsPerInch / kPixelsPerInch),
                                     QPageSize::Point, QString(), QPageSize::ExactMatch));
        writer.setCreator(QStringLiteral("Patina"));
        QPainter painter(&writer);
        painter.fillRect(0, 0, size.x, size.y, colorOf(sheet::kPaper));
        QFont font(QStringLiteral("sans-serif"));
        const auto write = [&](const sheet::SheetText& text) {
            font.setPixelSize(text.size);
            painter.setFont(font);
            painter.setPen(colorOf(text.color));
            painter.drawText(text.x, text.baseline, QString::fromStdString(text.text));
        };
        for (const sheet::SheetText& text : sheet.texts(wall))
            write(text);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::ivec2 place = sheet.place(cells[i]);
            if (!drawn[i].problem.empty()) {
                const QRect box(place.x, place.y, sheet.cellSize().x, sheet.cellSize().y);
                painter.setPen(colorOf(sheet::kAmber));
                painter.drawText(box, Qt::AlignCenter | Qt::TextWordWrap,
                                 QString::fromStdString(drawn[i].problem));
                continue;
            }
            const Image& picture = drawn[i].picture;
            const std::span<const std::uint8_t> pixels = picture.u8();
            painter.drawImage(place.x, place.y,
                              QImage(pixels.data(), picture.width(), picture.height(),
                                     picture.width() * picture.channels(), QImage::Format_RGB888));
        }
    }
    const QByteArray data = buffer.data();
    const auto bytes =
        std::as_bytes(std::span(data.constData(), static_cast<std::size_t>(data.size())));
    return {bytes.begin(), bytes.end()};
}

} // namespace patina::editor
