// Irradiance by its definition: a sum over every pixel of the lat-long picture, which knows nothing
// of cubes, levels or harmonics.
#pragma once

#include "core/job/Parallel.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Sampling.h"
#include "tests/core/light/EnvironmentSum.h"
#include "tests/core/light/LatLongPicture.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

namespace patina::reference {

// E(n) = Σ L max(0, n·d) dω of an F32 picture with three channels or more, for each unit vector n.
inline std::vector<glm::vec3> irradianceSums(const Image& picture,
                                             const std::vector<glm::vec3>& normals) {
    const LatLongGrid grid(picture.width(), picture.height());
    std::vector<glm::vec3> result(normals.size());
    parallelFor({}, normals.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 n(normals[i]);
            glm::dvec3 sum(0.0);
            const float* texel = picture.f32().data();
            for (int y = 0; y < picture.height(); ++y) {
                const double solidAngle = grid.solidAngle(y);
                for (int x = 0; x < picture.width(); ++x, texel += picture.channels()) {
                    const double cosine = glm::dot(n, grid.direction(x, y));
                    if (cosine > 0.0)
                        sum += cosine * solidAngle * glm::dvec3(texel[0], texel[1], texel[2]);
                }
            }
            result[i] = glm::vec3(sum);
        }
    });
    return result;
}

// Evenly spread, and as many close to the axes of the cube, where faces meet.
inline std::vector<glm::vec3> irradianceNormals(std::uint32_t count) {
    std::vector<glm::vec3> normals;
    for (std::uint32_t i = 0; i < count; ++i)
        normals.push_back(uniformSphere(sobolOwen2D(i, 21)));
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner((i & 1u) != 0 ? 1.0f : -1.0f, (i & 2u) != 0 ? 1.0f : -1.0f,
                               (i & 4u) != 0   ? 1.0f
                               : (i & 8u) != 0 ? -1.0f
                                               : 0.0f);
        normals.push_back(glm::normalize(corner + 0.05f * uniformSphere(sobolOwen2D(i, 22))));
    }
    return normals;
}

// lookupEnvironments() and, but where files are asked for, a dark room with one window: light from
// one side, which nine coefficients make negative on the other.
inline std::vector<NamedEnvironment> irradianceEnvironments() {
    std::vector<NamedEnvironment> all = lookupEnvironments();
    if (!std::getenv("PATINA_PREFILTER_HDR"))
        all.push_back({"window", patina::test::latLong(512, 256, [](const glm::vec3& d) {
                           const bool window = std::abs(d.y - 0.2f) < 0.12f && d.x > 0.95f;
                           return window ? glm::vec3(90.0f, 100.0f, 120.0f)
                                         : glm::vec3(0.04f, 0.03f, 0.025f) * (1.2f + d.y);
                       })});
    return all;
}

// Of irradianceNormals(): differences of the channel that differs most, over the root mean square
// of the exact irradiance (rms), and over its own brightest channel (most).
inline LookupError irradianceErrors(const std::vector<glm::vec3>& seen,
                                    const std::vector<glm::vec3>& exact) {
    LookupError error;
    double all = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const glm::vec3 off = glm::abs(seen[i] - exact[i]);
        const double most = std::max({off.x, off.y, off.z});
        const double own = std::max({exact[i].x, exact[i].y, exact[i].z});
        error.most = std::max(error.most, most / own);
        error.rms += most * most;
        all += own * own;
    }
    error.rms = std::sqrt(error.rms / all);
    return error;
}

} // namespace patina::reference
