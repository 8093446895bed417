#include "core/rank/LightSweep.h"

#include "core/base/Check.h"
#include "core/compare/FlipAgainst.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <utility>

namespace patina {
namespace {

constexpr float kSurround = shading::kMiddleGrey; // displayed light where no surface is
constexpr std::size_t kLightRange = 8;            // lights, some milliseconds each
constexpr std::size_t kPixelRange = 64;           // pixels, under all lights

Error sweepEnded() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

struct Exposure {
    float scale;
    shading::ToneCurve curve;
};

// The light of a sweep as coefficients, rotated and scaled.
class SweepLights {
  public:
    SweepLights(std::span<const SweepEnvironment> environments, const SweepSettings& settings,
                int order)
        : m_environments(environments)
        , m_scale(settings.scale)
        , m_order(order)
        , m_rotationCount(static_cast<std::size_t>(settings.rotations)) {
        for (std::size_t r = 0; r < m_rotationCount; ++r)
            m_rotations.push_back(ShRotation::aboutY(glm::radians(rotationDeg(r)), order));
    }
    [[nodiscard]] std::size_t count() const { return m_environments.size() * m_rotationCount; }
    [[nodiscard]] SweepLight light(std::size_t index) const {
        return {index / m_rotationCount, rotationDeg(index % m_rotationCount)};
    }
    [[nodiscard]] std::vector<glm::vec3> coefficients(std::size_t index) const {
        return coefficients(index / m_rotationCount, m_rotations[index % m_rotationCount]);
    }
    [[nodiscard]] std::vector<glm::vec3> coefficients(const SweepLight& light) const {
        return coefficients(light.environment,
                            ShRotation::aboutY(glm::radians(light.rotationDeg), m_order));
    }

  private:
    [[nodiscard]] double rotationDeg(std::size_t r) const {
        return 360.0 * static_cast<double>(r) / static_cast<double>(m_rotationCount);
    }
    [[nodiscard]] std::vector<glm::vec3> coefficients(std::size_t environment,
                                                      const ShRotation& rotation) const {
        const auto count = static_cast<std::size_t>(shCount(m_order));
        std::vector<glm::vec3> result(count);
        rotation.apply(std::span(m_environments[environment].harmonics).first(count),
                       std::span(result));
        for (glm::vec3& c : result)
            c *= m_scale;
        return result;
    }

