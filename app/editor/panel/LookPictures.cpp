#include "app/editor/panel/LookPictures.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "core/compare/DifferencePicture.h"
#include "core/compare/Flip.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <memory>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kTiles = 3;
constexpr QSize kTileHint(110, 76);

} // namespace

QImage qImageOf(const Image& image) {
    return QImage(image.u8().data(), image.width(), image.height(), 3 * image.width(),
                  QImage::Format_RGB888)
        .copy();
}

ImagePtr imageOf(const QImage& picture) {
    if (picture.isNull())
        return nullptr;
    const QImage rgb = picture.convertToFormat(QImage::Format_RGB888);
    Image image(rgb.width(), rgb.height(), 3, PixelType::U8, ColorEncoding::Srgb);
    const auto row = static_cast<std::size_t>(3 * rgb.width());
    for (int y = 0; y < rgb.height(); ++y)
        std::copy_n(rgb.constScanLine(y), row,
                    image.u8().begin() + static_cast<std::ptrdiff_t>(row) * y);
    return std::make_shared<const Image>(std::move(image));
}

LookPictures::LookPictures(TaskRunner& runner, QWidget* parent)
    : QWidget(parent)
    , m_job(runner, "difference of two snapshots", this, TaskPriority::High) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

// Both show as much from top to bottom: a viewport that was wider shows more at its sides.
std::pair<QImage, QImage> LookPictures::commonMiddle(const QImage& a, const QImage& b) {
    if (a.size() == b.size())
        return {a, b};
    const int height = std::min(a.height(), b.height());
    const QImage first = a.scaledToHeight(height, Qt::SmoothTransformation);
    const QImage second = b.scaledToHeight(height, Qt::SmoothTransformation);
    const int width = std::min(first.width(), second.width());
    const auto middle = [&](const QImage& picture) {
        return picture.copy((picture.width() - width) / 2, 0, width, height);
    };
    return {middle(first), middle(second)};
}

void LookPictures::setSides(const Side& a, const Side& b, const QString& note) {
    const bool same = a.picture == m_a.picture && b.picture == m_b.picture;
    m_a = a;
    m_b = b;
    m_note = note;
    if (!same) {
        m_pictureA = a.picture ? qImageOf(*a.picture) : QImage();
        m_pictureB = b.picture ? qImageOf(*b.picture) : QImage();
        measure();
    }
    setAccessibleName(tr("Pictures of %1 and %2").arg(a.name, b.name));
    update();
}

void LookPictures::clear() {
    setSides({}, {}, {});
}

void LookPictures::say(const QString& text) {
    m_job.cancel();
    m_difference = {};
    m_cropped = false;
    m_problem = text;
    Q_EMIT measured();
}

void LookPictures::measure() {
    if (!m_a.picture || !m_b.picture)
        return say(tr("Nothing to compare"));
    m_problem.clear();
    const auto [first, second] = commonMiddle(m_pictureA, m_pictureB);
    m_cropped = m_pictureA.size() != m_pictureB.size();
    m_job.request([this, a = m_a.picture, b = m_b.picture, first = imageOf(first),
                   second = imageOf(second)](const JobContext& job) {
        struct Found {
            QImage map;
            double mean = 0.0;
            QString problem;
        };
        Found found;
        const Result<Flip> flip = computeFlip(*first, *second, job);
        if (flip) {
            found.mean = flip->error.summary.mean;
            found.map = qImageOf(colorErrors(flip->error.values, ColorMap::Magma, 0.0f, 1.0f));
        } else {
            found.problem = toQString(flip.error().message);
        }
        return [this, a, b, found] {
            if (a != m_a.picture || b != m_b.picture)
                return; // others are shown by now
            m_difference = found.map;
            m_mean = found.mean;
            m_problem = found.problem;
            update();
            Q_EMIT measured();
        };
    });
}

QSize LookPictures::sizeHint() const {
    return {kTiles * kTileHint.width() + (kTiles - 1) * tokens::kGap,
            kTileHint.height() + 2 * (fontMetrics().height() + tokens::kGap / 2)};
}

QSize LookPictures::minimumSizeHint() const {
    return {kTiles * 90, 60 + 2 * (fontMetrics().height() + tokens::kGap / 2)};
}

QRect LookPictures::tile(int index) const {
    const int each = (width() - (kTiles - 1) * tokens::kGap) / kTiles;
    return {index * (each + tokens::kGap), 0, each, height()};
}

void LookPictures::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const int line = fontMetrics().height();
    const auto draw = [&](int index, const QImage& picture, const QString& caption,
                          const QString& absence) {
        const QRect whole = tile(index);
        const QRect place = whole.adjusted(0, line + tokens::kGap / 2, 0, -line - tokens::kGap / 2);
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(whole.x(), whole.y(), whole.width(), line, Qt::AlignLeft,
                         fontMetrics().elidedText(caption, Qt::ElideRight, whole.width()));
        if (picture.isNull()) {
            painter.fillRect(place, QColor(tokens::kWell));
            painter.drawText(place.adjusted(4, 4, -4, -4), Qt::AlignCenter | Qt::TextWordWrap,
                             absence);
            return;
        }
        const QSize size = picture.size().scaled(place.size(), Qt::KeepAspectRatio);
        painter.drawImage(QRect(place.topLeft(), size), picture);
    };
    draw(0, m_pictureA, m_a.name, m_a.absence);
    draw(1, m_pictureB, m_b.name, m_b.absence);
    const QString measured =
        m_difference.isNull() ? tr("Difference") : tr("FLIP %1").arg(m_mean, 0, 'f', 3);
    draw(2, m_difference, measured, m_problem.isEmpty() ? tr("Comparing…") : m_problem);
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(QRect(0, height() - line, width(), line), Qt::AlignLeft,
                     fontMetrics().elidedText(note(), Qt::ElideRight, width()));
}

// What else the pictures differ in.
QString LookPictures::note() const {
    QStringList notes;
    if (!m_note.isEmpty() && !m_difference.isNull())
        notes << m_note;
    if (m_cropped)
        notes << tr("the difference is of their common middle");
    return notes.join(QStringLiteral("; "));
}

bool LookPictures::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    QString text;
    if (tile(0).contains(help->pos()))
        text = m_a.name;
    else if (tile(1).contains(help->pos()))
        text = m_b.name;
    else
        text = tr("What a viewer would notice who flips between the two small pictures: mean FLIP, "
                  "0 to 1. The wall compares them in full size");
    QToolTip::showText(help->globalPos(), text, this);
    return true;
}

} // namespace patina::editor
