#include "core/trace/blame/Blame.h"

#include "core/base/Check.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/View.h"
#include "core/math/Shading.h"
#include "core/trace/error/PictureError.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace patina {
namespace {

constexpr double kKnownAbove = 2.0;          // standard errors of the squared error
constexpr std::size_t kPixelsAtATime = 4096; // between two looks at the job

// Sums over the pixels of a material. Products of two numbers with noise take one of the first
// samples and one of the others, whose noises are independent, so that it adds nothing on average.
class BlameScoreSums {
  public:
    void add(const BlameSteps::Pixel& pixel, double weight, double traced, double firstShare) {
        const double first = std::accumulate(pixel.first.begin(), pixel.first.end(), 0.0);
        const double others = std::accumulate(pixel.others.begin(), pixel.others.end(), 0.0);
        const auto mean = [&](double a, double b) {
            return firstShare * a + (1.0 - firstShare) * b;
        };
        // Of the mean of all samples, by how far both parts are apart.
        const auto deviation = [&](double a, double b) {
            return (a - b) * std::sqrt(firstShare * (1.0 - firstShare));
        };
        const double total = mean(first, others), totalNoise = deviation(first, others);
        const double errorNoise = weight * 2.0 * total * totalNoise;
        ++m_pixels;
        m_traced += traced;
        m_error += weight * first * others;
        m_errorVariance += errorNoise * errorNoise;
        for (std::size_t c = 0; c < kBlameCauses; ++c) {
            Cause& cause = m_causes[c];
            const double a = pixel.first[c], b = pixel.others[c];
            cause.projection += 0.5 * weight * (a * others + b * first);
            cause.squares += weight * a * b;
            cause.sum += mean(a, b);
            const double noise = weight * (total * deviation(a, b) + mean(a, b) * totalNoise);
            cause.variance += noise * noise;
            cause.covariance += noise * errorNoise;
        }
    }

    [[nodiscard]] BlameScore score(Id material) const {
        BlameScore score;
        score.material = material;
        score.pixels = m_pixels;
        if (m_pixels == 0)
            return score;
        const auto count = static_cast<double>(m_pixels);
        score.relative = std::sqrt(std::max(m_error / count, 0.0));
        score.isKnown = m_error > kKnownAbove * std::sqrt(m_errorVariance);
        for (std::size_t c = 0; c < kBlameCauses; ++c) {
            const Cause& cause = m_causes[c];
            BlameShare& share = score.causes[c];
            share.relative = std::sqrt(std::max(cause.squares / count, 0.0));
            share.bias = m_traced > 0.0 ? -cause.sum / m_traced : 0.0;
            if (!score.isKnown)
                continue;
            share.share = cause.projection / m_error;
            // Of a quotient, to first order.
            share.noise = std::sqrt(std::max(cause.variance - 2.0 * share.share * cause.covariance +
                                                 share.share * share.share * m_errorVariance,
                                             0.0)) /
                          m_error;
        }
        return score;
    }
    [[nodiscard]] double error() const { return m_error; }

  private:
    struct Cause {
        double projection = 0.0, squares = 0.0, sum = 0.0;
        double variance = 0.0, covariance = 0.0; // of the projection, and with the error
    };
    std::size_t m_pixels = 0;
    double m_traced = 0.0, m_error = 0.0, m_errorVariance = 0.0;
    std::array<Cause, kBlameCauses> m_causes{};
};

} // namespace

std::optional<BlameCause> BlameScore::largest() const {
    if (!isKnown)
        return std::nullopt;
    const auto found = std::ranges::max_element(causes, {}, &BlameShare::share);
    return static_cast<BlameCause>(found - causes.begin());
}

std::optional<std::array<double, kBlameCauses>> Blame::at(std::size_t pixel) const {
    std::array<double, kBlameCauses> result{};
    double sum = 0.0;
    for (std::size_t c = 0; c < kBlameCauses; ++c) {
        const float* step = steps[c].f32().data() + 3 * pixel;
        result[c] = static_cast<double>(shading::luminance({step[0], step[1], step[2]}));
        sum += result[c];
    }
    if (sum == 0.0)
        return std::nullopt;
    for (double& share : result)
        share /= sum;
    return result;
}

BlameScore Blame::around(int x, int y, int radius, std::span<const Id> materials) const {
    const int width = steps.front().width(), height = steps.front().height();
    CHECK(pixels.size() == materials.size());
    CHECK(x >= 0 && y >= 0 && x < width && y < height);
    const auto at = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column);
    };
    const Id material = materials[at(x, y)];
    BlameScoreSums sums;
    for (int row = std::max(y - radius, 0); row <= std::min(y + radius, height - 1); ++row)
        for (int column = std::max(x - radius, 0); column <= std::min(x + radius, width - 1);
             ++column) {
            const BlamePixel& pixel = pixels[at(column, row)];
            if (materials[at(column, row)] != material)
                continue;
            BlameSteps::Pixel parts;
            std::ranges::copy(pixel.first, parts.first.begin());
            std::ranges::copy(pixel.others, parts.others.begin());
            sums.add(parts, static_cast<double>(pixel.weight), static_cast<double>(pixel.traced),
                     firstShare);
        }
    return sums.score(material);
}

Result<Blame> blame(const DrawnTerms& drawn, const BlameFilm& traced, const Film& film,
                    const View& view, std::span<const Id> materials, const JobContext& job,
                    bool keepsPixels) {
    const Result<BlameSteps> steps = BlameSteps::of(drawn, traced, film);
    if (!steps)
        return steps.error();
    Blame result;
    for (Image& image : result.steps)
        image = Image(film.width(), film.height(), 3, PixelType::F32, ColorEncoding::Linear);
    result.firstShare = steps->firstShare();
    if (keepsPixels)
        result.pixels.resize(film.pixels().size());
    const double dark = darkLuminance(view, luminanceOf(film.radiance()));
    const bool tellsMaterials = materials.size() == film.pixels().size();
    BlameScoreSums all;
    std::map<Id, BlameScoreSums> each;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        if (i % kPixelsAtATime == 0 && job.stopping())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        const BlameSteps::Pixel pixel = steps->at(i);
        for (std::size_t c = 0; c < kBlameCauses; ++c)
            for (int channel = 0; channel < 3; ++channel)
                result.steps[c].f32()[3 * i + static_cast<std::size_t>(channel)] =
                    pixel.steps[c][channel];
        const double truth = film.pixels()[i].luminance();
        const double weight = 1.0 / (truth * truth + dark * dark);
        if (keepsPixels) {
            BlamePixel& kept = result.pixels[i];
            for (std::size_t c = 0; c < kBlameCauses; ++c) {
                kept.first[c] = static_cast<float>(pixel.first[c]);
                kept.others[c] = static_cast<float>(pixel.others[c]);
            }
            kept.weight = static_cast<float>(weight);
            kept.traced = static_cast<float>(truth);
        }
        all.add(pixel, weight, truth, steps->firstShare());
        if (tellsMaterials && materials[i] != 0)
            each[materials[i]].add(pixel, weight, truth, steps->firstShare());
    }
    result.whole = all.score(0);
    for (const auto& [material, sums] : each)
        result.materials.push_back(sums.score(material));
    std::ranges::stable_sort(result.materials, std::greater(), [&](const BlameScore& score) {
        return each.at(score.material).error();
    });
    return result;
}

} // namespace patina
