// Lobes in space, one for each compared look side by side; dragging orbits all of them.
#pragma once

#include "app/editor/widget/LobePicture.h"
#include "app/editor/widget/PictureFrame.h"

#include <memory>

namespace patina::editor {

class LobeView : public PictureFrame {
    Q_OBJECT
  public:
    struct Lobe : Look {
        std::shared_ptr<const LobeMesh> mesh;
        std::shared_ptr<const BrdfLens> lens; // that it is of
    };

    LobeView(TaskRunner& runner, const QString& title, QWidget* parent = nullptr);

    // `peak`: the value that lies 1 from the point, > 0.
    void setLobes(std::vector<Lobe> lobes, double incidenceDeg, const LobeScale& scale,
                  double peak);

    [[nodiscard]] const LobeCamera& camera() const { return m_camera; }
    // A place is a direction: degrees about the normal, 0 in the mirror direction, and from it.
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override; // on the first lobe
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] double valueAt(std::size_t lobe, const QPointF& place) const;

  protected:
    [[nodiscard]] Draw drawer() const override;
    [[nodiscard]] QPointF startPlace() const override;
    [[nodiscard]] QString corner() const override;
    bool moveHandle(const QPointF& way) override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

  private:
    void orbit(double yawDeg, double elevationDeg);
    [[nodiscard]] QPointF pointOn(std::size_t lobe, const QPointF& place) const;

    std::vector<Lobe> m_lobes;
    double m_incidenceDeg = 45, m_peak = 1;
    LobeScale m_scale;
    LobeCamera m_camera;
    QPointF m_last;
};

} // namespace patina::editor
