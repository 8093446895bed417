// Lights other than environments and glowing surfaces, as sources that rays are sent to or meet.
// Spheres and rectangles are no geometry: they hide nothing, and the camera does not see them, as
// in the viewport.
#pragma once

#include "core/light/Light.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// What arrives at a point of one light: its direction, and how far rays go until they are there.
struct LightSample {
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // unit
    // pdf > 0: radiance; pdf = 0: of a light without extent, irradiance of a surface that faces it.
    glm::vec3 light{0.0f};
    float distance = 0.0f; // metres, may be infinite
    float pdf = 0.0f;      // per steradian, of this light
};

class LightSampler {
  public:
    explicit LightSampler(std::span<const Light> lights);

    [[nodiscard]] bool empty() const { return m_lights.empty(); }
    [[nodiscard]] std::size_t size() const { return m_lights.size(); }
    // A light that only a ray to it finds.
    [[nodiscard]] bool anyWithoutExtent() const {
        return std::any_of(m_lights.begin(), m_lights.end(),
                           [](const Source& source) { return !source.extended; });
    }

    // How likely each light is chosen at a point of the world, by what arrives there where nothing
    // is in the way; they sum up to 1, or to 0 where none reaches.
    void choices(const glm::vec3& point, std::vector<float>& out) const;

    // A light with a shadow map in the viewport casts its shadow when it is told to; all others do.
    [[nodiscard]] bool isHidden(std::size_t light) const { return m_lights[light].hidden; }
    // As if all of it came from its centre: the irradiance of a surface that faces that, which is
    // illuminanceAt(); pdf = 0.
    [[nodiscard]] LightSample centre(std::size_t light, const glm::vec3& point) const;
    [[nodiscard]] Id id(std::size_t light) const { return m_lights[light].light.id; }
    [[nodiscard]] LightSample sample(std::size_t light, const glm::vec3& point,
                                     const glm::vec2& u) const;
    // In closed form: irradiance of a surface of that unit normal where nothing is in the way.
    [[nodiscard]] glm::vec3 irradiance(std::size_t light, const glm::vec3& point,
                                       const glm::vec3& normal) const;
    // Light that a ray meets on its way of `distance` metres: what sample() could have chosen.
    // pdf = 0: it does not meet it.
    [[nodiscard]] LightSample along(std::size_t light, const glm::vec3& origin,
                                    const glm::vec3& direction, float distance) const;

  private:
    struct Source {
        Light light;
        glm::vec3 power{0.0f};
        glm::vec3 color{0.0f};              // with the mixer's tint
        glm::vec3 toLight{0.0f};            // directional, spot, rectangle
        glm::vec3 axisX{0.0f}, axisY{0.0f}; // rectangle: unit
        float coneScale = 0.0f, coneOffset = 1.0f;
        float cosDisc = 1.0f; // directional: of half its apparent diameter
        float luminance = 0.0f;
        bool hidden = true, extended = false;
    };
    std::vector<Source> m_lights;
};

} // namespace patina
