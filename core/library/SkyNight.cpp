// A city at night: dark blue sky with a haze over the roofs, lit windows, street lamps and signs in
// several colours. Small bright lights show what a material's lobe looks like.
#include "core/library/Directions.h"
#include "core/library/Noise.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina::library {

namespace {

constexpr int kBlocks = 64; // buildings around the horizon

// Height in degrees of the roof line at u; neighbouring blocks differ.
float roofElevation(float u) {
    u += 0.5f / kBlocks; // no wall exactly at the picture's border
    u -= u >= 1.0f ? 1.0f : 0.0f;
    const float position = u * kBlocks;
    const auto block = static_cast<std::uint32_t>(position) % kBlocks;
    const float near = hashToFloat(hashInt(block, 1u, 221u));
    const auto wide = static_cast<std::uint32_t>(u * 20.0f) % 20u;
    const float far = hashToFloat(hashInt(wide, 2u, 222u));
    return 1.2f + 5.0f * near * near + 7.5f * far * far * far;
}

glm::vec3 windowColor(std::uint32_t h) {
    static const std::array<glm::vec3, 4> colors = {
        glm::vec3(1.0f, 0.62f, 0.26f), glm::vec3(1.0f, 0.78f, 0.48f), glm::vec3(0.75f, 0.9f, 1.0f),
        glm::vec3(1.0f, 0.5f, 0.18f)};
    return colors[h & 3u];
}

void addGlow(SkyCanvas& canvas, const glm::vec3& center, const glm::vec3& radiance) {
    const double centerElevation = 90.0 - acosPortable(center.y) * 180.0 / kPi;
    canvas.forRows(0, kSkyHeight, [&](int y) {
        const double elevation = 90.0 - (y + 0.5) * 180.0 / kSkyHeight;
        if (std::fabs(elevation - centerElevation) > 15.0)
            return;
        for (int x = 0; x < kSkyWidth; ++x) {
            const float cosine = glm::dot(canvas.direction(x, y), center);
            if (cosine < 0.97f) // 14°
                continue;
            // 1 - cos is half the angle's square: a tail that falls with the square and ends
            // softly.
            const float t = (1.0f - cosine) / 0.03f;
            const float fall = (1.0f - t) * (1.0f - t) / (1.0f + 90.0f * t);
            canvas.pixel(x, y) += radiance * fall;
        }
    });
}

// A few hundred dim stars, each less than a texel wide.
void addStars(SkyCanvas& canvas) {
    for (std::uint32_t i = 0; i < 420; ++i) {
        const std::uint32_t h = hashInt(i, 11u, 225u);
        const double elevation = 8.0 + 76.0 * hashToFloat(hashInt(h));
        const float rank = hashToFloat(hashInt(h ^ 21u));
        canvas.addDisc(glm::vec3(directionFromAngles(360.0 * hashToFloat(h), elevation)), 0.12,
                       glm::vec3(0.85f, 0.92f, 1.0f) * (0.04f + 0.30f * rank * rank * rank * rank));
    }
}

} // namespace

