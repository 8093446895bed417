// What the shortcuts of the drawn picture stand for, as rays find it at the surfaces that are seen:
// the truths that core/trace/blame puts in their places one after the other. docs/maths/blame.md
// has the series and its formulas.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/material/ShadingModel.h"
#include "core/trace/path/PathTracer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Radiance that the surface which is seen sends to the viewer.
enum class BlameTerm {
    Rest,     // the surface's own emission, and the background beside it
    Lights,   // reflected of lights other than the environment and glowing surfaces, shadowed
    Diffuse,  // reflected by the diffuse lobe of the whole environment, nothing hidden
    Filtered, // specular: the split sum's albedo times the environment filtered without error
    Lobe,     // the same, filtered with the lobe as it is from this view
    Specular, // the specular lobe's integral over the environment, nothing hidden
    Occluded, // of both lobes, what is not hidden
    Through   // what comes through the surface, on all its ways
};
inline constexpr std::size_t kBlameTerms = 8;

class BlameFilm {
  public:
    struct Pixel {
        std::array<glm::vec3, kBlameTerms> mean{}; // radiance, linear
        // Luminance over the first samples, as many as those of Film::Pixel::firstSum.
        std::array<float, kBlameTerms> firstMean{};
        float coverage = 0.0f; // share of the samples that met a surface

        [[nodiscard]] const glm::vec3& of(BlameTerm term) const {
            return mean[static_cast<std::size_t>(term)];
        }
        friend bool operator==(const Pixel&, const Pixel&) = default;
    };

    BlameFilm(int width, int height, std::uint32_t samples);

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] std::uint32_t samples() const { return m_samples; } // of each pixel
    [[nodiscard]] std::vector<Pixel>& pixels() { return m_pixels; }   // row by row, 0 on top
    [[nodiscard]] const std::vector<Pixel>& pixels() const { return m_pixels; }

  private:
    int m_width, m_height;
    std::uint32_t m_samples;
    std::vector<Pixel> m_pixels;
};

// `model`: of the scene. `samples`: at least 2. With the seed and the number of samples of a film
// the camera rays, the environment's and the lights' are those of tracePaths(), so that most of
// both noises cancel in the difference. The same numbers for any number of threads.
// Errors: Cancelled, also where the job was only to stop.
Result<BlameFilm> traceBlame(const TraceScene& scene, const TraceView& view,
                             const ShadingModel& model, std::uint32_t seed, std::uint32_t samples,
                             const JobContext& job);

} // namespace patina
