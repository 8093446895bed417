// Pictures of the compared looks side by side, drawn in the background, that are read and dragged
// as plots are.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/widget/PlotFrame.h"

#include <QImage>
#include <functional>
#include <vector>

namespace patina::editor {

class PictureFrame : public PlotFrame {
    Q_OBJECT
  public:
    struct Look {
        int look = 0; // colour: PlotStyle.h
        QString name; // above its picture, where there are several
    };

    [[nodiscard]] QImage picture() const { return m_picture; } // all looks
    [[nodiscard]] bool upToDate() const { return !m_job.busy(); }

  protected:
    PictureFrame(TaskRunner& runner, const char* job, const QString& title, Press press,
                 QWidget* parent);

    // Paints look `index` into `cell` of a picture with `ratio` pixels to a unit; on any thread.
    using Draw =
        std::function<void(QPainter& painter, std::size_t index, const QRectF& cell, double ratio)>;
    [[nodiscard]] virtual Draw drawer() const = 0;
    // Of the looks within `area`; `unit` pixels are one of the screen.
    [[nodiscard]] virtual std::vector<QRectF> cells(const QRectF& area, double unit) const;
    [[nodiscard]] std::vector<QRectF> cells() const { return cells(area(), 1.0); }
    [[nodiscard]] int cellAt(const QPointF& point) const;        // the nearest; -1: there is none
    [[nodiscard]] double nameHeight() const;                     // of the looks' names
    [[nodiscard]] virtual double nameTop() const { return 0.0; } // from the cell's

    void setLooks(std::vector<Look> looks); // draws
    void draw();
    // A value of each look.
    [[nodiscard]] std::vector<PlotValue>
    looked(const std::function<double(std::size_t index)>& value) const;

    [[nodiscard]] bool hasValues() const override { return !m_looks.empty(); }
    [[nodiscard]] QRectF area() const override;
    void paintValues(QPainter& painter) const override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    std::vector<Look> m_looks;
    QImage m_picture;
    LatestJob m_job;
};

} // namespace patina::editor
