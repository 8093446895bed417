#include "tests/reference/PictureReference.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/DfgTable.h"
#include "core/light/Lights.h"
#include "core/material/BrdfModel.h"
#include "tests/reference/PictureSampling.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

namespace patina::reference {
namespace {

constexpr int kDfgSize = static_cast<int>(shading::kDfgTableSize);
// Above the rounding of positions (6e-8), below what can be seen; scene units.
constexpr double kLeaves = 1e-5;
// From the third surface on paths end by chance.
constexpr int kCertainSurfaces = 3;

} // namespace

// A place on a surface, seen from the side of `face`.
struct PictureReference::Place {
    std::size_t mesh = 0;
    glm::dvec3 position{0.0}; // scene units
    glm::dvec3 face{0.0}, normal{0.0};
    glm::vec2 uv{0.0f};
    bool isBack = false;
};

Result<PictureReference> PictureReference::create(TraceInputs inputs, std::vector<SkyPart> bright) {
    PictureReference result;
    result.m_inputs = std::move(inputs);
    result.m_bright = std::move(bright);
    BakeInputs solid;
    for (const TraceMesh& mesh : result.m_inputs.meshes) {
        if (mesh.mesh->indices.empty())
            continue; // as makeBakeGeometry() does
        solid.meshes.push_back({mesh.id, 0, mesh.mesh, mesh.transform, true, {}});
        result.m_materials.push_back(mesh.material);
    }
    Result<BakeGeometry> geometry = makeBakeGeometry(solid, {});
    if (!geometry)
        return geometry.error();
    result.m_geometry = std::make_unique<BakeGeometry>(*std::move(geometry));
    Result<RayScene> rays = RayScene::build(*result.m_geometry, {});
    if (!rays)
        return rays.error();
    result.m_rays = std::make_unique<RayScene>(*std::move(rays));
    const ShadingModel& model = result.m_inputs.model;
    const Image table = computeDfgTable(kDfgSize, model.distribution,
                                        iblVisibility(model.visibility), DfgTexels::ToTheEnds);
    for (std::size_t i = 0; i < table.f32().size(); i += 3)
        result.m_dfg.emplace_back(table.f32()[i], table.f32()[i + 1]);
    result.collectGlow();
    return result;
}

void PictureReference::collectGlow() {
    double sum = 0.0;
    for (std::size_t m = 0; m < m_geometry->meshes.size(); ++m) {
        const BakeGeometryMesh& mesh = m_geometry->meshes[m];
        if (material(m).emissive * material(m).emissiveStrength == glm::vec3(0.0f))
            continue;
        const std::vector<std::uint32_t>& corner = mesh.mesh->indices;
        for (std::size_t i = 0; i < corner.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[corner[i]]), b(mesh.positions[corner[i + 1]]),
                c(mesh.positions[corner[i + 2]]);
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a)) /
                                (m_geometry->unitsPerMetre * m_geometry->unitsPerMetre);
            m_glow.push_back({m, static_cast<std::uint32_t>(i / 3), sum += area, area});
        }
    }
}

const Material& PictureReference::material(std::size_t mesh) const {
    return m_inputs.materials[m_materials[mesh]];
}

// Lat-long pictures, bilinear between the centres of their pixels, turned counter-clockwise about
// +Y as seen from above.
glm::dvec3 PictureReference::sky(const glm::dvec3& d) const {
    glm::dvec3 sum(0.0);
    for (const TraceEnvironment& environment : m_inputs.environments) {
        const Image& image = *environment.image;
        const double turn = glm::radians(static_cast<double>(environment.orientation.rotationDeg));
        CHECK(environment.orientation.isLevel());
        const double x = std::cos(turn) * d.x - std::sin(turn) * d.z;
        const double z = std::sin(turn) * d.x + std::cos(turn) * d.z;
        const double u = (0.5 + std::atan2(x, -z) / (2.0 * pi)) * image.width() - 0.5;
        const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * image.height() - 0.5;
        const double fu = u - std::floor(u), fv = v - std::floor(v);
        const auto texel = [&](double column, double row) {
            const auto i = static_cast<std::size_t>(static_cast<int>(column) + image.width()) %
                           static_cast<std::size_t>(image.width());
            const auto j = static_cast<std::size_t>(std::clamp(row, 0.0, image.height() - 1.0));
            const float* p =
                image.f32().data() + (j * static_cast<std::size_t>(image.width()) + i) *
                                         static_cast<std::size_t>(image.channels());
            return glm::dvec3(p[0], p[1], p[2]);
        };
        const double i = std::floor(u), j = std::floor(v);
        sum += glm::dvec3(environment.scale) *
               glm::mix(glm::mix(texel(i, j), texel(i + 1, j), fu),
                        glm::mix(texel(i, j + 1), texel(i + 1, j + 1), fu), fv);
    }
    return sum;
}

