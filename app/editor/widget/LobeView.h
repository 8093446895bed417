// Lobes in space, one for each compared look side by side; dragging orbits all of them.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/widget/LobePicture.h"

#include <QImage>
#include <QWidget>
#include <memory>
#include <vector>

namespace patina::editor {

class LobeView : public QWidget {
    Q_OBJECT
  public:
    struct Lobe {
        int look = 0; // colour: PlotStyle.h
        QString name;
        std::shared_ptr<const LobeMesh> mesh;
    };

    LobeView(TaskRunner& runner, const QString& title, QWidget* parent = nullptr);

    void setLobes(std::vector<Lobe> lobes, double incidenceDeg, const QString& peak);
    void setMessage(const QString& message);

    [[nodiscard]] const LobeCamera& camera() const { return m_camera; }
    [[nodiscard]] QImage picture() const { return m_picture; } // all lobes; made in the background
    [[nodiscard]] bool upToDate() const { return !m_job.busy(); }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    [[nodiscard]] QRectF area() const;
    void orbit(double yawDeg, double elevationDeg);
    void draw();

    QString m_title, m_message, m_peak;
    std::vector<Lobe> m_lobes;
    double m_incidenceDeg = 45;
    LobeCamera m_camera;
    QPointF m_last;
    QImage m_picture;
    LatestJob m_job;
};

} // namespace patina::editor
