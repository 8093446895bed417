#include "tests/reference/PathReference.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina::reference {
namespace {

// Density cos / pi about the normal: a disc, raised to the hemisphere (Malley's method).
glm::dvec3 cosineDirection(const glm::dvec3& normal, const glm::dvec2& sample) {
    const double radius = std::sqrt(sample.x), angle = 2 * std::numbers::pi * sample.y;
    const glm::dvec3 side = glm::normalize(
        glm::cross(std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), normal));
    return glm::normalize(radius * std::cos(angle) * side +
                          radius * std::sin(angle) * glm::cross(normal, side) +
                          std::sqrt(std::max(0.0, 1.0 - sample.x)) * normal);
}

// The paths of one pixel, all of them one step at a time.
class PixelPaths {
  public:
    PixelPaths(const ReferenceScene& scene, std::span<const ReferenceLight> environments,
               const PathSettings& settings)
        : m_scene(scene)
        , m_environments(environments)
        , m_settings(settings)
        , m_sums(environments.size()) {}

    using Sums = std::vector<std::array<PathPictures::Pixel, kTransports>>; // [environment]

    // The paths of one of the places that share a pixel's samples.
    const Sums& trace(const Place& seen, std::uint32_t seed, std::uint32_t part) {
        for (auto& environment : m_sums)
            environment = {};
        m_paths.clear();
        const std::uint32_t count = std::uint32_t(m_settings.paths);
        for (std::uint32_t i = part * count; i < (part + 1) * count; ++i)
            m_paths.push_back({seen, seen.albedo / double(count), i});
        for (int bounce = 0; bounce <= m_settings.bounces && !m_paths.empty(); ++bounce)
            step(bounce, seedFor(seed, std::uint32_t(bounce)));
        return m_sums;
    }

  private:
    struct Path {
        Place place;
        glm::dvec3 weight;
        std::uint32_t index; // of its samples
    };

    // Irradiance is the mean over directions of density cos / pi, times pi; exit radiance albedo /
    // pi of that: what a path brings back counts with the albedos on its way.
    void step(int bounce, std::uint32_t seed) {
        for (std::size_t e = 0; e < m_environments.size(); ++e)
            addPicture(e, bounce, seedFor(seed, std::uint32_t(1 + e)));
        m_rays.clear();
        for (const Path& path : m_paths)
            m_rays.push_back(ReferenceScene::rayFrom(
                path.place,
                cosineDirection(path.place.normal, glm::dvec2(sobolOwen2D(path.index, seed)))));
        m_scene.intersect(m_rays);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < m_paths.size(); ++i) {
            const bool open = m_rays[i].mesh == ClosestRay::kNothing;
            if (open || bounce == 0)
                addBands(m_rays[i], m_paths[i].weight, bounce, open);
            if (open)
                continue;
            if (const std::optional<Place> next = m_scene.place(m_rays[i]))
                m_paths[kept++] = {*next, m_paths[i].weight * next->albedo, m_paths[i].index};
        }
        m_paths.resize(kept);
    }

    void add(std::size_t environment, std::size_t light, const glm::dvec3& radiance, int bounce,
             bool open) {
        auto& sums = m_sums[environment];
        if (bounce == 0)
            sums[std::size_t(Transport::Unshadowed)].light[light] += radiance;
        if (bounce == 0 && open)
            sums[std::size_t(Transport::Shadowed)].light[light] += radiance;
        if (open)
            sums[std::size_t(Transport::Interreflected)].light[light] += radiance;
    }

    // Sums of bands are smooth: the ray that goes on finds them well enough.
    void addBands(const ClosestRay& ray, const glm::dvec3& weight, int bounce, bool open) {
        const Basis basis = basisAt(glm::normalize(glm::dvec3(ray.ray.direction)));
        std::array<glm::dvec3, kLights> light;
        for (std::size_t e = 0; e < m_environments.size(); ++e) {
            m_environments[e].bands(basis, light);
            for (std::size_t i = 1; i < kLights; ++i)
                add(e, i, weight * light[i], bounce, open);
        }
    }

    // A sun is too small to be found by chance: rays of its own from every place.
    void addPicture(std::size_t environment, int bounce, std::uint32_t seed) {
        m_rays.clear();
        m_lights.clear();
        for (const Path& path : m_paths) {
            const ReferenceLight::Ray light =
                m_environments[environment].sample(glm::dvec2(sobolOwen2D(path.index, seed)));
            const double cosine = glm::dot(light.direction, path.place.normal);
            if (!(cosine > 0.0))
                continue;
            m_rays.push_back(ReferenceScene::rayFrom(path.place, light.direction));
            m_lights.push_back(path.weight * light.radiance *
                               (cosine / (std::numbers::pi * light.density)));
        }
        m_scene.intersect(m_rays);
        for (std::size_t i = 0; i < m_rays.size(); ++i)
            add(environment, 0, m_lights[i], bounce, m_rays[i].mesh == ClosestRay::kNothing);
    }

    const ReferenceScene& m_scene;
    std::span<const ReferenceLight> m_environments;
    PathSettings m_settings;
    Sums m_sums;
    std::vector<Path> m_paths;
    std::vector<ClosestRay> m_rays;
    std::vector<glm::dvec3> m_lights; // what each brings back
};

} // namespace

PathPictures tracePaths(const ReferenceScene& scene, std::span<const std::optional<Place>> places,
                        std::span<const ReferenceLight> environments,
                        const PathSettings& settings) {
    PathPictures pictures;
    pictures.pictures.resize(environments.size());
    for (auto& environment : pictures.pictures)
        for (auto& transport : environment)
            for (auto& half : transport)
                half.resize(places.size());
    const auto side = std::size_t(settings.side), width = std::size_t(settings.width);
    PathSettings each = settings;
    each.paths = std::max(1, settings.paths / (settings.side * settings.side));
    parallelFor({}, places.size(), 64, [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        PixelPaths paths(scene, environments, each);
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t half = 0; places[p] && half < 2; ++half) {
                const std::size_t x = p % width, y = p / width;
                const std::size_t pixel = y / side * width + x / side;
                const PixelPaths::Sums& sums = paths.trace(
                    *places[p], seedFor(settings.seed + std::uint32_t(half), std::uint32_t(pixel)),
                    std::uint32_t(y % side * side + x % side));
                for (std::size_t e = 0; e < environments.size(); ++e)
                    for (std::size_t t = 0; t < kTransports; ++t)
                        pictures.pictures[e][t][half][p] = sums[e][t];
            }
    });
    return pictures;
}

namespace {

std::vector<glm::dvec3> combined(const PathPictures& pictures, std::size_t environment,
                                 Transport transport, int light, double second) {
    const auto& halves = pictures.pictures[environment][std::size_t(transport)];
    std::vector<glm::dvec3> result;
    for (std::size_t p = 0; p < halves[0].size(); ++p)
        result.push_back(0.5 * (halves[0][p].light[std::size_t(light)] +
                                second * halves[1][p].light[std::size_t(light)]));
    return result;
}

} // namespace

std::vector<glm::dvec3> PathPictures::mean(std::size_t environment, Transport transport,
                                           int light) const {
    return combined(*this, environment, transport, light, 1.0);
}

std::vector<glm::dvec3> PathPictures::halfDifference(std::size_t environment, Transport transport,
                                                     int light) const {
    return combined(*this, environment, transport, light, -1.0);
}

} // namespace patina::reference
