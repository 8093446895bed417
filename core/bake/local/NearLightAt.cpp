#include "core/bake/local/NearLightAt.h"

#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <optional>

namespace patina {
namespace {

// A vertex in the world.
struct Corner {
    std::size_t vertex = 0;
    float weight = 0.0f;
    glm::vec3 place{0.0f}, normal{0.0f};
};

std::array<Corner, 3> cornersOf(const MeshInstance& instance, const MeshPoint& point) {
    const glm::mat3 linear(instance.placement.matrix());
    const glm::mat3 toWorld =
        glm::determinant(linear) != 0.0f ? glm::inverseTranspose(linear) : linear;
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        Corner& corner = corners[k];
        corner.vertex = instance.mesh->indices[3 * point.triangle + k];
        corner.weight = point.weights[static_cast<glm::length_t>(k)];
        corner.place = glm::vec3(instance.placement.matrix() *
                                 glm::vec4(instance.mesh->positions[corner.vertex], 1.0f));
        corner.normal = glm::normalize(toWorld * instance.mesh->normals[corner.vertex]);
    }
    return corners;
}

// Where the shares of a mesh are among those of a light; nothing: nowhere.
std::optional<std::size_t> partOf(const NearShadows& shadows, const MeshInstance& instance) {
    for (std::size_t p = 0; p < shadows.request.parts.size(); ++p) {
        const NearPart& part = shadows.request.parts[p];
        if (part.id == (part.side > 0 ? instance.material : instance.id))
            return p;
    }
    return {};
}

// Of one light, by its shares; nothing where an element has none.
std::optional<glm::vec3> arriving(const Light& light, const NearPart& part,
                                  const std::vector<float>& shares, const MeshInstance& instance,
                                  const MeshPoint& point) {
    const std::array<Corner, 3> corners = cornersOf(instance, point);
    glm::vec3 sum(0.0f);
    if (part.side == 0) {
        for (const Corner& corner : corners) {
            if (corner.vertex >= shares.size() || shares[corner.vertex] < 0.0f)
                return {};
            sum += corner.weight * shares[corner.vertex] *
                   openNearLight(light, corner.place, corner.normal);
        }
        return sum;
    }
    if (instance.mesh->uvs.size() != instance.mesh->positions.size())
        return {};
    const std::size_t texel = texelOf(*instance.mesh, point, part.side);
    if (texel >= shares.size() || shares[texel] < 0.0f)
        return {};
    glm::vec3 place(0.0f), normal(0.0f);
    for (const Corner& corner : corners) {
        place += corner.weight * corner.place;
        normal += corner.weight * corner.normal;
    }
    return shares[texel] * openNearLight(light, place, glm::normalize(normal));
}

} // namespace

glm::vec3 openNearLight(const Light& light, const glm::vec3& place, const glm::vec3& normal) {
    const glm::vec3 toLight = light.position - place;
    const float distance2 = std::max(glm::dot(toLight, toLight), 1e-12f);
    const glm::vec3 l = toLight / std::sqrt(distance2);
    float share = 0.0f; // of the power
    switch (light.type) {
    case LightType::Directional:
        break;
    case LightType::Point:
    case LightType::Spot: {
        const float range2 = light.range * light.range;
        share = shading::pointFalloff(glm::dot(toLight, toLight),
                                      range2 > 0.0f ? 1.0f / range2 : 0.0f) *
                std::max(glm::dot(normal, l), 0.0f) * shading::kInvPi;
        if (light.type == LightType::Spot) {
            const auto [scale, offset] = coneScaleOffset(light);
            share *= shading::spotFalloff(glm::dot(light.directionToLight(), l), scale, offset);
        }
        break;
    }
    case LightType::Sphere: {
        const float sin2 = light.radius * light.radius / distance2;
        share = sin2 >= 1.0f ? 1.0f : shading::sphereFormFactor(glm::dot(normal, l), sin2);
        break;
    }
    case LightType::Rectangle: {
        const RectangleAxes axes = rectangleAxes(light);
        glm::vec3 x, y;
        shading::orthonormalBasis(normal, x, y);
        const auto local = [&](const glm::vec3& v) {
            return glm::vec3(glm::dot(x, v), glm::dot(y, v), glm::dot(normal, v));
        };
        const glm::vec3 center = local(toLight), hx = local(0.5f * light.width * axes.x),
                        hy = local(0.5f * light.height * axes.y);
        share = shading::quadFormFactor(center - hx - hy, center + hx - hy, center + hx + hy,
                                        center - hx + hy);
        break;
    }
    }
    return share * lightPower(light);
}

NearLightAt nearLightAt(const Document& document, const NearShadowsPtr& shadows,
                        const MeshPoint& point) {
    NearLightAt result;
    const auto instance = std::ranges::find(document.meshes, point.mesh, &MeshInstance::id);
    if (!shadows || instance == document.meshes.end() || !instance->mesh)
        return result;
    const std::optional<std::size_t> part = partOf(*shadows, *instance);
    if (!part)
        return result;
    for (std::size_t l = 0; l < shadows->shares.size(); ++l) {
        const Light* light = document.light(shadows->request.lights[l].id);
        if (light == nullptr || light->type == LightType::Directional ||
            !isActive(document, *light))
            continue;
        const std::optional<glm::vec3> radiance = arriving(
            *light, shadows->request.parts[*part], *shadows->shares[l][*part], *instance, point);
        if (!radiance)
            continue;
        result.lights.push_back(light->id);
        result.radiance += *radiance;
    }
    return result;
}

} // namespace patina
