// A lat-long picture of the environment under construction, with the conventions of
// patina::Environment. Texels are radiance.
#pragma once

#include "core/image/Image.h"
#include "core/library/Field.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina::library {

inline constexpr int kSkyWidth = 1024;
inline constexpr int kSkyHeight = 512;

class SkyCanvas {
  public:
    // Once the job is cancelled nothing more is painted.
    explicit SkyCanvas(const JobContext& job = {});

    // Calls body(y) for rows [firstRow, lastRow), on all cores.
    template <class Body>
    void forRows(int firstRow, int lastRow, const Body& body) {
        library::forRows(m_job, lastRow - firstRow, [&](int r) { body(firstRow + r); });
    }
    // Sets rows [firstRow, lastRow) to body(direction).
    template <class Body>
    void fill(int firstRow, int lastRow, const Body& body) {
        forRows(firstRow, lastRow, [&](int y) {
            for (int x = 0; x < kSkyWidth; ++x)
                pixel(x, y) = body(direction(x, y));
        });
    }
    template <class Body>
    void fillSky(const Body& body) {
        fill(0, kSkyHeight / 2, body);
    }
    // Below the horizon the ground is a plane lit by the sky above; far away it takes on the
    // horizon's colour. Needs the finished upper half.
    void fillGround(const glm::vec3& albedo, float roughness);

    // A disc of constant radiance. Its edge texels are covered in part, and the sum over texels is
    // exactly radiance times the disc's solid angle 2 pi (1 - cos radius).
    void addDisc(const glm::vec3& center, double radiusDeg, const glm::vec3& radiance);

    // What a surface facing up receives from the upper half, divided by pi: the radiance of a
    // perfectly white one.
    [[nodiscard]] glm::dvec3 irradianceUpOverPi() const;
    // Scales all radiances so that irradianceUpOverPi() has this luminance (Rec. 709).
    void expose(double luminance);

    [[nodiscard]] glm::vec3 direction(int x, int y) const;
    [[nodiscard]] glm::vec3& pixel(int x, int y) {
        return m_pixels[static_cast<std::size_t>(y) * kSkyWidth + static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const glm::vec3& pixel(int x, int y) const {
        return m_pixels[static_cast<std::size_t>(y) * kSkyWidth + static_cast<std::size_t>(x)];
    }

    [[nodiscard]] ImagePtr finish() const; // null after a cancel

  private:
    JobContext m_job;
    std::vector<glm::vec3> m_pixels;
    std::vector<glm::vec2> m_columns, m_rows; // (sin, cos) of azimuth and of polar angle
};

[[nodiscard]] double luminance(const glm::dvec3& linearSrgb);
// Solid angle of a texel of row y.
[[nodiscard]] double texelSolidAngle(int y);

} // namespace patina::library
