// An environment as a source of light: what comes from a direction, and directions as likely as
// they are bright.
#pragma once

#include "core/trace/path/TraceInputs.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Directions are unit vectors of the world.
class EnvironmentSampler {
  public:
    explicit EnvironmentSampler(const TraceEnvironment& environment);

    // Bilinear between the texels' centres, as the viewport looks it up.
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;

    struct Sample {
        glm::vec3 direction{0.0f, 1.0f, 0.0f};
        glm::vec3 radiance{0.0f};
        float pdf = 0.0f; // per steradian; 0: the environment is black
    };
    // A texel is chosen as its luminance times its solid angle, by rows and then by columns; within
    // a texel all directions are alike. `u` in [0, 1)². Pharr, Jakob & Humphreys 2023, "Physically
    // Based Rendering", 4th edition, section 12.5.
    [[nodiscard]] Sample sample(const glm::vec2& u) const;
    [[nodiscard]] float pdf(const glm::vec3& direction) const; // of sample()

    [[nodiscard]] double power() const { return m_power; }         // ∫ luminance dω
    [[nodiscard]] const glm::vec3& mean() const { return m_mean; } // radiance, over all directions

  private:
    [[nodiscard]] glm::vec2 pixelOf(const glm::vec3& direction) const; // in texels
    [[nodiscard]] glm::vec3 texel(int x, int y) const;
    [[nodiscard]] double solidAngle(int y) const; // of a texel

    ImagePtr m_image;
    glm::vec3 m_scale;
    float m_cos, m_sin; // of the rotation
    int m_width, m_height;
    std::vector<float> m_rows;    // running share of all power, row by row
    std::vector<float> m_columns; // and within each row
    double m_power = 0.0;
    glm::vec3 m_mean{0.0f};
};

} // namespace patina