    std::span<const SweepEnvironment> m_environments;
    glm::vec3 m_scale;
    int m_order;
    std::size_t m_rotationCount;
    std::vector<ShRotation> m_rotations;
};

glm::vec3 at(std::span<const float> planes, std::size_t count, std::size_t p) {
    return {planes[p], planes[count + p], planes[2 * count + p]};
}

void put(std::span<float> planes, std::size_t count, std::size_t p, const glm::vec3& value) {
    planes[p] = value.x;
    planes[count + p] = value.y;
    planes[2 * count + p] = value.z;
}

// How bright a picture's surfaces are, as the viewport's adaptation measures a picture.
Luminance luminanceOf(std::span<const float> radiance) {
    const std::size_t count = radiance.size() / 3;
    double sum = 0.0;
    float darkest = 0.0f, brightest = 0.0f;
    for (std::size_t p = 0; p < count; ++p) {
        const float log = shading::logLuminance(at(radiance, count, p));
        sum += log;
        darkest = p == 0 ? log : std::min(darkest, log);
        brightest = p == 0 ? log : std::max(brightest, log);
    }
    const auto average = static_cast<float>(std::exp2(sum / static_cast<double>(count)));
    return {average, average, std::exp2(darkest), std::exp2(brightest)};
}

Exposure exposureOf(const View& view, std::span<const float> radiance) {
    const Luminance luminance = needsLuminance(view) ? luminanceOf(radiance) : Luminance{};
    return {exposureScale(view, luminance), toneCurve(view, luminance)};
}

// The light that the display shows.
void show(const Exposure& exposure, std::span<const float> radiance, std::span<float> shown) {
    const std::size_t count = radiance.size() / 3;
    for (std::size_t p = 0; p < count; ++p)
        put(shown, count, p,
            glm::clamp(shading::toneMap(exposure.scale * at(radiance, count, p), exposure.curve),
                       glm::vec3(0.0f), glm::vec3(1.0f)));
}

// The curve of the display, undone.
float lightOfCode(const View& view, float code) {
    return view.displayTransfer == DisplayTransfer::Gamma ? std::pow(code, view.displayGamma)
                                                          : shading::srgbDecode(glm::vec3(code)).x;
}

DisplayEnds endsOf(const View& view) {
    return {lightOfCode(view, 0.5f / 255.0f), lightOfCode(view, 254.5f / 255.0f)};
}

Image emptyPicture(const SweepPixels& pixels) {
    Image image(pixels.width, pixels.height, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> out = image.f32();
    std::fill(out.begin(), out.end(), kSurround);
    return image;
}

void paint(const SweepPixels& pixels, std::span<const float> shown, Image& image) {
    const std::span<float> out = image.f32();
    for (std::size_t p = 0; p < pixels.count(); ++p)
        for (std::size_t c = 0; c < 3; ++c)
            out[3 * std::size_t{pixels.places[p]} + c] = shown[c * pixels.count() + p];
}

Image pictureOf(const SweepPixels& pixels, std::span<const float> shown) {
    Image image = emptyPicture(pixels);
    paint(pixels, shown, image);
    return image;
}

// The picture of one light, in buffers of one thread.
struct SweepFrame {
    explicit SweepFrame(std::size_t count)
        : radiance(3 * count)
        , shown(3 * count) {}
    void draw(const SweepPixels& pixels, const View& view,
              std::span<const glm::vec3> coefficients) {
        sweepRadiance(pixels, coefficients, 0, pixels.count(), radiance);
        show(exposureOf(view, radiance), radiance, shown);
    }

    std::vector<float> radiance, shown; // planar
};

// Over all lights, pixel by pixel.
struct SweepSums {
    std::vector<float> meanLook;  // planar
    std::vector<float> deviation; // stops
};

class Sweep {
  public:
    Sweep(const SweepPixels& pixels, std::span<const SweepEnvironment> environments,
          const SweepSettings& settings, const JobContext& job)
        : m_pixels(pixels)
        , m_settings(settings)
        , m_job(job)
        , m_lights(environments, settings, pixels.order)
        , m_coefficients(m_lights.count()) {}

    Result<LightSweep> run() {
        for (std::size_t i = 0; i < m_coefficients.size(); ++i)
            m_coefficients[i] = m_lights.coefficients(i);
        m_job.setActivity("lighting the scene");
        findExposures();
        const SweepSums sums = sumOverLights();
        LightSweep sweep;
        std::vector<float> look = sums.meanLook;
        if (m_settings.reference) {
            SweepFrame frame(m_pixels.count());
            frame.draw(m_pixels, m_settings.view, m_lights.coefficients(*m_settings.reference));
            look = frame.shown;
        }
        sweep.reference = pictureOf(m_pixels, look);
        sweep.referenceContrastStops = contrastStops(look);
        sweep.sensitivity = mapOf(sums.deviation);
        m_job.setActivity("scoring pictures");
        sweep.scores.resize(m_lights.count());
        if (Result<void> scored = score(sweep); !scored)
            return scored.error();
        if (m_job.cancelled())
            return sweepEnded();
        return sweep;
    }

  private:
    // Shares of the time that the three parts take, for the progress.
    static constexpr double kExposures = 0.1, kSums = 0.25;

    // Of each light's picture, where that depends on the picture; else one for all.
    void findExposures() {
        if (!needsLuminance(m_settings.view)) {
            m_exposures = {exposureOf(m_settings.view, {})};
            return;
        }
        m_exposures.resize(m_lights.count());
        std::atomic<std::size_t> done = 0;
        parallelFor(m_job, m_lights.count(), kLightRange, [&](std::size_t begin, std::size_t end) {
            std::vector<float> radiance(3 * m_pixels.count());
            for (std::size_t i = begin; i < end; ++i) {
                sweepRadiance(m_pixels, m_coefficients[i], 0, m_pixels.count(), radiance);
                m_exposures[i] = exposureOf(m_settings.view, radiance);
            }
            m_job.setProgress(kExposures * static_cast<double>(done += end - begin) /
                              static_cast<double>(m_lights.count()));
        });
    }
    [[nodiscard]] const Exposure& exposureAt(std::size_t light) const {
        return m_exposures[m_exposures.size() == 1 ? 0 : light];
    }

    // By ranges of pixels, each under all lights in their order: the sums are the same on any
    // number of threads.
    SweepSums sumOverLights() {
        const std::size_t count = m_pixels.count();
        SweepSums sums{std::vector<float>(3 * count), std::vector<float>(count)};
        std::atomic<std::size_t> done = 0;
        parallelFor(m_job, count, kPixelRange, [&](std::size_t begin, std::size_t end) {
            const std::size_t length = end - begin;
            std::vector<float> radiance(3 * length), light(3 * length);
            std::vector<double> mean(3 * length), first(length), second(length);
            for (std::size_t i = 0; i < m_lights.count() && !m_job.cancelled(); ++i) {
                sweepRadiance(m_pixels, m_coefficients[i], begin, end, radiance);
                show(exposureAt(i), radiance, light);
                for (std::size_t k = 0; k < light.size(); ++k)
                    mean[k] += light[k];
                for (std::size_t p = 0; p < length; ++p) {
                    const double stops =
                        std::log2(kSensitivityFloor + shading::luminance(exposureAt(i).scale *
                                                                         at(radiance, length, p)));
                    first[p] += stops;
                    second[p] += stops * stops;
                }
            }
            const auto all = static_cast<double>(m_lights.count());
            for (std::size_t p = 0; p < length; ++p) {
                for (std::size_t c = 0; c < 3; ++c)
                    sums.meanLook[c * count + begin + p] =
                        static_cast<float>(mean[c * length + p] / all);
                const double average = first[p] / all;
                sums.deviation[begin + p] = static_cast<float>(
                    std::sqrt(std::max(0.0, second[p] / all - average * average)));
            }
            m_job.setProgress(kExposures + kSums * static_cast<double>(done += length) /
                                               static_cast<double>(count));
        });
        return sums;
    }

    Result<void> score(LightSweep& sweep) {
        const Result<FlipAgainst> reference = FlipAgainst::create(sweep.reference);
        if (!reference)
            return notNumbers();
        const DisplayEnds ends = endsOf(m_settings.view);
        std::atomic<std::size_t> done = 0;
        std::atomic<bool> failed = false;
        parallelFor(m_job, m_lights.count(), kLightRange, [&](std::size_t begin, std::size_t end) {
            SweepFrame frame(m_pixels.count());
            Image picture = emptyPicture(m_pixels);
            FlipAgainst::Worker flip(*reference);
            std::vector<float> all(picture.f32().size() / 3), differences(m_pixels.count());
            for (std::size_t i = begin; i < end && !m_job.cancelled(); ++i) {
                LightScore& score = sweep.scores[i];
                score.light = m_lights.light(i);
                frame.draw(m_pixels, m_settings.view, m_coefficients[i]);
                if (std::ranges::any_of(frame.shown, [](float v) { return !std::isfinite(v); })) {
                    failed = true;
                    return;
                }
                score.clipped = clippedShares(frame.shown, ends);
                score.contrastStops = contrastStops(frame.shown);
                if (sweep.referenceContrastStops > 0.0)
                    score.lostContrast =
                        std::max(0.0, 1.0 - score.contrastStops / sweep.referenceContrastStops);
                paint(m_pixels, frame.shown, picture);
                flip.compare(picture, all);
                for (std::size_t p = 0; p < differences.size(); ++p)
                    differences[p] = all[m_pixels.places[p]];
                score.difference = differenceScore(differences);
                const auto place = static_cast<int>(m_pixels.places[score.difference.maxAt]);
                score.worstPixel = {place % m_pixels.width, place / m_pixels.width};
            }
            m_job.setProgress(kExposures + kSums +
                              (1.0 - kExposures - kSums) *
                                  static_cast<double>(done += end - begin) /
                                  static_cast<double>(m_lights.count()));
        });
        return failed ? Result<void>(notNumbers()) : Result<void>();
    }

    static Error notNumbers() {
        return {ErrorKind::InputBroken,
                "A light makes pixels that are no numbers; look for NaN in the bake and in the "
                "environments.",
                {},
                {}};
    }

    Image mapOf(const std::vector<float>& values) const {
        Image map(m_pixels.width, m_pixels.height, 1, PixelType::F32, ColorEncoding::Data);
        for (std::size_t p = 0; p < m_pixels.count(); ++p)
            map.f32()[m_pixels.places[p]] = values[p];
        return map;
    }

    const SweepPixels& m_pixels;
    const SweepSettings& m_settings;
    const JobContext& m_job;
    const SweepLights m_lights;
    std::vector<std::vector<glm::vec3>> m_coefficients; // of each light
    std::vector<Exposure> m_exposures;                  // of each light, or one
};

} // namespace

Result<LightSweep> sweepLights(const SweepPixels& pixels,
                               std::span<const SweepEnvironment> environments,
                               const SweepSettings& settings, const JobContext& job) {
    const auto usage = [](const char* message) { return Error{ErrorKind::Usage, message, {}, {}}; };
    if (settings.view.toneMap == ToneMap::OpenColorIo)
        return usage("lights are ranked with Patina's own tone curves; choose one in place of "
                     "OpenColorIO");
    if (settings.rotations < 1 || settings.rotations > kMostRotations)
        return usage("an environment is rotated 1 to 3600 times");
    if (environments.empty())
        return usage("there is no environment to rank");
    if (settings.reference && settings.reference->environment >= environments.size())
        return usage("the reference is none of the environments");
    CHECK(pixels.count() > 0);
    for (const SweepEnvironment& environment : environments)
        CHECK(environment.harmonics.size() >= static_cast<std::size_t>(shCount(pixels.order)));
    return Sweep(pixels, environments, settings, job).run();
}

Image sweepPicture(const SweepPixels& pixels, std::span<const SweepEnvironment> environments,
                   const SweepSettings& settings, const SweepLight& light) {
    CHECK(light.environment < environments.size());
    SweepSettings one = settings;
    one.rotations = 1;
    SweepFrame frame(pixels.count());
    frame.draw(pixels, settings.view,
               SweepLights(environments, one, pixels.order).coefficients(light));
    return pictureOf(pixels, frame.shown);
}

double rankingScore(const LightScore& score, RankBy by) {
    switch (by) {
    case RankBy::Clipping:
        return score.clipped.sum();
    case RankBy::Contrast:
        return score.lostContrast;
    case RankBy::Difference:
        break;
    }
    return score.difference.worst;
}

std::vector<std::size_t> rankLights(const LightSweep& sweep, RankBy by) {
    std::vector<std::size_t> order(sweep.scores.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return rankingScore(sweep.scores[a], by) > rankingScore(sweep.scores[b], by);
    });
    return order;
}

} // namespace patina
