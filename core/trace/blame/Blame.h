// Which shortcut of the drawn picture makes how much of its error: shares of the picture, of each
// material and of a pixel. docs/maths/blame.md has the formulas.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/blame/BlameSteps.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace patina {

struct View;

struct BlameShare {
    double share = 0.0; // of the squared relative error; below 0: it hides another cause's error
    double noise = 0.0; // standard error of the share
    // What the error would be with this cause alone: root mean square, relative as
    // ErrorScore::relative is.
    double relative = 0.0;
    // Light that the cause adds to the picture, below 0 takes away, over that of the traced
    // picture.
    double bias = 0.0;
};

struct BlameScore {
    Id material = 0; // of the pixels; 0 in Blame::whole: all of them
    std::size_t pixels = 0;
    double relative = 0.0; // ErrorScore::relative, by both parts of the samples
    // The error is larger than twice its noise: there is something to be shared out.
    bool isKnown = false;
    std::array<BlameShare, kBlameCauses> causes; // by BlameCause; the shares add up to 1

    [[nodiscard]] const BlameShare& of(BlameCause cause) const {
        return causes[static_cast<std::size_t>(cause)];
    }
    // Of the largest share; nothing while the error is not known.
    [[nodiscard]] std::optional<BlameCause> largest() const;
};

// What the shares of a few pixels are computed from: BlameSteps::Pixel, as floats.
struct BlamePixel {
    std::array<float, kBlameCauses> first{}, others{};
    float weight = 0.0f, traced = 0.0f; // of the relative error; luminance
};

struct Blame {
    BlameScore whole;
    std::vector<BlameScore> materials; // those seen, by their part of the whole error
    // F32, linear, 3 channels: BlameSteps::Pixel::steps, by BlameCause.
    std::array<Image, kBlameCauses> steps;

    std::vector<BlamePixel> pixels; // empty unless they were to be kept
    double firstShare = 0.5;        // BlameSteps::firstShare()

    // Of the pixels of one material, materials[pixel], that are at most `radius` pixels beside or
    // above one: of the pixel itself alone the noise would be as large as its shares. CHECKs that
    // `pixels` were kept and the pixel is one of them.
    [[nodiscard]] BlameScore around(int x, int y, int radius, std::span<const Id> materials) const;

    // Shares of the error of one pixel's luminance; nothing where there is none.
    [[nodiscard]] std::optional<std::array<double, kBlameCauses>> at(std::size_t pixel) const;
};

// `view`: whose exposure says what counts as dark. `materials`: seenMaterials(); empty: no scores
// of materials. `keepsPixels`: 80 bytes each. Errors: those of BlameSteps::of(); Cancelled.
Result<Blame> blame(const DrawnTerms& drawn, const BlameFilm& traced, const Film& film,
                    const View& view, std::span<const Id> materials, const JobContext& job,
                    bool keepsPixels = false);

} // namespace patina
