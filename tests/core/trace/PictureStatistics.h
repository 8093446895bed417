// Whether two ways to compute a picture have the same mean, told from pictures of independent
// seeds of each.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina::test {

// Of one way: [seed][pixel], rows of pixels from the top. Their number is even, and at least 4.
using SeedPictures = std::vector<std::vector<glm::dvec3>>;

// The standard normal value that is as far out as Student's t of so many degrees of freedom is.
// Hill 1970, "Algorithm 395: Student's t-distribution", Communications of the ACM 13(10).
[[nodiscard]] double normalOfStudent(double t, double freedom);

// (a - b) / its standard error, of one channel of a pixel.
struct Difference {
    double normal = 0.0; // standard normal where both have the same mean, and seeds are near normal
    double unskewed =
        0.0; // of mean 0 and variance 1 or little more, however the seeds are distributed
};
// Nothing for a pixel where the seeds of a half all agree within rounding: the background, or
// something that most of them miss.
//
// Pixels of few bright samples are skewed, and their variance is small when their mean is: a mean
// over its own standard error would be too low on average, and the mean over a picture would find a
// bias that is not there. So the difference of one half of the seeds is divided by the standard
// error of the other half, which it is independent of: the mean of that is 0 for any distribution,
// and its variance that of Student's t with Welch's degrees of freedom f, f / (f - 2). `unskewed`
// is the sum of both halves over the root of twice that. `normal` turns each half into the normal
// value that is as far out; that is no linear function, so of skewed seeds its mean is a little off
// 0.
[[nodiscard]] std::vector<std::optional<Difference>>
differences(const SeedPictures& a, const SeedPictures& b, int channel);

// What n pixels say together.
struct DifferenceSummary {
    std::size_t count = 0;   // n
    double passing = 0.0;    // share of those below the bound that all n keep with 99 % (Šidák)
    double mean = 0.0;       // of all, in standard errors: times sqrt n
    double worstBlock = 0.0; // the same of 32 × 32 pixels, by absolute value
};
[[nodiscard]] DifferenceSummary summary(const std::vector<std::optional<Difference>>& pixels,
                                        int width);

// EXPECTs 99.75 % of the pixels to pass, a mean within 3, and that of every block within 5.
void expectSameMean(const SeedPictures& a, const SeedPictures& b, int width,
                    const std::string& name);

} // namespace patina::test
