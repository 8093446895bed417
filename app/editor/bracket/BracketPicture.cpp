#include "app/editor/bracket/BracketPicture.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"

#include <QPainter>
#include <cstring>
#include <utility>

namespace patina::editor {
namespace {
constexpr int kVeil = 170; // under words over a picture, of 255
} // namespace

BracketPicture::BracketPicture(QWidget* parent)
    : QWidget(parent) {
    setObjectName(QStringLiteral("bracketPicture"));
    describe(this, tr("Merged picture"),
             tr("The merged photos at the exposure chosen below; what is clipped in all photos and "
                "where they disagree is coloured"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void BracketPicture::setPreview(std::shared_ptr<const BracketPreview> preview) {
    m_preview = std::move(preview);
    draw();
}

void BracketPicture::setExposure(double ev) {
    m_ev = static_cast<float>(ev);
    draw();
}

void BracketPicture::setMarks(bool on) {
    m_marks = on;
    draw();
}

void BracketPicture::setMessage(const QString& message, bool isError) {
    if (message == m_message && isError == m_isError)
        return;
    m_message = message;
    m_isError = isError;
    setAccessibleDescription(message.isEmpty() ? toolTip() : message);
    update();
}

void BracketPicture::draw() {
    m_image = {};
    if (m_preview) {
        const Image drawn = drawPreview(*m_preview, m_ev, m_marks);
        m_image = QImage(drawn.width(), drawn.height(), QImage::Format_RGB888);
        const auto row = static_cast<std::size_t>(drawn.width()) * 3;
        for (int y = 0; y < drawn.height(); ++y)
            std::memcpy(m_image.scanLine(y), drawn.u8().data() + static_cast<std::size_t>(y) * row,
                        row);
    }
    update();
}

void BracketPicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.fillRect(rect(), QColor(tokens::kWell));
    if (!m_image.isNull()) {
        QRect place({}, m_image.size().scaled(size(), Qt::KeepAspectRatio));
        place.moveCenter(rect().center());
        painter.drawImage(place, m_image);
    }
    if (m_message.isEmpty())
        return;
    if (!m_image.isNull()) {
        QColor veil(tokens::kWell);
        veil.setAlpha(kVeil);
        painter.fillRect(rect(), veil);
    }
    painter.setPen(QColor(m_isError ? tokens::kCopper : tokens::kTextDim));
    painter.drawText(
        rect().adjusted(tokens::kMargin, tokens::kMargin, -tokens::kMargin, -tokens::kMargin),
        Qt::AlignCenter | Qt::TextWordWrap, m_message);
}

} // namespace patina::editor
