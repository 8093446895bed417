#include "app/editor/widget/SpherePicture.h"

#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr glm::vec3 kViewer{0.0f, 0.0f, 1.0f};

glm::vec3 prefiltered(const IblMaps& maps, const glm::vec3& direction, float perceptualRoughness) {
    const LevelPair levels = levelsOf(maps, perceptualRoughness);
    return glm::mix(sampleCube(maps.prefiltered[levels.first], direction),
                    sampleCube(maps.prefiltered[levels.second], direction), levels.share);
}

QRgb displayed(const glm::vec3& radiance, const View& view, float coverage) {
    const bool known = !needsLuminance(view) && view.toneMap != ToneMap::OpenColorIo;
    const ToneMap toneMap = known ? view.toneMap : ToneMap::PbrNeutral;
    const float exposure = known ? std::exp2(view.exposureEv) : 1.0f;
    const glm::vec3 shown = shading::displayEncode(
        shading::toneMap(radiance * exposure, {static_cast<int>(toneMap), 1.0f, 0.0f,
                                               view.exponentialK, view.reinhardPerChannel ? 1 : 0}),
        static_cast<int>(view.displayTransfer), view.displayGamma);
    // Premultiplied by how much of the pixel the ball covers.
    const glm::vec3 bytes = glm::clamp(shown, 0.0f, 1.0f) * (255.0f * coverage) + 0.5f;
    return qRgba(static_cast<int>(bytes.r), static_cast<int>(bytes.g), static_cast<int>(bytes.b),
                 static_cast<int>(255.0f * coverage + 0.5f));
}

} // namespace

glm::vec3 sphereRadiance(const BrdfLens& lens, const SphereLight& light, const glm::vec3& n) {
    const shading::SurfaceTerms s = lens.surface(n, kViewer);
    const shading::ShadedLight direct =
        shading::shadeDirect(s, light.toLight, glm::vec3(light.illuminance));
    glm::vec3 radiance = direct.diffuse + direct.specular;
    if (!light.maps)
        return radiance;
    const glm::vec3 irradiance = sampleIrradiance(*light.maps, light.orientation.toPicture(n));
    const glm::vec3 mirrored = prefiltered(
        *light.maps, light.orientation.toPicture(shading::lobeDirection(s, lens.dfg(s.NoV).z)),
        s.perceptualRoughness);
    const shading::ShadedLight ambient = shading::shadeEnvironment(s, irradiance, mirrored);
    return radiance + std::exp2(light.exposureEv) * (ambient.diffuse + ambient.specular);
}

QImage spherePicture(const BrdfLens& lens, const SphereLight& light, int side) {
    if (side < 4)
        return {};
    QImage picture(side, side, QImage::Format_ARGB32_Premultiplied);
    picture.fill(Qt::transparent);
    const float radius = 0.5f * static_cast<float>(side) - 1.0f;
    const float middle = 0.5f * static_cast<float>(side);
    uchar* const bits = picture.bits();
    const auto stride = static_cast<std::size_t>(picture.bytesPerLine());
    parallelFor(
        JobContext(), static_cast<std::size_t>(side), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) {
                auto* row = reinterpret_cast<QRgb*>(bits + y * stride);
                for (int x = 0; x < side; ++x) {
                    glm::vec2 at((static_cast<float>(x) + 0.5f - middle) / radius,
                                 (middle - static_cast<float>(y) - 0.5f) / radius);
                    const float distance = glm::length(at);
                    const float coverage =
                        std::clamp((1.0f - distance) * radius + 0.5f, 0.0f, 1.0f);
                    if (coverage <= 0.0f)
                        continue;
                    // The rim is seen at grazing angles, never from behind.
                    at *= std::min(1.0f, 0.9995f / std::max(distance, 1e-6f));
                    const glm::vec3 n(at, std::sqrt(std::max(1.0f - glm::dot(at, at), 0.0f)));
                    row[x] = displayed(sphereRadiance(lens, light, n), light.view, coverage);
                }
            }
        });
    return picture;
}

} // namespace patina::editor
