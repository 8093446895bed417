// A small picture of a sweep with its name above it: a light's, the look that lights are compared
// with, or the map of sensitivity.
#pragma once

#include "core/document/View.h"
#include "core/rank/LightSweep.h"

#include <QImage>
#include <QPoint>
#include <QRect>
#include <QWidget>
#include <optional>

namespace patina::editor {

// `shown`: light as the display shows it, F32 (sweepPicture()).
[[nodiscard]] QImage displayedImage(const Image& shown, const View& view);
// Stops from..to as colours where surfaces are; transparent elsewhere.
[[nodiscard]] QImage sensitivityImage(const SweepPixels& pixels, const Image& sensitivity,
                                      double from, double to);
// What of the pictures shows surfaces, with a little around them: the rest is not looked at.
[[nodiscard]] QRect surfacesRect(const SweepPixels& pixels);
[[nodiscard]] double largestSensitivity(const Image& sensitivity); // stops

class SweepPicture : public QWidget {
    Q_OBJECT
  public:
    explicit SweepPicture(const QString& help, QWidget* parent = nullptr);

    // `marked`: a pixel of it, in a ring.
    void setPicture(const QString& title, const QImage& picture,
                    const std::optional<QPoint>& marked = {});
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    [[nodiscard]] const QString& title() const { return m_title; }
    [[nodiscard]] const std::optional<QPoint>& marked() const { return m_marked; }
    [[nodiscard]] QSize sizeHint() const override { return {150, 110}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {72, 54}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QString m_help, m_title;
    QImage m_picture;
    std::optional<QPoint> m_marked;
};

} // namespace patina::editor
