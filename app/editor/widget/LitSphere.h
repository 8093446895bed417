// Balls of the compared looks under one light and the scene's environment; the light is dragged by
// its highlight.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/widget/SpherePicture.h"

#include <QImage>
#include <QWidget>
#include <vector>

namespace patina::editor {

class LitSphere : public QWidget {
    Q_OBJECT
  public:
    struct Ball {
        int look = 0; // colour: PlotStyle.h
        QString name;
        std::shared_ptr<const BrdfLens> lens;
    };

    LitSphere(TaskRunner& runner, const QString& title, QWidget* parent = nullptr);

    void setBalls(std::vector<Ball> balls);
    void setEnvironment(std::shared_ptr<const IblMaps> maps, const Environment& environment,
                        const View& view);
    void setMessage(const QString& message);

    [[nodiscard]] const SphereLight& light() const { return m_light; }
    [[nodiscard]] QImage picture() const { return m_picture; } // made in the background
    [[nodiscard]] bool upToDate() const { return !m_job.busy(); }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;

  private:
    [[nodiscard]] QRectF area() const;
    [[nodiscard]] std::vector<QRectF> squares(const QRectF& area, double unit) const;
    void dragTo(const QPointF& point);
    void draw();

    QString m_title, m_message;
    std::vector<Ball> m_balls;
    SphereLight m_light;
    QImage m_picture;
    LatestJob m_job;
};

} // namespace patina::editor
