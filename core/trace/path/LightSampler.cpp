#include "core/trace/path/LightSampler.h"

#include "core/light/Lights.h"
#include "core/math/Sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <tuple>

namespace patina {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

glm::vec3 aroundAxis(const glm::vec3& axis, float cosine, float sine, float phi) {
    glm::vec3 t, b;
    shading::orthonormalBasis(axis, t, b);
    return glm::normalize(sine * std::cos(phi) * t + sine * std::sin(phi) * b + cosine * axis);
}

// 1 - cos of an angle with that sin²: no digits are lost where it is small.
float oneMinusCosine(float sin2) {
    return sin2 / (1.0f + std::sqrt(std::max(1.0f - sin2, 0.0f)));
}

// Where a ray enters and leaves a sphere; nothing where it passes it.
bool meetsSphere(const glm::vec3& toCenter, const glm::vec3& direction, float radius, float& near,
                 float& far) {
    const float along = glm::dot(toCenter, direction);
    const glm::vec3 aside = toCenter - along * direction;
    const float half2 = radius * radius - glm::dot(aside, aside);
    if (half2 < 0.0f)
        return false;
    const float half = std::sqrt(half2);
    near = along - half;
    far = along + half;
    return true;
}

// A rectangle as it is seen from a point. Ureña, Fajardo & King 2013, "An Area-Preserving
// Parametrization for Spherical Rectangles"; their frame: x and y along the sides, z away from the
// point.
class SphericalRectangle {
  public:
    // `corner`: from the point to one corner; `x`, `y`: unit, along its sides.
    SphericalRectangle(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y,
                       double width, double height)
        : m_x(x)
        , m_y(y)
        , m_z(glm::cross(x, y))
        , m_x0(glm::dot(corner, x))
        , m_y0(glm::dot(corner, y))
        , m_z0(glm::dot(corner, m_z))
        , m_x1(m_x0 + width)
        , m_y1(m_y0 + height) {
        if (m_z0 > 0.0) {
            m_z = -m_z;
            m_z0 = -m_z0;
        }
        // z of the normals of the planes through the point and the sides; across them x or y is 0.
        const auto edge = [&](double at) { return at / std::hypot(m_z0, at); };
        const double n0 = -edge(m_y0), n1 = edge(m_x1), n2 = edge(m_y1), n3 = -edge(m_x0);
        const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
        m_b0 = n0;
        m_b1 = n2;
        m_k = 2.0 * std::numbers::pi - angle(-n2 * n3) - angle(-n3 * n0);
        m_solidAngle = angle(-n0 * n1) + angle(-n1 * n2) - m_k;
    }

    [[nodiscard]] double solidAngle() const { return m_solidAngle; }

    // A point of the rectangle, from where it is seen.
    [[nodiscard]] glm::vec3 at(const glm::dvec2& u) const {
        const double au = u.x * m_solidAngle + m_k;
        const double fu = (std::cos(au) * m_b0 - m_b1) / std::sin(au);
        const double cu =
            std::clamp(std::copysign(1.0 / std::sqrt(fu * fu + m_b0 * m_b0), fu), -1.0, 1.0);
        const double xu =
            std::clamp(-(cu * m_z0) / std::sqrt(std::max(1.0 - cu * cu, 1e-24)), m_x0, m_x1);
        const double d = std::hypot(xu, m_z0);
        const double h0 = m_y0 / std::hypot(d, m_y0), h1 = m_y1 / std::hypot(d, m_y1);
        const double hv = h0 + u.y * (h1 - h0), hv2 = hv * hv;
        const double yv =
            hv2 < 1.0 - 1e-12 ? std::clamp(hv * d / std::sqrt(1.0 - hv2), m_y0, m_y1) : m_y1;
        return glm::vec3(xu * m_x + yv * m_y + m_z0 * m_z);
    }

  private:
    glm::dvec3 m_x, m_y, m_z;
    double m_x0, m_y0, m_z0, m_x1, m_y1;
    double m_b0 = 0.0, m_b1 = 0.0, m_k = 0.0, m_solidAngle = 0.0;
};

// Rectangles that are seen under less are points of their area: the solid angle's four angles would
// cancel.
constexpr double kSmallAngle = 1e-6;

} // namespace

LightSampler::LightSampler(std::span<const Light> lights) {
    for (const Light& light : lights) {
        Source& source = m_lights.emplace_back();
        source.light = light;
        source.power = lightPower(light);
        source.color = lightColor(light) * light.tint;
        source.luminance = std::max(shading::luminance(source.color), 0.0f);
        source.hidden = !canCastShadow(light.type) || light.castsShadow;
        if (hasDirection(light.type))
            source.toLight = light.directionToLight();
        if (light.type == LightType::Spot)
            std::tie(source.coneScale, source.coneOffset) = coneScaleOffset(light);
        if (light.type == LightType::Rectangle) {
            const RectangleAxes axes = rectangleAxes(light);
            source.axisX = axes.x;
            source.axisY = axes.y;
            source.extended = light.width > 0.0f && light.height > 0.0f;
        }
        if (light.type == LightType::Sphere)
            source.extended = light.radius > 0.0f;
        if (light.type == LightType::Directional && source.hidden && light.shadowSoftness > 0.0f) {
            source.cosDisc = std::cos(glm::radians(0.5f * light.shadowSoftness));
            source.extended = source.cosDisc < 1.0f;
        }
    }
}

