#include "core/light/LobeMesh.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

glm::vec3 reflected(const BrdfLens& lens, const glm::vec3& fixed, LobeEnd end,
                    const glm::vec3& direction, const LobeScale& scale) {
    return end == LobeEnd::Light ? lens.brdf(fixed, direction, scale.lobe)
                                 : lens.brdf(direction, fixed, scale.lobe);
}

// Area-weighted; the surface is seen from outside.
void computeNormals(LobeMesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1],
                            c = mesh.triangles[i + 2];
        const glm::vec3 normal = glm::cross(mesh.positions[b] - mesh.positions[a],
                                            mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t corner : {a, b, c})
            mesh.normals[corner] += normal;
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        // Where all collapses into the middle there is no surface; any unit vector does.
        const float length = glm::length(mesh.normals[i]);
        mesh.normals[i] = length > 1e-20f ? mesh.normals[i] / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
}

} // namespace

float lobeValue(const glm::vec3& f, float cosine, const LobeScale& scale) {
    const float value =
        scale.channel >= 0 && scale.channel < 3 ? f[scale.channel] : shading::luminance(f);
    return scale.cosine ? value * std::max(cosine, 0.0f) : value;
}

float lobeRadius(float value, float peak, const LobeScale& scale) {
    if (!(value > 0.0f) || !(peak > 0.0f))
        return 0.0f;
    if (scale.logarithmic)
        return std::max(1.0f + std::log10(value / peak) / kLobeDecades, 0.0f);
    return value / peak;
}

float lobePeak(const BrdfLens& lens, const glm::vec3& fixed, LobeEnd end, const LobeScale& scale) {
    const float sine = std::sqrt(fixed.x * fixed.x + fixed.y * fixed.y);
    const glm::vec3 across =
        sine > 1e-6f ? glm::vec3(-fixed.x / sine, -fixed.y / sine, 0.0f) : glm::vec3(1, 0, 0);
    float peak = 0.0f;
    for (const float theta : lensAngles(std::atan2(sine, fixed.z), lens.alpha())) {
        const glm::vec3 direction = std::sin(theta) * across + glm::vec3(0, 0, std::cos(theta));
        peak = std::max(
            peak, lobeValue(reflected(lens, fixed, end, direction, scale), direction.z, scale));
    }
    return peak;
}

LobeMesh makeLobeMesh(const BrdfLens& lens, const glm::vec3& fixed, LobeEnd end,
                      const LobeScale& scale, float peak, int rings, int segments) {
    CHECK_LE(2, rings);
    CHECK_LE(3, segments);
    // Rings around the mirror direction, each azimuth from there down to the horizon: the highlight
    // gets most of them however narrow it is, and the edge of the mesh is the horizon itself.
    const glm::vec3 mirror(-fixed.x, -fixed.y, std::max(fixed.z, 1e-3f));
    const glm::vec3 axis = glm::normalize(mirror);
    glm::vec3 t, b;
    shading::orthonormalBasis(axis, t, b);
    const float alpha = lens.alpha();

    LobeMesh mesh;
    const auto add = [&](const glm::vec3& direction) {
        const glm::vec3 f = reflected(lens, fixed, end, direction, scale);
        const float largest = std::max({f.x, f.y, f.z, 1e-20f});
        mesh.positions.push_back(direction *
                                 lobeRadius(lobeValue(f, direction.z, scale), peak, scale));
        mesh.colors.push_back(f / largest);
    };
    add(axis);
    for (int ring = 1; ring <= rings; ++ring) {
        // Even in asinh(angle / alpha): even steps within the highlight, growing outside of it.
        const float share = static_cast<float>(ring) / static_cast<float>(rings);
        for (int segment = 0; segment < segments; ++segment) {
            const float phi =
                shading::kTwoPi * static_cast<float>(segment) / static_cast<float>(segments);
            const glm::vec3 out = std::cos(phi) * t + std::sin(phi) * b;
            // cos a axis.z + sin a out.z = 0 at the horizon
            const float horizon = std::atan2(axis.z, -out.z);
            const float angle = alpha * std::sinh(share * std::asinh(horizon / alpha));
            glm::vec3 direction = std::cos(angle) * axis + std::sin(angle) * out;
            // Rounding must not put the edge below the horizon, where nothing is reflected.
            direction.z = std::max(direction.z, 1e-4f);
            add(glm::normalize(direction));
        }
    }
    const auto index = [&](int ring, int segment) {
        return static_cast<std::uint32_t>(1 + (ring - 1) * segments + segment % segments);
    };
    for (int segment = 0; segment < segments; ++segment)
        mesh.triangles.insert(mesh.triangles.end(), {0u, index(1, segment), index(1, segment + 1)});
    for (int ring = 1; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const std::uint32_t a = index(ring, segment), c = index(ring + 1, segment),
                                d = index(ring, segment + 1), e = index(ring + 1, segment + 1);
            mesh.triangles.insert(mesh.triangles.end(), {a, c, e, a, e, d});
        }
    computeNormals(mesh);
    return mesh;
}

} // namespace patina