bool PictureReference::isBright(const glm::dvec3& direction) const {
    return std::ranges::any_of(m_bright, [&](const SkyPart& part) {
        return glm::dot(direction, part.axis) >= part.cosHalfAngle;
    });
}

PictureReference::Place PictureReference::placeOf(std::size_t meshIndex, std::uint32_t triangle,
                                                  double b1, double b2) const {
    const BakeGeometryMesh& mesh = m_geometry->meshes[meshIndex];
    const std::uint32_t* corner = mesh.mesh->indices.data() + std::size_t{3} * triangle;
    const double weight[3] = {1.0 - b1 - b2, b1, b2};
    Place place;
    place.mesh = meshIndex;
    for (int i = 0; i < 3; ++i) {
        place.position += weight[i] * glm::dvec3(mesh.positions[corner[i]]);
        place.normal += weight[i] * glm::dvec3(mesh.normals[corner[i]]);
        place.uv += static_cast<float>(weight[i]) * mesh.mesh->uvs[corner[i]];
    }
    place.normal = glm::normalize(place.normal);
    const glm::dvec3 a(mesh.positions[corner[0]]), b(mesh.positions[corner[1]]),
        c(mesh.positions[corner[2]]);
    place.face = static_cast<double>(mesh.winding) * glm::normalize(glm::cross(b - a, c - a));
    return place;
}

// One after the other, of one thread.
class PictureReference::Path {
  public:
    Path(const PictureReference& scene, std::uint64_t seed)
        : m_scene(scene)
        , m_model(brdfModel(scene.m_inputs.model))
        , m_random(seed) {}

    double number() { return m_random(); }
    glm::dvec3 radiance(glm::dvec3 origin, glm::dvec3 direction) {
        glm::dvec3 sum(0.0), weight(1.0);
        for (int surface = 0;; ++surface) {
            const std::optional<Place> met = next(origin, direction, surface == 0);
            if (!met) {
                const bool foundByRay = surface > 0 && m_scene.isBright(direction);
                return foundByRay ? sum : sum + weight * m_scene.sky(direction);
            }
            const Material& material = m_scene.material(met->mesh);
            if (met->isBack && !material.doubleSided)
                return sum; // absorbed
            if (surface == 0)
                sum += glowOf(material, met->uv);
            const shading::SurfaceTerms terms = surfaceOf(*met, -direction);
            sum += weight * fromLights(*met, terms);
            const double density = goOn(*met, terms, direction);
            if (!(density > 0.0))
                return sum;
            weight *= reflects(*met, terms, direction) / density;
            if (surface >= kCertainSurfaces) {
                const double stays =
                    std::clamp(std::max({weight.x, weight.y, weight.z}), 0.05, 0.95);
                if (m_random() >= stays)
                    return sum;
                weight /= stays;
            }
            if (weight == glm::dvec3(0.0))
                return sum;
            origin = met->position + kLeaves * met->face;
        }
    }

