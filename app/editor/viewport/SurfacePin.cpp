#include "app/editor/viewport/SurfacePin.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

// The point lies anywhere in its pixel, and the pixel's middle is what was looked at.
constexpr float kPixelsApart = 1.5f;
constexpr float kGrazing = 0.05f; // cosine from which on pixels grow no more along the surface

} // namespace

SurfacePin::SurfacePin(const render::Inspection& at, const Document& document)
    : m_mesh(at.mesh)
    , m_local(at.value(shading::kRecordPosition)) {
    if (const MeshInstance* mesh = document.mesh(m_mesh))
        m_local = glm::vec3(glm::inverse(mesh->placement.matrix()) * glm::vec4(m_local, 1.0f));
}

std::optional<glm::vec3> SurfacePin::position(const Document& document) const {
    const MeshInstance* mesh = document.mesh(m_mesh);
    if (mesh == nullptr)
        return std::nullopt;
    return glm::vec3(mesh->placement.matrix() * glm::vec4(m_local, 1.0f));
}

std::optional<QPointF> SurfacePin::place(const Document& document, const QSizeF& size) const {
    const std::optional<glm::vec3> world = position(document);
    if (!world || size.isEmpty())
        return std::nullopt;
    const Camera& camera = document.view.camera;
    const auto aspect = static_cast<float>(size.width() / size.height());
    const glm::vec4 clip = camera.projectionMatrix(aspect, document.bounds()) *
                           camera.viewMatrix() * glm::vec4(*world, 1.0f);
    if (!(clip.w > 0.0f) || std::abs(clip.x) >= clip.w || std::abs(clip.y) >= clip.w)
        return std::nullopt;
    return QPointF(size.width() * static_cast<double>(0.5f + 0.5f * clip.x / clip.w),
                   size.height() * static_cast<double>(0.5f - 0.5f * clip.y / clip.w));
}

bool SurfacePin::isSeen(const render::Inspection& there, const Document& document) const {
    const std::optional<glm::vec3> world = position(document);
    if (!world || there.mesh != m_mesh || there.height <= 0)
        return false;
    const Camera& camera = document.view.camera;
    const float depth = glm::dot(*world - camera.position(), camera.forward());
    const float pixel = 2.0f * depth * std::tan(0.5f * glm::radians(camera.fovDeg)) /
                        static_cast<float>(there.height);
    const glm::vec3 normal(there.value(shading::kViewGeometricNormal));
    const glm::vec3 toViewer(there.value(shading::kRecordToViewer));
    const float cosine = std::max(std::abs(glm::dot(normal, toViewer)), kGrazing);
    const glm::vec3 seen(there.value(shading::kRecordPosition));
    return glm::distance(seen, *world) <= kPixelsApart * pixel / cosine;
}

} // namespace patina::editor
