#include "core/bake/lightmap/LightMapTexel.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {
namespace {

// Pairs of dimensions of a texel's samples, beside those of its paths.
enum Stream : std::uint32_t {
    kDiffusePath,
    kSpecularPath,
    kView,
    kSky,
    kSpecularSky,
    kLobe,
    kLobeChoice
};

// Of the lobe, from each direction of view: the hidden share is that of what they see together.
constexpr std::uint32_t kRaysPerView = 2;
// How much brighter than image-based light a lobe may be: noise in its estimate, mostly.
constexpr float kMostGain = 2.0f;
// Channels of the lobe's albedo below this reflect nothing that could be told from their rounding.
constexpr float kLeastAlbedo = 1e-3f;

const PathSettings kPaths; // no limit of bounces

std::uint32_t streamSeed(std::uint32_t seed, std::uint32_t texel, Stream stream) {
    return seedFor(seedFor(seed, texel), stream);
}

// Even over the hemisphere about a normal.
glm::vec3 uniformHemisphere(const glm::vec3& normal, const glm::vec2& u) {
    glm::vec3 t, b;
    orthonormalBasis(normal, t, b);
    const float sine = std::sqrt(std::max(1.0f - u.x * u.x, 0.0f));
    const float angle = 2.0f * shading::kPi * u.y;
    return glm::normalize(sine * std::cos(angle) * t + sine * std::sin(angle) * b + u.x * normal);
}

glm::vec3 cosineAbout(const glm::vec3& normal, const glm::vec2& u) {
    glm::vec3 t, b;
    orthonormalBasis(normal, t, b);
    const glm::vec3 local = cosineHemisphere(u);
    return glm::normalize(local.x * t + local.y * b + local.z * normal);
}

glm::vec3 mirrored(const shading::SurfaceTerms& terms) {
    return glm::normalize(2.0f * glm::dot(terms.n, terms.v) * terms.n - terms.v);
}

// How far nine harmonics can follow what a lobe of this roughness shows of an environment, 0…1.
float harmonicsTell(float perceptualRoughness) {
    const float x = std::clamp((perceptualRoughness - 0.2f) / 0.25f, 0.0f, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

} // namespace

LightMapTexel::LightMapTexel(const TraceScene& scene, const EnvironmentLookup& imageLight,
                             std::uint32_t seed)
    : m_scene(scene)
    , m_imageLight(imageLight)
    , m_seed(seed)
    , m_path(scene, kPaths)
    , m_indirect(scene, kPaths) {
    m_path.leaveOutFirstLights();
}

glm::vec3 LightMapTexel::drawnLight(const shading::SurfaceTerms& terms) const {
    return m_imageLight.prefiltered(terms.perceptualRoughness, m_scene.lobeDirection(terms))
        .value_or(glm::vec3(0.0f));
}

bool LightMapTexel::isOpen(const TracePoint& place, const glm::vec3& direction) {
    if (glm::dot(place.face, direction) <= 0.0f)
        return false;
    ++m_rays;
    return !m_scene.occluded(TraceScene::origin(place), direction,
                             std::numeric_limits<float>::infinity());
}

std::optional<shading::SurfaceTerms>
LightMapTexel::look(const TracePoint& place, std::uint32_t index, std::uint32_t sample) const {
    const glm::vec3 v =
        uniformHemisphere(place.normal, sobolOwen2D(sample, streamSeed(m_seed, index, kView)));
    if (glm::dot(place.face, v) <= 0.0f)
        return std::nullopt;
    // The specular lobe alone.
    shading::SurfaceTerms terms = m_scene.surface(place, v);
    terms.diffuseColor = terms.diffuseAlbedo = terms.clearColor = glm::vec3(0.0f);
    return terms;
}

void LightMapTexel::traceDiffuse(const TracePoint& place, std::uint32_t index, std::uint32_t sample,
                                 LightMapSums& sums) {
    // A white surface without gloss, as for traceIrradiance().
    shading::BrdfModel model = shading::defaultBrdfModel();
    model.fresnel = shading::kFresnelDielectric;
    model.ior = 1.0f;
    TraceSurface white;
    white.opaque = shading::makeSurface(model, {glm::vec3(1.0f), 0.0f, 1.0f, 0.0f}, place.normal,
                                        place.normal, glm::vec2(0.0f));
    const glm::vec3 radiance =
        m_path.follow(place, white, PathSequence(sample, streamSeed(m_seed, index, kDiffusePath)))
            .radiance;
    if (const float brightness = shading::kPi * shading::luminance(radiance);
        std::isfinite(brightness)) {
        sums.irradiance += shading::kPi * radiance;
        sums.squares.x += brightness * brightness;
    }
    const glm::vec3 sky =
        cosineAbout(place.normal, sobolOwen2D(sample, streamSeed(m_seed, index, kSky)));
    if (isOpen(place, sky)) {
        sums.open += sky;
        sums.visible += 1.0f;
    }
}

void LightMapTexel::traceSpecular(const TracePoint& place, const shading::SurfaceTerms& terms,
                                  std::uint32_t index, std::uint32_t sample, LightMapSums& sums) {
    // Light of the environment that the lobe reflects, by rays of both: all, and what is hidden.
    float all = 0.0f, hidden = 0.0f, hiddenRays = 0.0f;
    glm::vec3 reflected(0.0f); // of surfaces
    for (std::uint32_t k = 0; k < kRaysPerView; ++k) {
        const std::uint32_t ray = sample * kRaysPerView + k;
        if (m_scene.hasEnvironment()) {
            const EnvironmentSampler::Sample sky = m_scene.sampleEnvironment(
                sobolOwen2D(ray, streamSeed(m_seed, index, kSpecularSky)));
            if (sky.pdf > 0.0f) {
                const float light = shading::luminance(
                    shading::shadeDirect(terms, sky.direction, sky.radiance).specular);
                const float lobe = shading::brdfPdf(terms, sky.direction);
                const float share = sky.pdf / (sky.pdf * sky.pdf + lobe * lobe) * light;
                if (share > 0.0f) {
                    all += share;
                    hidden += isOpen(place, sky.direction) ? 0.0f : share;
                }
            }
        }
        float pdf = 0.0f;
        const glm::vec3 l =
            sampleBrdf(terms,
                       glm::vec3(sobolOwen2D(ray, streamSeed(m_seed, index, kLobe)),
                                 sobolOwen2D(ray, streamSeed(m_seed, index, kLobeChoice)).x),
                       pdf);
        if (!(pdf > 0.0f))
            continue;
        const glm::vec3 lobe = shading::shadeDirect(terms, l, glm::vec3(1.0f)).specular / pdf;
        const float sky = m_scene.environmentPdf(l);
        const float share = shading::luminance(lobe * m_scene.environmentRadiance(l)) *
                            (pdf * pdf / (pdf * pdf + sky * sky));
        all += share;
        ClosestRay hit;
        const bool below = glm::dot(place.face, l) <= 0.0f;
        if (!below) {
            ++m_rays;
            hit = m_scene.closest(TraceScene::origin(place), l);
            if (hit.mesh == ClosestRay::kNothing)
                continue;
        }
        hidden += share;
        hiddenRays += 1.0f;
        if (below || k > 0)
            continue;
        // Of surfaces by one ray alone: a path goes on from there.
        if (const TracePoint seen = m_scene.pointAt(hit); seen.hasSurface()) {
            const glm::vec3 radiance =
                seen.emission() +
                m_indirect
                    .follow(seen, m_scene.surfaceIn(seen, -l, Media()),
                            PathSequence(sample, streamSeed(m_seed, index, kSpecularPath)))
                    .radiance;
            if (std::isfinite(shading::luminance(radiance)))
                reflected = lobe * radiance;
        }
    }
    const glm::vec3 albedo = glm::max(terms.specularAlbedo, glm::vec3(kLeastAlbedo));
    const glm::vec3 light = reflected / albedo;
    float open = 1.0f - (all > 0.0f ? hidden / all : hiddenRays / static_cast<float>(kRaysPerView));
    if (const float told = harmonicsTell(terms.perceptualRoughness); told > 0.0f && open > 0.0f) {
        // What the lobe reflects against what image-based light has for it.
        const float drawn = shading::luminance(terms.specularAlbedo * drawnLight(terms)) *
                            static_cast<float>(kRaysPerView);
        if (drawn > 0.0f)
            open *= glm::mix(1.0f, std::min(all / drawn, kMostGain), told);
    }
    const float share = 1.0f - open;
    const glm::vec4 value(light, share);
    const LightMapBasis basis = lightMapBasis(mirrored(terms));
    for (std::size_t j = 0; j < kLightMapTerms; ++j)
        sums.specular[j] += basis[j] * value;
    const float brightness = shading::luminance(light);
    sums.squares.y += brightness * brightness;
    sums.squares.z += share * share;
    sums.means += glm::vec2(brightness, share);
    sums.views += 1.0f;
}

void LightMapTexel::trace(std::span<const TracePoint> places, std::uint32_t index,
                          std::uint32_t first, std::uint32_t count, LightMapSums& sums) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        const TracePoint& place = places[i % places.size()];
        traceDiffuse(place, index, i, sums);
        if (const std::optional<shading::SurfaceTerms> terms = look(place, index, i))
            traceSpecular(place, *terms, index, i, sums);
    }
}