void LightSampler::choices(const glm::vec3& point, std::vector<float>& out) const {
    out.clear();
    float sum = 0.0f;
    for (const Source& source : m_lights) {
        out.push_back(source.luminance * illuminanceAt(source.light, point));
        sum += out.back();
    }
    for (float& share : out)
        share = sum > 0.0f ? share / sum : 0.0f;
}

LightSample LightSampler::centre(std::size_t index, const glm::vec3& point) const {
    const Source& source = m_lights[index];
    LightSample result;
    result.light = source.color * illuminanceAt(source.light, point);
    result.direction = source.toLight;
    result.distance = kEndless;
    if (source.light.type == LightType::Directional)
        return result;
    const glm::vec3 toLight = source.light.position - point;
    result.distance = glm::length(toLight);
    if (!(result.distance > 0.0f)) {
        result.light = glm::vec3(0.0f);
        return result;
    }
    result.direction = toLight / result.distance;
    return result;
}

LightSample LightSampler::sample(std::size_t index, const glm::vec3& point,
                                 const glm::vec2& u) const {
    const Source& source = m_lights[index];
    const Light& light = source.light;
    LightSample result;
    if (light.type == LightType::Directional) {
        result.direction = source.toLight;
        result.distance = kEndless;
        result.light = source.power;
        if (!source.extended)
            return result;
        const float half = glm::radians(0.5f * light.shadowSoftness);
        const float sin2 = std::sin(half) * std::sin(half);
        const float fall = u.x * oneMinusCosine(sin2); // 1 - cos
        result.direction =
            aroundAxis(source.toLight, 1.0f - fall, std::sqrt(std::max(fall * (2.0f - fall), 0.0f)),
                       shading::kTwoPi * u.y);
        // A disc that gives a surface that faces it the light's illuminance.
        result.light = source.power / (shading::kPi * sin2);
        result.pdf = 1.0f / (shading::kTwoPi * oneMinusCosine(sin2));
        return result;
    }
    const glm::vec3 toLight = light.position - point;
    const float distance2 = glm::dot(toLight, toLight);
    if (!(distance2 > 0.0f))
        return result;
    const float distance = std::sqrt(distance2);
    const glm::vec3 l = toLight / distance;
    if (light.type == LightType::Point || light.type == LightType::Spot) {
        const float range2 = light.range * light.range;
        float reaches = shading::pointFalloff(distance2, light.range > 0.0f ? 1.0f / range2 : 0.0f);
        if (light.type == LightType::Spot)
            reaches *= shading::spotFalloff(glm::dot(source.toLight, l), source.coneScale,
                                            source.coneOffset);
        result.direction = l;
        result.distance = distance;
        result.light = source.power * reaches;
        return result;
    }
    if (!source.extended)
        return result;
    if (light.type == LightType::Sphere) {
        const float sin2 = light.radius * light.radius / distance2;
        float near = 0.0f, far = 0.0f;
        if (sin2 >= 1.0f) { // inside: light from everywhere
            result.direction = shading::uniformSphere(u);
            result.pdf = 0.5f / shading::kTwoPi;
        } else {
            const float fall = u.x * oneMinusCosine(sin2);
            result.direction =
                aroundAxis(l, 1.0f - fall, std::sqrt(std::max(fall * (2.0f - fall), 0.0f)),
                           shading::kTwoPi * u.y);
            result.pdf = 1.0f / (shading::kTwoPi * oneMinusCosine(sin2));
        }
        if (!meetsSphere(toLight, result.direction, light.radius, near, far))
            near = far = glm::dot(toLight, result.direction); // on its rim
        result.distance = sin2 >= 1.0f ? far : near;
        result.light = source.power;
        return result;
    }
    // The lit side is the one that emits along -toLight.
    if (glm::dot(source.toLight, toLight) <= 0.0f)
        return result;
    const glm::vec3 corner =
        toLight - 0.5f * light.width * source.axisX - 0.5f * light.height * source.axisY;
    const SphericalRectangle seen(corner, source.axisX, source.axisY, light.width, light.height);
    glm::vec3 to = seen.at(glm::dvec2(u));
    const bool small = seen.solidAngle() < kSmallAngle;
    if (small)
        to = corner + u.x * light.width * source.axisX + u.y * light.height * source.axisY;
    const float d2 = glm::dot(to, to);
    if (!(d2 > 0.0f))
        return result;
    result.distance = std::sqrt(d2);
    result.direction = to / result.distance;
    const float cosine = glm::dot(source.toLight, result.direction);
    result.pdf = small ? d2 / (light.width * light.height * std::max(cosine, 1e-6f))
                       : static_cast<float>(1.0 / seen.solidAngle());
    result.light = source.power;
    return result;
}

