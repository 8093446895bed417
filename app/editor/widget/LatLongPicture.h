// The picture of an environment for a screen: tone mapped, small, and made without holding up the
// window.
#pragma once

#include "core/image/Image.h"
#include "core/job/TaskRunner.h"

#include <QImage>
#include <QObject>

namespace patina::editor {

class LatLongPicture : public QObject {
    Q_OBJECT
  public:
    explicit LatLongPicture(TaskRunner& runner, QObject* parent = nullptr);

    // `width`: pixels of the screen. A small image is shown at once, a large one when changed()
    // comes; until then the picture stays as it is. The newest wins.
    void show(const ImagePtr& image, float exposureEv, int width);
    [[nodiscard]] const QImage& picture() const { return m_picture; }

  Q_SIGNALS:
    void changed();

  private:
    void develop();

    ImagePtr m_image; // that was asked for
    ImagePtr m_small; // shrunk to at most m_width
    int m_width = 0;
    float m_exposureEv = 0;
    QImage m_picture;
    TaskGroup m_tasks;
};

} // namespace patina::editor
