#include "app/editor/widget/LatLongPicture.h"

#include "app/editor/widget/Thumbnails.h"

#include <memory>

namespace patina::editor {
namespace {
constexpr int kAtOnce = 512; // an image this wide is shrunk in about a millisecond
}

LatLongPicture::LatLongPicture(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {}

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
    m_tasks.cancelAll();
    if (image->width() <= kAtOnce) {
        m_small = std::make_shared<const Image>(shrinkImage(*image, width));
        develop();
        return;
    }
    m_tasks.run(
        {.tag = "picture of an environment", .priority = TaskPriority::High},
        [image, width](const JobContext&) {
            return std::make_shared<const Image>(shrinkImage(*image, width));
        },
        [this](const Result<ImagePtr>& small) {
            if (!small)
                return;
            m_small = *small;
            develop();
        });
}

void LatLongPicture::develop() {
    if (!m_small)
        return;
    m_picture = displayImage(*m_small, m_width, m_exposureEv);
    Q_EMIT changed();
}

} // namespace patina::editor
