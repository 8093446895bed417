// A lat-long picture with a title and a line below it, read out by direction.
#pragma once

#include "app/editor/widget/DirectionAxes.h"

#include <QImage>
#include <functional>

namespace patina::editor {

class PictureTile : public PlotFrame {
    Q_OBJECT
  public:
    // The number of a direction of the world, or three of its channels.
    using Reader = std::function<std::vector<double>(const glm::vec3& direction)>;

    PictureTile(const QString& title, const PlotAxis& quantity, QWidget* parent = nullptr);

    void setPicture(const QImage& picture, const QString& note, Reader reader);
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    [[nodiscard]] QString note() const { return m_note; }

    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] QSize sizeHint() const override { return {340, 200}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 116}; }

  protected:
    [[nodiscard]] bool hasValues() const override { return !m_picture.isNull(); }
    [[nodiscard]] QString placeText(const QPointF& place) const override {
        return directionText(place);
    }
    [[nodiscard]] QRectF area() const override;
    void paintValues(QPainter& painter) const override;

  private:
    [[nodiscard]] QRectF noteArea() const;

    QString m_note;
    QImage m_picture;
    Reader m_reader;
};

} // namespace patina::editor
