// Balls of the compared looks under one light and the scene's environment; the light is dragged by
// its highlight.
#pragma once

#include "app/editor/widget/PictureFrame.h"
#include "app/editor/widget/SpherePicture.h"

namespace patina::editor {

class LitSphere : public PictureFrame {
    Q_OBJECT
  public:
    struct Ball : Look {
        std::shared_ptr<const BrdfLens> lens;
    };

    LitSphere(TaskRunner& runner, const QString& title, QWidget* parent = nullptr);

    void setBalls(std::vector<Ball> balls);
    void setEnvironment(std::shared_ptr<const IblMaps> maps, const Environment& environment,
                        const View& view);

    [[nodiscard]] const SphereLight& light() const { return m_light; }
    // A place is a point of each ball as it is seen, -1…1 to the right and upwards.
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override; // on the first
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;

  protected:
    [[nodiscard]] Draw drawer() const override;
    // The largest square of each cell, below the name where there are several.
    [[nodiscard]] std::vector<QRectF> cells(const QRectF& area, double unit) const override;
    [[nodiscard]] double nameTop() const override { return -nameHeight(); }
    [[nodiscard]] QPointF startPlace() const override { return m_highlight; }
    [[nodiscard]] QPointF allowed(const QPointF& place) const override; // on the ball
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    bool moveHandle(const QPointF& way) override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;

  private:
    void setHighlight(const QPointF& place);

    std::vector<Ball> m_balls;
    SphereLight m_light;
    QPointF m_highlight;
};

} // namespace patina::editor
