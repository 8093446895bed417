#include "app/editor/viewport/ProjectionFeed.h"

#include "core/math/SphericalHarmonics.h"
#include "core/mix/LightMix.h"

#include <algorithm>

namespace patina::editor {

ProjectionFeed::ProjectionFeed(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_job(runner, "cross-fade", nullptr, TaskPriority::High) {}

void ProjectionFeed::upload(render::SceneRenderer& renderer, const Document& document) {
    const std::vector<EnvironmentPart> parts = environmentParts(document);
    if (parts.size() < 2)
        return;
    for (const EnvironmentPart& part : parts) {
        if (renderer.knowsProjection(part.image))
            continue;
        if (part.image == m_asked) {
            if (!m_done)
                return; // one after the other
            renderer.setProjection(part.image, *m_done);
            continue;
        }
        m_asked = part.image;
        m_done = nullptr;
        m_job.request([this, image = part.image](const JobContext& job) -> LatestJob::Apply {
            const std::vector<glm::vec3> light = projectLatLong(*image, kMaxShOrder, job);
            if (job.cancelled())
                return {};
            auto done = std::make_shared<render::SceneRenderer::ProjectionSh>();
            std::ranges::copy(light, done->begin());
            return [this, image, done] {
                if (image != m_asked)
                    return;
                m_done = done;
                Q_EMIT changed();
            };
        });
        return;
    }
}

} // namespace patina::editor
