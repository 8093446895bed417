// What rays have brought to the pixels of a picture: sums, from which come the mean and how certain
// it is.
#pragma once

#include "core/image/Image.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina {

class Film {
  public:
    // 48 bytes. Sums run in the order of the samples, so that they do not depend on threads.
    struct Pixel {
        glm::dvec3 sum{0.0};   // of radiance, times coverage
        double squares = 0.0;  // of its luminance
        float coverage = 0.0f; // sum of what is in front of the background, 0…1 each
        // Sum of luminance over the first samples, as many as the largest power of two that is
        // less than their number: the first half of 2, 4, 8 …
        float firstSum = 0.0f;
        std::uint32_t samples = 0;
        std::uint32_t invalid = 0; // of them: no finite number, counted as black

        void add(const glm::vec3& radiance, float alpha);
        [[nodiscard]] double luminance() const; // mean
        // Of that mean, squared standard error, were samples independent of each other: for the
        // pixels of a good sequence an upper bound. Of two samples or more.
        [[nodiscard]] double variance() const;
        // The same by how far the first samples and the others are apart: says how good the
        // sequence is, but has one degree of freedom; sums over many pixels are of use.
        [[nodiscard]] double halvesVariance() const;
        friend bool operator==(const Pixel&, const Pixel&) = default;
    };

    Film() = default; // empty
    Film(int width, int height);

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] Pixel& at(int x, int y) { return m_pixels[index(x, y)]; } // row 0 on top
    [[nodiscard]] const Pixel& at(int x, int y) const { return m_pixels[index(x, y)]; }
    [[nodiscard]] std::span<Pixel> pixels() { return m_pixels; } // row by row
    [[nodiscard]] std::span<const Pixel> pixels() const { return m_pixels; }
    [[nodiscard]] std::size_t invalid() const;        // samples of all pixels
    [[nodiscard]] std::uint32_t leastSamples() const; // that any pixel has

    // Mean radiance: F32, linear; 3 channels, or 4 with `alpha`, premultiplied.
    [[nodiscard]] Image radiance(bool alpha = false) const;
    // The standard error of the picture's pixels as a share of its mean luminance: the root mean
    // square over the pixels, by their halves (docs/maths/path-tracing.md). Nothing before each
    // pixel has two samples, and of a black picture.
    [[nodiscard]] std::optional<double> noise() const;

    friend bool operator==(const Film&, const Film&) = default;

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
               static_cast<std::size_t>(x);
    }

    int m_width = 0, m_height = 0;
    std::vector<Pixel> m_pixels;
};

} // namespace patina
