#include "core/library/SkyCanvas.h"

#include "core/library/Noise.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina::library {

double luminance(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

double texelSolidAngle(int y) {
    const double top = cosTurns(0.5 * y / kSkyHeight);
    const double bottom = cosTurns(0.5 * (y + 1) / kSkyHeight);
    return 2.0 * kPi / kSkyWidth * (top - bottom);
}

SkyCanvas::SkyCanvas(const JobContext& job)
    : m_job(job)
    , m_pixels(static_cast<std::size_t>(kSkyWidth) * kSkyHeight)
    , m_columns(kSkyWidth)
    , m_rows(kSkyHeight) {
    // u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y) / pi.
    for (std::size_t x = 0; x < kSkyWidth; ++x) {
        const double turns = (static_cast<double>(x) + 0.5) / kSkyWidth - 0.5;
        m_columns[x] = {static_cast<float>(sinTurns(turns)), static_cast<float>(cosTurns(turns))};
    }
    for (std::size_t y = 0; y < kSkyHeight; ++y) {
        const double turns = (static_cast<double>(y) + 0.5) / kSkyHeight * 0.5;
        m_rows[y] = {static_cast<float>(sinTurns(turns)), static_cast<float>(cosTurns(turns))};
    }
}

glm::vec3 SkyCanvas::direction(int x, int y) const {
    const glm::vec2& column = m_columns[static_cast<std::size_t>(x)];
    const glm::vec2& row = m_rows[static_cast<std::size_t>(y)];
    return {row.x * column.x, row.y, -row.x * column.y};
}

void SkyCanvas::fillGround(const glm::vec3& albedo, float roughness) {
    const glm::vec3 lit = albedo * glm::vec3(irradianceUpOverPi());
    const Field soil = fbm(256, {6, 6, 5, 0.6f, 201});
    glm::vec3 horizon(0.0f);
    for (int x = 0; x < kSkyWidth; ++x)
        horizon += pixel(x, kSkyHeight / 2 - 1) / static_cast<float>(kSkyWidth);
    fill(kSkyHeight / 2, kSkyHeight, [&](const glm::vec3& d) {
        // The plane seen from its own height; its detail fades before it would alias.
        const float depth = -d.y;
        const float distance = 1.0f / depth;
        const float detail = roughness * smoothstep(0.03f, 0.35f, depth);
        const float grain = soil.sample(d.x * distance * 26.0f, d.z * distance * 26.0f);
        const float haze = static_cast<float>(expPortable(-depth / 0.045));
        return glm::mix(lit * (1.0f + detail * grain), glm::mix(lit, horizon, 0.75f), haze);
    });
}

void SkyCanvas::addDisc(const glm::vec3& center, double radiusDeg, const glm::vec3& radiance) {
    if (m_job.cancelled())
        return;
    constexpr int kSub = 8;
    const double cosRadius = cosTurns(radiusDeg / 360.0);
    const double cosReach = cosTurns((radiusDeg + 0.5) / 360.0); // and a texel's diagonal
    const double centerElevation = 90.0 - acosPortable(center.y) * 180.0 / kPi;
    struct Covered {
        int x, y;
        double part;
    };
    std::vector<Covered> covered;
    double sum = 0.0;
    for (int y = 0; y < kSkyHeight; ++y) {
        // Rows further than the radius (and one texel) from the centre's elevation are skipped.
        const double elevation = 90.0 - (y + 0.5) * 180.0 / kSkyHeight;
        if (std::fabs(elevation - centerElevation) > radiusDeg + 1.0)
            continue;
        for (int x = 0; x < kSkyWidth; ++x) {
            if (glm::dot(direction(x, y), center) < cosReach)
                continue;
            int inside = 0;
            for (int j = 0; j < kSub; ++j) {
                const double pol = (y + (j + 0.5) / kSub) / kSkyHeight * 0.5;
                const double s = sinTurns(pol), up = cosTurns(pol) * center.y;
                for (int i = 0; i < kSub; ++i) {
                    const double az = (x + (i + 0.5) / kSub) / kSkyWidth - 0.5;
                    inside +=
                        s * (sinTurns(az) * center.x - cosTurns(az) * center.z) + up >= cosRadius;
                }
            }
            if (inside > 0) {
                covered.push_back({x, y, inside / double(kSub * kSub)});
                sum += covered.back().part * texelSolidAngle(y);
            }
        }
    }
    if (covered.empty())
        return;
    const double correction = 2.0 * kPi * (1.0 - cosRadius) / sum;
    for (const Covered& c : covered)
        pixel(c.x, c.y) += radiance * static_cast<float>(c.part * correction);
}

glm::dvec3 SkyCanvas::irradianceUpOverPi() const {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < kSkyHeight / 2; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < kSkyWidth; ++x)
            row += glm::dvec3(pixel(x, y));
        sum += row * (static_cast<double>(direction(0, y).y) * texelSolidAngle(y));
    }
    return sum / kPi;
}

void SkyCanvas::expose(double target) {
    const auto scale = static_cast<float>(target / luminance(irradianceUpOverPi()));
    for (glm::vec3& p : m_pixels)
        p *= scale;
}

ImagePtr SkyCanvas::finish() const {
    if (m_job.cancelled())
        return nullptr;
    auto image =
        std::make_shared<Image>(kSkyWidth, kSkyHeight, 3, PixelType::F32, ColorEncoding::Linear);
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    std::memcpy(image->f32().data(), m_pixels.data(), m_pixels.size() * sizeof(glm::vec3));
    return image;
}

} // namespace patina::library
