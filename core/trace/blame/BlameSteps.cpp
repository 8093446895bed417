#include "core/trace/blame/BlameSteps.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace patina {
namespace {

double luminanceOfRadiance(const glm::dvec3& value) {
    return 0.2126 * value.x + 0.7152 * value.y + 0.0722 * value.z;
}

glm::dvec3 colorAt(const Image& image, std::size_t pixel) {
    const float* value = image.f32().data() + static_cast<std::size_t>(image.channels()) * pixel;
    return {value[0], value[1], value[2]};
}

double coverageAt(const Image& image, std::size_t pixel) {
    return static_cast<double>(image.f32()[4 * pixel + 3]);
}

// The terms of a pixel, as colours or as luminances.
template <class T>
struct Terms {
    T picture, unoccluded, diffuse, specular, direct, through; // drawn
    std::array<T, kBlameTerms> truths;
    T traced;

    [[nodiscard]] const T& of(BlameTerm term) const {
        return truths[static_cast<std::size_t>(term)];
    }
};

// `comparable`: both pixels show a surface.
template <class T>
std::array<T, kBlameCauses> stepsOf(const Terms<T>& terms, bool comparable) {
    std::array<T, kBlameCauses> steps{};
    const auto of = [&](BlameCause cause) -> T& { return steps[static_cast<std::size_t>(cause)]; };
    if (!comparable) {
        of(BlameCause::Rest) = terms.traced - terms.picture;
        return steps;
    }
    const T open = terms.of(BlameTerm::Diffuse) + terms.of(BlameTerm::Specular);
    of(BlameCause::Occlusion) =
        (terms.unoccluded - terms.picture) + (terms.of(BlameTerm::Occluded) - open);
    of(BlameCause::Lights) = terms.of(BlameTerm::Lights) - terms.direct;
    of(BlameCause::Irradiance) = terms.of(BlameTerm::Diffuse) - terms.diffuse;
    of(BlameCause::Filtering) = terms.of(BlameTerm::Filtered) - terms.specular;
    of(BlameCause::LobeDirection) = terms.of(BlameTerm::Lobe) - terms.of(BlameTerm::Filtered);
    of(BlameCause::SplitSum) = terms.of(BlameTerm::Specular) - terms.of(BlameTerm::Lobe);
    of(BlameCause::Transmission) = terms.of(BlameTerm::Through) - terms.through;
    const T first = terms.of(BlameTerm::Rest) + terms.of(BlameTerm::Lights) +
                    terms.of(BlameTerm::Occluded) + terms.of(BlameTerm::Through);
    of(BlameCause::Bounces) = terms.traced - first;
    of(BlameCause::Rest) =
        terms.of(BlameTerm::Rest) -
        (terms.unoccluded - terms.diffuse - terms.specular - terms.direct - terms.through);
    return steps;
}

bool isFinite(const Image& image) {
    return std::ranges::all_of(image.f32(), [](float value) { return std::isfinite(value); });
}

} // namespace

Result<BlameSteps> BlameSteps::of(const DrawnTerms& drawn, const BlameFilm& blame,
                                  const Film& film) {
    const auto fits = [&](int width, int height) {
        return width == film.width() && height == film.height();
    };
    for (const Image* image : {&drawn.picture, &drawn.unoccluded, &drawn.diffuse, &drawn.specular,
                               &drawn.direct, &drawn.through}) {
        if (!fits(image->width(), image->height()))
            return Error{ErrorKind::Usage,
                         fmt::format("the drawn picture has {} × {} pixels, the traced one {} × {}",
                                     image->width(), image->height(), film.width(), film.height()),
                         {},
                         {}};
        if (!isFinite(*image))
            return Error{
                ErrorKind::InputBroken, "the drawn picture has values that are not finite", {}, {}};
    }
    if (!fits(blame.width(), blame.height()) ||
        !std::ranges::all_of(film.pixels(), [&](auto& p) { return p.samples == blame.samples(); }))
        return Error{ErrorKind::Usage,
                     "blame is not traced with as many paths per pixel as the picture",
                     {},
                     {}};
    return BlameSteps(drawn, blame, film);
}

double BlameSteps::firstShare() const {
    return static_cast<double>(std::bit_floor(m_blame->samples() - 1)) / m_blame->samples();
}

BlameSteps::Pixel BlameSteps::at(std::size_t pixel) const {
    const BlameFilm::Pixel& truth = m_blame->pixels()[pixel];
    const Film::Pixel& film = m_film->pixels()[pixel];
    const double covered = coverageAt(m_drawn->diffuse, pixel), seen = truth.coverage;
    // Edges: where the drawn pixel has less or more of the surface, its terms are scaled to as much
    // as the traced one has, so that the difference of both stays with the background.
    const bool comparable = covered > 0.0 && seen > 0.0;
    const double scale = comparable ? seen / covered : 0.0;

    Terms<glm::dvec3> terms{};
    terms.picture = colorAt(m_drawn->picture, pixel);
    terms.unoccluded = colorAt(m_drawn->unoccluded, pixel);
    terms.diffuse = scale * colorAt(m_drawn->diffuse, pixel);
    terms.specular = scale * colorAt(m_drawn->specular, pixel);
    terms.direct = scale * colorAt(m_drawn->direct, pixel);
    terms.through = scale * colorAt(m_drawn->through, pixel);
    for (std::size_t t = 0; t < kBlameTerms; ++t)
        terms.truths[t] = glm::dvec3(truth.mean[t]);
    terms.traced = film.sum / static_cast<double>(film.samples);

    Pixel result;
    const std::array<glm::dvec3, kBlameCauses> steps = stepsOf(terms, comparable);
    for (std::size_t c = 0; c < kBlameCauses; ++c)
        result.steps[c] = glm::vec3(steps[c]);

    // The same by the first samples alone; the mean of all is that of both parts.
    Terms<double> first{luminanceOfRadiance(terms.picture),
                        luminanceOfRadiance(terms.unoccluded),
                        luminanceOfRadiance(terms.diffuse),
                        luminanceOfRadiance(terms.specular),
                        luminanceOfRadiance(terms.direct),
                        luminanceOfRadiance(terms.through),
                        {},
                        0.0};
    for (std::size_t t = 0; t < kBlameTerms; ++t)
        first.truths[t] = static_cast<double>(truth.firstMean[t]);
    const double share = firstShare();
    first.traced = static_cast<double>(film.firstSum) / (share * film.samples);
    result.first = stepsOf(first, comparable);
    for (std::size_t c = 0; c < kBlameCauses; ++c)
        result.others[c] =
            (luminanceOfRadiance(steps[c]) - share * result.first[c]) / (1.0 - share);
    return result;
}

} // namespace patina
