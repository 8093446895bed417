// A photographer's studio: a dark room with soft boxes placed around the default camera (azimuth
// 30°), so that glossy materials get a key, two rim strips, a fill and a bright top.
#include "core/library/Directions.h"
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

// A rectangle one unit away, facing the centre. Its fabric is brighter in the middle and its edge
// falls off softly.
class SoftBox {
  public:
    SoftBox(double azimuthDeg, double elevationDeg, double rollDeg, glm::vec2 halfSize, float soft,
            float hotSpot, const glm::vec3& radiance)
        : m_axis(directionFromAngles(azimuthDeg, elevationDeg))
        , m_half(halfSize)
        , m_soft(soft)
        , m_hotSpot(hotSpot)
        , m_radiance(radiance) {
        const glm::vec3 side = directionFromAngles(azimuthDeg + 90.0, 0.0);
        const glm::vec3 up = glm::cross(m_axis, side);
        const auto c = static_cast<float>(cosTurns(rollDeg / 360.0));
        const auto s = static_cast<float>(sinTurns(rollDeg / 360.0));
        m_side = side * c + up * s;
        m_up = up * c - side * s;
    }

    [[nodiscard]] glm::vec3 radiance(const glm::vec3& d) const {
        const float depth = glm::dot(d, m_axis);
        if (depth < 0.05f)
            return glm::vec3(0.0f);
        const float a = glm::dot(d, m_side) / depth, b = glm::dot(d, m_up) / depth;
        // Signed distance to a rectangle with rounded corners.
        const float corner = 0.25f * std::min(m_half.x, m_half.y);
        const float qx = std::fabs(a) - (m_half.x - corner),
                    qy = std::fabs(b) - (m_half.y - corner);
        const float ox = std::max(qx, 0.0f), oy = std::max(qy, 0.0f);
        const float distance =
            std::sqrt(ox * ox + oy * oy) + std::min(std::max(qx, qy), 0.0f) - corner;
        const float inside = smoothstep(m_soft, -m_soft, distance);
        if (inside <= 0.0f)
            return glm::vec3(0.0f);
        const float ra = a / m_half.x, rb = b / m_half.y;
        const float r2 = std::min(1.0f, 0.5f * (ra * ra + rb * rb));
        return m_radiance * (inside * (1.0f - m_hotSpot * r2));
    }

  private:
    glm::vec3 m_axis, m_side, m_up;
    glm::vec2 m_half;
    float m_soft, m_hotSpot;
    glm::vec3 m_radiance;
};

} // namespace

ImagePtr studioSky(double whiteFacingUp, const JobContext& job) {
    const std::array boxes = {
        // Key, left of the camera and above it.
        SoftBox(-28.0, 42.0, 8.0, {0.40f, 0.40f}, 0.03f, 0.45f, {19.0f, 18.2f, 17.2f}),
        // Overhead bank, leaning to the back.
        SoftBox(205.0, 78.0, 0.0, {0.70f, 0.26f}, 0.05f, 0.35f, {3.9f, 3.97f, 4.1f}),
        // Rim strips behind the object, cool on the right, neutral on the left.
        SoftBox(146.0, 22.0, -4.0, {0.10f, 0.62f}, 0.02f, 0.30f, {13.0f, 14.6f, 17.2f}),
        SoftBox(-88.0, 18.0, 3.0, {0.085f, 0.55f}, 0.02f, 0.30f, {13.5f, 13.5f, 14.0f}),
        // A large dim fill on the right.
        SoftBox(98.0, 24.0, 0.0, {0.60f, 0.52f}, 0.16f, 0.60f, {1.50f, 1.58f, 1.72f}),
        // A white reflector on the floor before the object, so that metals have an underside.
        SoftBox(12.0, -42.0, 0.0, {0.85f, 0.45f}, 0.30f, 0.55f, {1.15f, 1.10f, 1.04f}),
    };
    const glm::vec3 cyclorama = directionFromAngles(210.0, -9.0);

    SkyCanvas canvas(job);
    canvas.fill(0, kSkyHeight, [&](const glm::vec3& d) {
        // The room: floor, a wide cove instead of a corner, dark ceiling; a glow on the backdrop.
        const float ceiling = smoothstep(0.05f, 0.85f, d.y);
        const float floor = smoothstep(0.10f, -0.75f, d.y);
        glm::vec3 color =
            glm::mix(glm::vec3(0.060f, 0.063f, 0.069f), glm::vec3(0.030f, 0.031f, 0.034f), ceiling);
        color = glm::mix(color, glm::vec3(0.045f, 0.044f, 0.043f), floor);
        const float toBackdrop = std::max(0.0f, glm::dot(d, cyclorama));
        const float glow = toBackdrop * toBackdrop * toBackdrop;
        color += glm::vec3(0.20f, 0.21f, 0.228f) * glow * glow * glow * glow;
        for (const SoftBox& box : boxes)
            color += box.radiance(d);
        return color;
    });
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

} // namespace patina::library
