#include "app/editor/widget/Thumbnails.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr int kMaxEntries = 256;
}

QImage displayImage(const Image& image, int maxSide, float exposureEv, MapChannel channel) {
    if (image.empty())
        return {};
    const Image small = shrinkImage(image, maxSide);
    QImage picture(small.width(), small.height(), QImage::Format_RGB32);
    const bool data = small.encoding() == ColorEncoding::Data;
    const bool highRange = small.type() == PixelType::F32;
    const float exposure = std::exp2(exposureEv);
    for (int y = 0; y < small.height(); ++y) {
        auto* row = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < small.width(); ++x) {
            const glm::vec4 texel = small.linear(x, y);
            glm::vec3 color(texel);
            if (channel != MapChannel::Rgb)
                color =
                    glm::vec3(texel[static_cast<int>(channel) - static_cast<int>(MapChannel::R)]);
            if (highRange && !data) {
                color *= exposure;
                color = color / (color + glm::vec3(1.0f)) * 1.6f; // Reinhard, a little brighter
            }
            if (!data)
                color = shading::srgbEncode(color);
            const glm::vec3 byte = glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f;
            row[x] =
                qRgb(static_cast<int>(byte.x), static_cast<int>(byte.y), static_cast<int>(byte.z));
        }
    }
    return picture;
}

Thumbnails::Thumbnails(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {}

QImage Thumbnails::thumbnail(const ImagePtr& image, int side, MapChannel channel) {
    if (!image)
        return {};
    const Key key(reinterpret_cast<quintptr>(image.get()), {side, static_cast<int>(channel)});
    const auto found = m_entries.constFind(key);
    if (found != m_entries.constEnd() && found->image.lock() == image)
        return found->picture;
    if (m_entries.size() >= kMaxEntries)
        m_entries.clear();
    m_entries.insert(key, {image, {}});
    m_tasks.run(
        {.tag = "thumbnails", .policy = TaskPolicy::Queue, .priority = TaskPriority::Low},
        [image, side, channel](const JobContext&) {
            return displayImage(*image, side, 0.0f, channel);
        },
        [this, image, key](const Result<QImage>& picture) {
            if (!picture)
                return;
            m_entries.insert(key, {image, *picture});
            Q_EMIT ready();
        });
    return {};
}

} // namespace patina::editor
