#include "app/editor/widget/LatLongPicture.h"

#include "app/editor/widget/Thumbnails.h"

#include <memory>

namespace patina::editor {
namespace {
constexpr int kAtOnce = 512; // an image this wide is shrunk in about a millisecond
}

LatLongPicture::LatLongPicture(QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(1);
}

LatLongPicture::~LatLongPicture() {
    m_pool.clear();
    m_pool.waitForDone();
}

void LatLongPicture::show(const ImagePtr& image, float exposureEv, int width) {
    if (!image)
        return;
    const bool sameImage = image == m_image && width == m_width;
    if (sameImage && exposureEv == m_exposureEv)
        return;
    m_exposureEv = exposureEv;
    if (sameImage) {
        develop();
        return;
    }
    m_image = image;
    m_width = width;
    const quint64 id = ++m_request;
    if (image->width() <= kAtOnce) {
        m_small = std::make_shared<const Image>(shrinkImage(*image, width));
        develop();
        return;
    }
    m_pool.clear(); // what has not begun is not wanted any more
    m_pool.start([this, id, image, width] {
        auto small = std::make_shared<const Image>(shrinkImage(*image, width));
        // The destructor waits for the pool, so `this` is alive.
        QMetaObject::invokeMethod(
            this,
            [this, id, small] {
                if (id != m_request)
                    return;
                m_small = small;
                develop();
            },
            Qt::QueuedConnection);
    });
}

void LatLongPicture::develop() {
    if (!m_small)
        return;
    m_picture = displayImage(*m_small, m_width, m_exposureEv);
    Q_EMIT changed();
}

} // namespace patina::editor
