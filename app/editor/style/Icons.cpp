#include "app/editor/style/Icons.h"

#include "app/editor/style/Tokens.h"
#include "core/base/Check.h"

#include <QColor>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPixmap>
#include <QSvgRenderer>

namespace patina::editor {
namespace {

class LineIconEngine : public QIconEngine {
  public:
    LineIconEngine(QByteArray drawing, QRgb fixedColor)
        : m_drawing(std::move(drawing))
        , m_fixedColor(fixedColor) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode,
               QIcon::State state) override {
        const qreal scale = painter->device()->devicePixelRatioF();
        painter->drawPixmap(rect, pixmap((QSizeF(rect.size()) * scale).toSize(), mode, state));
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        if (size.isEmpty()) // a button that has no room yet
            return {};
        QPixmap pixmap(size);
        pixmap.fill(Qt::transparent);
        QByteArray drawing = m_drawing;
        drawing.replace("currentColor", QColor(color(mode, state)).name().toLatin1());
        QSvgRenderer renderer(drawing);
        renderer.setAspectRatioMode(Qt::KeepAspectRatio);
        QPainter painter(&pixmap);
        renderer.render(&painter, QRectF(QPointF(0, 0), QSizeF(size)));
        return pixmap;
    }

    [[nodiscard]] QIconEngine* clone() const override { return new LineIconEngine(*this); }

  private:
    [[nodiscard]] QRgb color(QIcon::Mode mode, QIcon::State state) const {
        if (mode == QIcon::Disabled)
            return tokens::kTextOff;
        if (m_fixedColor != 0)
            return m_fixedColor;
        if (state == QIcon::On)
            return tokens::kAccent;
        return mode == QIcon::Normal ? tokens::kTextDim : tokens::kText;
    }

    QByteArray m_drawing;
    QRgb m_fixedColor; // 0: by state
};

} // namespace

QIcon icon(const QString& name) {
    return icon(name, 0);
}

QIcon icon(const QString& name, QRgb color) {
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    CHECK(file.open(QIODevice::ReadOnly));
    return QIcon(new LineIconEngine(file.readAll(), color));
}

} // namespace patina::editor