LightMapTexture::Texel LightMapTexel::finish(std::span<const TracePoint> places,
                                             std::uint32_t count, const LightMapSums& sums) const {
    LightMapTexture::Texel result;
    const float samples = static_cast<float>(count);
    glm::vec3 drawn(0.0f);
    for (const TracePoint& place : places)
        drawn += m_imageLight.irradiance(place.normal).value_or(glm::vec3(0.0f));
    drawn /= static_cast<float>(places.size());
    result.values.front() = glm::vec4(sums.irradiance / samples - drawn,
                                      std::clamp(sums.visible / samples, 0.0f, 1.0f));
    result.values.back() = glm::vec4(sums.open / samples, 0.0f);
    result.position = places.front().position;
    result.normal = places.front().normal;

    if (sums.views > 0.0f)
        for (std::size_t j = 0; j < kLightMapTerms; ++j)
            result.values[1 + j] = sums.specular[j] / sums.views;

    // Of the means.
    const auto variance = [](float squares, float sum, float n) {
        return n > 1.0f ? std::max(squares / n - sum * sum / (n * n), 0.0f) / (n - 1.0f) : 0.0f;
    };
    constexpr float kY0 = 0.0795775f; // Y_0², 1 / 4 pi
    result.variance = {variance(sums.squares.x, shading::luminance(sums.irradiance), samples),
                       kY0 * variance(sums.squares.y, sums.means.x, sums.views),
                       kY0 * variance(sums.squares.z, sums.means.y, sums.views)};
    return result;
}

} // namespace patina