glm::vec3 LightSampler::irradiance(std::size_t index, const glm::vec3& point,
                                   const glm::vec3& normal) const {
    const Source& source = m_lights[index];
    const Light& light = source.light;
    if (!source.extended) {
        const LightSample arriving = sample(index, point, glm::vec2(0.5f));
        return arriving.light * std::max(glm::dot(normal, arriving.direction), 0.0f);
    }
    if (light.type == LightType::Directional) {
        const float half = glm::radians(0.5f * light.shadowSoftness);
        const float sin2 = std::sin(half) * std::sin(half);
        return source.power *
               (shading::sphereFormFactor(glm::dot(normal, source.toLight), sin2) / sin2);
    }
    const glm::vec3 toLight = light.position - point;
    const float distance2 = glm::dot(toLight, toLight);
    if (light.type == LightType::Sphere) {
        const float sin2 = light.radius * light.radius / std::max(distance2, 1e-30f);
        const float share =
            sin2 >= 1.0f
                ? 1.0f
                : shading::sphereFormFactor(glm::dot(normal, toLight) / std::sqrt(distance2), sin2);
        return source.power * (shading::kPi * share);
    }
    if (glm::dot(source.toLight, toLight) <= 0.0f)
        return glm::vec3(0.0f); // its dark side
    glm::vec3 x, y;
    orthonormalBasis(normal, x, y);
    const auto local = [&](const glm::vec3& v) {
        return glm::vec3(glm::dot(x, v), glm::dot(y, v), glm::dot(normal, v));
    };
    const glm::vec3 center = local(toLight), hx = local(0.5f * light.width * source.axisX),
                    hy = local(0.5f * light.height * source.axisY);
    const std::array corners{center - hx - hy, center + hx - hy, center + hx + hy,
                             center - hx + hy};
    // Of the two ways round, one is that of the lit side.
    const float share =
        std::max(shading::quadFormFactor(corners[0], corners[1], corners[2], corners[3]),
                 shading::quadFormFactor(corners[3], corners[2], corners[1], corners[0]));
    return source.power * (shading::kPi * share);
}

LightSample LightSampler::along(std::size_t index, const glm::vec3& origin,
                                const glm::vec3& direction, float distance) const {
    const Source& source = m_lights[index];
    const Light& light = source.light;
    LightSample result;
    result.direction = direction;
    if (!source.extended)
        return result;
    if (light.type == LightType::Directional) {
        if (std::isinf(distance) && glm::dot(direction, source.toLight) >= source.cosDisc) {
            const float half = glm::radians(0.5f * light.shadowSoftness);
            const float sin2 = std::sin(half) * std::sin(half);
            result.distance = kEndless;
            result.light = source.power / (shading::kPi * sin2);
            result.pdf = 1.0f / (shading::kTwoPi * oneMinusCosine(sin2));
        }
        return result;
    }
    const glm::vec3 toLight = light.position - origin;
    if (light.type == LightType::Sphere) {
        float near = 0.0f, far = 0.0f;
        if (!meetsSphere(toLight, direction, light.radius, near, far) || far <= 0.0f)
            return result;
        const float sin2 = light.radius * light.radius / glm::dot(toLight, toLight);
        result.distance = near > 0.0f ? near : far;
        if (result.distance >= distance)
            return result;
        result.light = source.power;
        result.pdf =
            sin2 >= 1.0f ? 0.5f / shading::kTwoPi : 1.0f / (shading::kTwoPi * oneMinusCosine(sin2));
        return result;
    }
    const float facing = glm::dot(direction, source.toLight);
    const float height = glm::dot(toLight, source.toLight);
    if (facing <= 0.0f || height <= 0.0f)
        return result;
    result.distance = height / facing;
    if (result.distance >= distance)
        return result;
    const glm::vec3 across = result.distance * direction - toLight;
    if (std::abs(glm::dot(across, source.axisX)) > 0.5f * light.width ||
        std::abs(glm::dot(across, source.axisY)) > 0.5f * light.height)
        return result;
    const glm::vec3 corner =
        toLight - 0.5f * light.width * source.axisX - 0.5f * light.height * source.axisY;
    const SphericalRectangle seen(corner, source.axisX, source.axisY, light.width, light.height);
    result.light = source.power;
    result.pdf = seen.solidAngle() < kSmallAngle
                     ? result.distance * result.distance / (light.width * light.height * facing)
                     : static_cast<float>(1.0 / seen.solidAngle());
    return result;
}

} // namespace patina
