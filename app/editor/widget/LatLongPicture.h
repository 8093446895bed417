// The picture of an environment for a screen: tone mapped, small, and made without holding up the
// window.
#pragma once

#include "core/image/Image.h"

#include <QImage>
#include <QObject>
#include <QThreadPool>

namespace patina::editor {

class LatLongPicture : public QObject {
    Q_OBJECT
  public:
    explicit LatLongPicture(QObject* parent = nullptr);
    ~LatLongPicture() override; // waits

    // `width`: pixels of the screen. A small image is shown at once, a large one when changed()
    // comes; until then the picture stays as it is. The newest wins.
    void show(const ImagePtr& image, float exposureEv, int width);
    [[nodiscard]] const QImage& picture() const { return m_picture; }

  Q_SIGNALS:
    void changed();

  private:
    void develop();

    QThreadPool m_pool;
    ImagePtr m_image; // that was asked for
    ImagePtr m_small; // shrunk to at most m_width
    int m_width = 0;
    float m_exposureEv = 0;
    quint64 m_request = 0;
    QImage m_picture;
};

} // namespace patina::editor
