// An environment as a source of light: what comes from a direction, and directions as likely as
// they are bright.
#pragma once

#include "core/trace/path/TraceInputs.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
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

    struct Sample {
        glm::vec3 direction{0.0f, 1.0f, 0.0f};
        float pdf = 0.0f; // per steradian; 0: the environment is black
        glm::vec3 radiance{0.0f};
    };
    // As likely as it is bright: of the squares between four texels' centres one is chosen by its
    // mean luminance times its solid angle, by rows and then by columns, and within it a place by
    // the luminance between the four. `u` in [0, 1)². Pharr, Jakob & Humphreys 2023, "Physically
    // Based Rendering", 4th edition, sections 12.5 and A.5.2.
    [[nodiscard]] Sample sample(const glm::vec2& u) const { return end(find(begin(u))); }
    // The same in steps, between which a caller has other things to do while memory is fetched.
    struct Search {
        const EnvironmentSampler* sampler = nullptr; // null: black
        float u = 0.0f;
        int row = 0;
        float inRow = 0.0f;
        const std::uint16_t* guide = nullptr;
        int column = 0; // from here on of find()
        float inColumn = 0.0f;
    };
    [[nodiscard]] Search begin(const glm::vec2& u) const;
    static void fetch(const Search& search); // once the guide is there
    [[nodiscard]] static Search find(const Search& search);
    [[nodiscard]] static Sample end(const Search& search);
    [[nodiscard]] float pdf(const glm::vec3& direction) const; // of sample()

    [[nodiscard]] double power() const { return m_power; }         // ∫ luminance dω
    [[nodiscard]] const glm::vec3& mean() const { return m_mean; } // radiance, over all directions

  private:
    // Of the squares between four texels' centres, which are half as high at the poles: a place in
    // one, 0…1 to the right of the texel `column` and below the row of centres `row` - 1.
    struct Place {
        int column = 0, row = 0; // 0…m_width - 1, 0…m_height
        float x = 0.0f, y = 0.0f;
    };
    // Radiance at a place's x, on the square's upper and lower edges.
    struct Square {
        glm::vec3 above{0.0f}, below{0.0f};
    };
    [[nodiscard]] glm::vec3 toPicture(const glm::vec3& direction) const;
    [[nodiscard]] Place placeOf(const glm::vec3& inPicture) const;
    [[nodiscard]] const float* texelAt(int x, int y) const;
    [[nodiscard]] glm::vec3 texel(int x, int y) const;
    [[nodiscard]] int rowAbove(int row) const { return row == 0 ? 0 : row - 1; }
    [[nodiscard]] int rowBelow(int row) const { return row == m_height ? row - 1 : row; }
    [[nodiscard]] Square squareAt(const Place& place) const;
    [[nodiscard]] float pdfOf(const Square& square, int row, float up) const;
    [[nodiscard]] Sample found(const Search& search) const;
    [[nodiscard]] const float* columnsOf(int y) const;
    void makeGuides();

    ImagePtr m_image;
    const float* m_texels = nullptr; // of m_image
    int m_channels = 3;
    glm::vec3 m_scale;
    float m_cos, m_sin; // of the rotation about +Y
    bool m_level;       // neither tilted nor rolled
    glm::mat3 m_toPicture;
    int m_width, m_height;
    std::vector<float> m_rows;    // of squares: running share of all power, row by row
    std::vector<float> m_columns; // and within each row
    std::vector<float> m_cosines; // of the upper edges of those rows, and of the last lower one
    // Where a search in those shares begins: entry k is the first that is above k / m_guided. Chen
    // & Asau 1974, "On Generating Random Variates from an Empirical Distribution".
    int m_guided = 1;                    // of a row of columns; a power of two
    std::vector<std::uint16_t> m_guides; // m_guided + 1 for each row
    double m_power = 0.0;
    float m_perPower = 0.0f; // 1 / m_power
    glm::vec3 m_mean{0.0f};
};

} // namespace patina