  private:
    ClosestRay cast(const glm::dvec3& origin, const glm::dvec3& direction) const {
        ClosestRay ray;
        ray.ray.origin = glm::vec3(origin);
        ray.ray.direction = glm::vec3(direction);
        (void)m_scene.m_rays->intersect({&ray, 1});
        return ray;
    }
    Place placeAt(const ClosestRay& hit, const glm::dvec3& direction) const {
        Place place = m_scene.placeOf(hit.mesh, hit.triangle, static_cast<double>(hit.u),
                                      static_cast<double>(hit.v));
        if (glm::dot(place.face, direction) > 0.0) {
            place.isBack = true;
            place.face = -place.face;
            place.normal = -place.normal;
        }
        return place;
    }

    // The camera sees through backs that are none.
    std::optional<Place> next(glm::dvec3 origin, const glm::dvec3& direction, bool fromCamera) {
        for (;;) {
            const ClosestRay hit = cast(origin, direction);
            if (hit.mesh == ClosestRay::kNothing)
                return std::nullopt;
            const Place place = placeAt(hit, direction);
            const Material& material = m_scene.material(place.mesh);
            const bool passes = fromCamera && place.isBack && !material.doubleSided;
            if (!passes && m_random() < alphaOf(material, place.uv))
                return place;
            origin = place.position - kLeaves * place.face;
        }
    }

    // Share of light that arrives from so far, in scene units.
    double arriving(const Place& from, const glm::dvec3& direction, double distance) const {
        glm::dvec3 origin = from.position + kLeaves * from.face;
        const glm::dvec3 start = origin;
        double left = 1.0;
        while (left > 0.0) {
            const ClosestRay hit = cast(origin, direction);
            if (hit.mesh == ClosestRay::kNothing)
                return left;
            const Place place = placeAt(hit, direction);
            if (glm::length(place.position - start) >= distance)
                return left;
            left *= 1.0 - alphaOf(m_scene.material(place.mesh), place.uv);
            origin = place.position - kLeaves * place.face;
        }
        return 0.0;
    }

    shading::SurfaceTerms surfaceOf(const Place& place, const glm::dvec3& v) const {
        const Material& material = m_scene.material(place.mesh);
        shading::SurfaceInputs inputs;
        inputs.baseColor = glm::clamp(
            material.baseColor * glm::vec3(mapAt(material.baseColorMap, place.uv)), 0.0f, 1.0f);
        inputs.metallic = material.metallic;
        inputs.perceptualRoughness = material.perceptualRoughness;
        inputs.diffuseRoughness = material.diffuseRoughness;
        inputs.ior = material.ior;
        // The table, bilinear between entries at i / (size - 1).
        const double NoV =
            std::clamp(glm::dot(place.normal, v), static_cast<double>(shading::kMinNoV), 1.0);
        const double x = NoV * (kDfgSize - 1);
        const double y =
            std::clamp(static_cast<double>(inputs.perceptualRoughness), 0.0, 1.0) * (kDfgSize - 1);
        const auto i = std::min(static_cast<std::size_t>(x), std::size_t{kDfgSize - 2}),
                   j = std::min(static_cast<std::size_t>(y), std::size_t{kDfgSize - 2});
        const glm::dvec2* entry = m_scene.m_dfg.data() + j * kDfgSize + i;
        const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
        const glm::dvec2 dfg = glm::mix(glm::mix(entry[0], entry[1], fx),
                                        glm::mix(entry[kDfgSize], entry[kDfgSize + 1], fx), fy);
        return shading::makeSurface(m_model, inputs, glm::vec3(place.normal), glm::vec3(v),
                                    glm::vec2(dfg));
    }

    // BRDF times cosine: light counts that comes from the front of the triangle and of the normal.
    static glm::dvec3 reflects(const Place& place, const shading::SurfaceTerms& terms,
                               const glm::dvec3& l) {
        if (!(glm::dot(place.face, l) > 0.0))
            return glm::dvec3(0.0);
        const shading::ShadedLight light =
            shading::shadeDirect(terms, glm::vec3(l), glm::vec3(1.0f));
        return glm::dvec3(light.diffuse + light.specular);
    }

