// All rotations of one environment of a sweep as small pictures in a row, made in the background.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/sweep/SweepWork.h"

#include <QImage>
#include <QListWidget>
#include <QSize>
#include <vector>

namespace patina::editor {

class SweepStrip : public QListWidget {
    Q_OBJECT
  public:
    explicit SweepStrip(TaskRunner& runner, QWidget* parent = nullptr);

    // Shows the light (an index into LightSweep::scores) among those of its environment; null:
    // nothing.
    void show(const SweepOutcomePtr& outcome, std::size_t light);
    // Of a light of the environment that is shown, its surfacesRect(); null until it is made.
    [[nodiscard]] QImage picture(std::size_t light) const;
    [[nodiscard]] bool isDrawing() const { return m_job.busy(); }

  Q_SIGNALS:
    void chosen(std::size_t light);
    void picturesChanged();

  private:
    void draw();
    void fill();
    [[nodiscard]] QSize thumbSize() const;

    SweepOutcomePtr m_outcome;
    std::size_t m_environment = 0;
    std::vector<QImage> m_pictures, m_thumbs; // of each rotation
    bool m_refreshing = false;
    LatestJob m_job; // last: it ends first
};

} // namespace patina::editor
