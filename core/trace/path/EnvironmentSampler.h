// An environment as a source of light: what comes from a direction, and directions as likely as
// they are bright.
#pragma once

#include "core/trace/path/TraceInputs.h"

#include <cstdint>
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
    // With the density of sample() there.
    struct Lookup {
        glm::vec3 radiance{0.0f};
        float pdf = 0.0f;
    };
    [[nodiscard]] Lookup lookUp(const glm::vec3& direction) const;

    struct Choice {
        glm::vec3 direction{0.0f, 1.0f, 0.0f};
        float pdf = 0.0f; // per steradian; 0: the environment is black
    };
    struct Sample : Choice {
        glm::vec3 radiance{0.0f};
    };
    // A texel is chosen as its luminance times its solid angle, by rows and then by columns; within
    // a texel all directions are alike. `u` in [0, 1)². Pharr, Jakob & Humphreys 2023, "Physically
    // Based Rendering", 4th edition, section 12.5.
    [[nodiscard]] Sample sample(const glm::vec2& u) const;
    // The same without looking up what is there, in steps between which a caller has other things
    // to do while memory is fetched: choose() is end() of begin().
    struct Search {
        const EnvironmentSampler* sampler = nullptr; // null: black
        float u = 0.0f;
        int row = 0;
        float inRow = 0.0f;
        const std::uint16_t* guide = nullptr;
    };
    [[nodiscard]] Search begin(const glm::vec2& u) const;
    static void fetch(const Search& search); // once the guide is there
    [[nodiscard]] static Choice end(const Search& search);
    [[nodiscard]] Choice choose(const glm::vec2& u) const { return end(begin(u)); }
    [[nodiscard]] float pdf(const glm::vec3& direction) const; // of sample()

    [[nodiscard]] double power() const { return m_power; }         // ∫ luminance dω
    [[nodiscard]] const glm::vec3& mean() const { return m_mean; } // radiance, over all directions

  private:
    [[nodiscard]] glm::vec2 pixelOf(const glm::vec3& direction) const; // in texels
    [[nodiscard]] const float* texelAt(int x, int y) const;
    [[nodiscard]] glm::vec3 texel(int x, int y) const;
    [[nodiscard]] glm::vec3 radianceAt(const glm::vec2& pixel) const;
    [[nodiscard]] float pdfAt(const glm::vec2& pixel) const;
    [[nodiscard]] float pdfOf(int x, int y) const; // of a texel
    [[nodiscard]] Choice found(const Search& search) const;
    [[nodiscard]] const float* columnsOf(int y) const;
    void makeGuides();

    ImagePtr m_image;
    const float* m_texels = nullptr; // of m_image
    int m_channels = 3;
    glm::vec3 m_scale;
    float m_cos, m_sin; // of the rotation
    int m_width, m_height;
    std::vector<float> m_rows;         // running share of all power, row by row
    std::vector<float> m_columns;      // and within each row
    std::vector<double> m_solidAngles; // of a texel of each row
    std::vector<float> m_cosines;      // of the upper edges of the rows, and of the last lower one
    // Where a search in those shares begins: entry k is the first that is above k / m_guided. Chen
    // & Asau 1974, "On Generating Random Variates from an Empirical Distribution".
    int m_guided = 1;                    // of a row of columns; a power of two
    std::vector<std::uint16_t> m_guides; // m_guided + 1 for each row
    double m_power = 0.0;
    glm::vec3 m_mean{0.0f};
};

} // namespace patina