    // Sets a direction, returns its density; 0: there is nothing to go on for.
    double goOn(const Place& place, const shading::SurfaceTerms& terms, glm::dvec3& direction) {
        const glm::dvec3 v(terms.v), n = place.normal;
        const double alpha = static_cast<double>(terms.alpha), a2 = alpha * alpha;
        glm::dvec3 l;
        if (m_random() < 0.5) {
            l = about(n, std::sqrt(m_random()), 2.0 * pi * m_random());
        } else {
            const double u = m_random();
            const glm::dvec3 h =
                about(n, std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), 2.0 * pi * m_random());
            l = glm::normalize(2.0 * glm::dot(v, h) * h - v);
        }
        const double NoL = glm::dot(n, l);
        direction = l;
        if (NoL <= 0.0)
            return 0.0;
        const glm::dvec3 h = glm::normalize(v + l);
        const double NoH = glm::dot(n, h), VoH = std::abs(glm::dot(v, h));
        const double ofFacets = NoH > 0.0 ? facets(NoH, alpha) * NoH / (4.0 * VoH) : 0.0;
        return 0.5 * NoL / pi + 0.5 * ofFacets;
    }

    glm::dvec3 fromLights(const Place& place, const shading::SurfaceTerms& terms) {
        glm::dvec3 sum(0.0);
        for (const Light& light : m_scene.m_inputs.lights)
            sum += fromLight(light, place, terms);
        for (const SkyPart& part : m_scene.m_bright) {
            const glm::dvec3 l = inCone(part.axis, part.cosHalfAngle, m_random);
            if (const glm::dvec3 value = reflects(place, terms, l) * m_scene.sky(l);
                value != glm::dvec3(0.0))
                sum += value * (coneAngle(part.cosHalfAngle) * arriving(place, l, kFar));
        }
        if (!m_scene.m_glow.empty())
            sum += fromGlow(place, terms);
        return sum;
    }

    // Radiance of a surface element there, times area: L A cos / d² of irradiance.
    glm::dvec3 fromArea(const Place& place, const shading::SurfaceTerms& terms,
                        const glm::dvec3& toPoint, double cosineTimesArea,
                        const glm::dvec3& radiance, double shorter) {
        const double d = glm::length(toPoint);
        const glm::dvec3 l = toPoint / d;
        const glm::dvec3 value = reflects(place, terms, l) * radiance * (cosineTimesArea / (d * d));
        if (value == glm::dvec3(0.0))
            return value;
        return value * arriving(place, l, d * m_scene.m_geometry->unitsPerMetre - shorter);
    }

    glm::dvec3 fromLight(const Light& light, const Place& place,
                         const shading::SurfaceTerms& terms) {
        const glm::dvec3 power(lightPower(light));
        const double unitsPerMetre = m_scene.m_geometry->unitsPerMetre;
        const glm::dvec3 world = m_scene.m_geometry->centre + place.position / unitsPerMetre;
        const bool casts = !canCastShadow(light.type) || light.castsShadow;
        const glm::dvec3 axis(light.directionToLight());
        const glm::dvec3 toCentre = glm::dvec3(light.position) - world;
        if (light.type == LightType::Directional) {
            const double half = glm::radians(0.5 * static_cast<double>(light.shadowSoftness));
            const glm::dvec3 l =
                casts && half > 0.0 ? inCone(axis, std::cos(half), m_random) : axis;
            // An even disc in the sky gives E to a surface that faces its centre.
            const double even = casts && half > 0.0 ? coneAngle(std::cos(half)) /
                                                          (pi * std::sin(half) * std::sin(half))
                                                    : 1.0;
            return reflects(place, terms, l) * power *
                   (even * (casts ? arriving(place, l, kFar) : 1.0));
        }
        if (light.type == LightType::Sphere) {
            // The half that faces the place holds all that is seen.
            const double radius = static_cast<double>(light.radius);
            const glm::dvec3 n = inCone(-glm::normalize(toCentre), 0.0, m_random);
            const glm::dvec3 to = toCentre + radius * n;
            const double cosine = std::max(-glm::dot(n, glm::normalize(to)), 0.0);
            return fromArea(place, terms, to, cosine * 2.0 * pi * radius * radius, power, 0.0);
        }
        if (light.type == LightType::Rectangle) {
            const RectangleAxes axes = rectangleAxes(light);
            const glm::dvec3 to =
                toCentre +
                (m_random() - 0.5) * static_cast<double>(light.width) * glm::dvec3(axes.x) +
                (m_random() - 0.5) * static_cast<double>(light.height) * glm::dvec3(axes.y);
            const double cosine = std::max(glm::dot(axis, glm::normalize(to)), 0.0);
            return fromArea(place, terms, to,
                            cosine * static_cast<double>(light.width) *
                                static_cast<double>(light.height),
                            power, 0.0);
        }
        // A point or spot: I / d², windowed by range and cone.
        const double d = glm::length(toCentre);
        const glm::dvec3 l = toCentre / d;
        double reaches = 1.0 / (d * d);
        if (light.range > 0.0f) {
            const double x = d / static_cast<double>(light.range);
            reaches *= std::clamp(1.0 - x * x * x * x, 0.0, 1.0);
        }
        if (light.type == LightType::Spot) {
            const double outer = std::cos(glm::radians(static_cast<double>(light.outerConeDeg)));
            const double inner = std::cos(glm::radians(static_cast<double>(light.innerConeDeg)));
            const double x = std::clamp((glm::dot(axis, l) - outer) / (inner - outer), 0.0, 1.0);
            reaches *= x * x;
        }
        return reflects(place, terms, l) * power *
               (reaches * (casts ? arriving(place, l, d * unitsPerMetre) : 1.0));
    }

    glm::dvec3 fromGlow(const Place& place, const shading::SurfaceTerms& terms) {
        const std::vector<GlowingTriangle>& all = m_scene.m_glow;
        const double area = all.back().areaBefore, at = m_random() * area;
        const GlowingTriangle& chosen = *std::ranges::lower_bound(
            all, at, {}, [](const GlowingTriangle& triangle) { return triangle.areaBefore; });
        const double root = std::sqrt(m_random()), along = m_random();
        const Place source =
            m_scene.placeOf(chosen.mesh, chosen.triangle, root * (1.0 - along), root * along);
        const Material& material = m_scene.material(chosen.mesh);
        const glm::dvec3 to =
            (source.position - place.position) / m_scene.m_geometry->unitsPerMetre;
        double cosine = -glm::dot(source.face, glm::normalize(to));
        if (material.doubleSided)
            cosine = std::abs(cosine);
        if (!(cosine > 0.0))
            return glm::dvec3(0.0);
        return fromArea(place, terms, to, cosine * area,
                        alphaOf(material, source.uv) * glowOf(material, source.uv),
                        3.0 * kLeaves / cosine);
    }

    static constexpr double kFar = 1e9;

    const PictureReference& m_scene;
    shading::BrdfModel m_model;
    SplitMix m_random;
};