ImagePtr nightSky(double whiteFacingUp, const JobContext& job) {
    SkyCanvas canvas(job);
    canvas.forRows(0, kSkyHeight, [&](int y) {
        const float elevation = 90.0f - (static_cast<float>(y) + 0.5f) * 180.0f / kSkyHeight;
        for (int x = 0; x < kSkyWidth; ++x) {
            const glm::vec3 d = canvas.direction(x, y);
            const float u = (static_cast<float>(x) + 0.5f) / kSkyWidth;
            const float up = std::max(d.y, 0.0f);
            const auto haze = static_cast<float>(expPortable(-up / 0.16));
            const float side = 0.65f + 0.35f * d.x; // the centre of town lies towards +X
            glm::vec3 color = glm::mix(glm::vec3(0.0042f, 0.0075f, 0.019f),
                                       glm::vec3(0.040f, 0.034f, 0.042f) * side, haze);
            if (elevation < 0.0f) {
                const float wet = static_cast<float>(expPortable(d.y / 0.12));
                color = glm::mix(glm::vec3(0.0075f, 0.0080f, 0.0105f),
                                 glm::vec3(0.020f, 0.017f, 0.019f), wet);
            } else {
                const float roof = roofElevation(u);
                const float wall = smoothstep(roof + 0.25f, roof - 0.10f, elevation);
                glm::vec3 facade(0.0070f, 0.0075f, 0.0105f);
                // Windows on a grid of 3 × 4 texels, each its own lamp; a third are lit.
                const auto column = static_cast<std::uint32_t>(x / 3);
                const auto floor = static_cast<std::uint32_t>(y / 3);
                const std::uint32_t h = hashInt(column, floor, 223u);
                const bool frame = x % 3 == 2 || y % 3 == 2;
                if (!frame && elevation < roof - 0.6f && elevation > 0.4f && (h & 0xffu) < 62u)
                    facade = windowColor(h >> 9) * (0.25f + 1.3f * hashToFloat(hashInt(h)));
                color = glm::mix(color, facade, wall);
            }
            canvas.pixel(x, y) = color;
        }
    });

    struct Lamp {
        double azimuthDeg, elevationDeg, radiusDeg;
        glm::vec3 radiance;
    };
    const glm::vec3 sodium(1.0f, 0.48f, 0.11f), white(1.0f, 0.93f, 0.82f), cyan(0.08f, 0.75f, 1.0f);
    const glm::vec3 moon(0.90f, 0.95f, 1.0f), magenta(1.0f, 0.06f, 0.48f),
        green(0.12f, 1.0f, 0.36f), blue(0.12f, 0.24f, 1.0f);
    std::vector<Lamp> lamps = {
        // The moon stands behind the camera's left shoulder; lamps and signs all around.
        {-24.0, 47.0, 0.80, moon * 52.0f},    {-62.0, 13.0, 1.40, cyan * 24.0f},
        {-72.0, 9.0, 0.85, magenta * 35.0f},  {118.0, 14.0, 1.30, magenta * 24.0f},
        {100.0, 18.0, 0.70, sodium * 66.0f},  {62.0, 15.0, 0.66, sodium * 75.0f},
        {8.0, 20.0, 0.60, white * 88.0f},     {160.0, 15.0, 0.66, sodium * 70.0f},
        {-118.0, 14.0, 0.72, sodium * 66.0f}, {-150.0, 10.0, 1.10, blue * 48.0f},
        {-100.0, 7.0, 0.72, green * 20.0f},   {80.0, 8.0, 0.78, cyan * 20.0f},
    };
    // Damp air spreads a little of each strong light around it.
    for (const Lamp& lamp : lamps)
        addGlow(canvas, glm::vec3(directionFromAngles(lamp.azimuthDeg, lamp.elevationDeg)),
                lamp.radiance * static_cast<float>(lamp.radiusDeg * lamp.radiusDeg * 0.010));
    for (std::uint32_t i = 0; i < 44; ++i) { // distant street lamps
        const std::uint32_t h = hashInt(i, 3u, 224u);
        const glm::vec3 colors[4] = {sodium, sodium, white, i % 3 == 0 ? green : cyan};
        lamps.push_back({360.0 * hashToFloat(hashInt(h)), 0.3 + 3.4 * hashToFloat(hashInt(h ^ 5u)),
                         0.25, colors[h & 3u] * (14.0f + 30.0f * hashToFloat(hashInt(h ^ 9u)))});
    }
    for (const Lamp& lamp : lamps)
        canvas.addDisc(directionFromAngles(lamp.azimuthDeg, lamp.elevationDeg), lamp.radiusDeg,
                       lamp.radiance);

    addStars(canvas);
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

} // namespace patina::library
