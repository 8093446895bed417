// The series of pictures from the drawn to the traced one: what replacing each shortcut by the
// truth changes at a pixel.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/trace/blame/BlameCause.h"
#include "core/trace/blame/BlameFilm.h"
#include "core/trace/path/Film.h"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace patina {

// A picture lit by image-based light, as the viewport draws it, and the terms that it is the sum
// of. All F32, linear, of one camera and size.
struct DrawnTerms {
    Image picture;    // 3 channels, or 4 and premultiplied
    Image unoccluded; // the same without occlusion maps and bakes
    // Terms of `unoccluded`, over no background: 4 channels, premultiplied by coverage.
    Image diffuse, specular; // image-based
    Image direct;            // of lights, both lobes
    Image through;           // what is seen through the surface
};

class BlameSteps {
  public:
    // All of them outlive it. Errors: Usage where sizes or numbers of samples differ; InputBroken
    // for NaN and infinity.
    static Result<BlameSteps> of(const DrawnTerms& drawn, const BlameFilm& blame, const Film& film);

    struct Pixel {
        // Radiance that each cause lacks, below 0 has in excess; their sum is traced - drawn.
        std::array<glm::vec3, kBlameCauses> steps{};
        // Of their luminances, by the first samples and by the others.
        std::array<double, kBlameCauses> first{}, others{};
    };
    [[nodiscard]] Pixel at(std::size_t pixel) const;

    [[nodiscard]] int width() const { return m_film->width(); }
    [[nodiscard]] int height() const { return m_film->height(); }
    // Of the samples of a pixel, those that are the first ones: the rest are the others.
    [[nodiscard]] double firstShare() const;

  private:
    BlameSteps(const DrawnTerms& drawn, const BlameFilm& blame, const Film& film)
        : m_drawn(&drawn)
        , m_blame(&blame)
        , m_film(&film) {}

    const DrawnTerms* m_drawn;
    const BlameFilm* m_blame;
    const Film* m_film;
};

} // namespace patina