std::vector<glm::dvec3> PictureReference::look(const Camera& camera, int width, int height,
                                               int paths, std::uint64_t seed) const {
    const double tangent = std::tan(0.5 * glm::radians(static_cast<double>(camera.fovDeg)));
    const glm::dvec3 eye =
        (glm::dvec3(camera.position()) - m_geometry->centre) * m_geometry->unitsPerMetre;
    std::vector<glm::dvec3> picture(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
    parallelFor({}, picture.size(), 64, [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        for (std::size_t p = begin; p < end; ++p) {
            const auto x = static_cast<double>(p % static_cast<std::size_t>(width)),
                       y = static_cast<double>(p / static_cast<std::size_t>(width));
            SplitMix seeds(seed);
            Path path(*this, seeds.bits() ^ SplitMix(p + 1).bits());
            for (int i = 0; i < paths; ++i) {
                const double right = tangent * (2.0 * (x + path.number()) - width) / height;
                const double up = tangent * (1.0 - 2.0 * (y + path.number()) / height);
                picture[p] += path.radiance(eye, glm::normalize(glm::dvec3(camera.forward()) +
                                                                right * glm::dvec3(camera.right()) +
                                                                up * glm::dvec3(camera.up()))) /
                              static_cast<double>(paths);
            }
        }
    });
    return picture;
}

} // namespace patina::reference
