#include "core/export/GltfEnvironment.h"

#include "core/base/Check.h"
#include "core/document/Source.h"
#include "core/image/Rgbd.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/Ibl.h"
#include "core/light/Orientation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

namespace patina {
namespace {

// A face as the extension wants it: mirrored left to right against OpenGL's, which makes it what is
// seen from inside in glTF's right-handed frame.
Image rgbdFace(const CubeLevel& level, int face, float scale) {
    Image image(level.size, level.size, 4, PixelType::U8, ColorEncoding::Data);
    const std::span<std::uint8_t> out = image.u8();
    std::size_t i = 0;
    for (int y = 0; y < level.size; ++y)
        for (int x = level.size - 1; x >= 0; --x) {
            const std::size_t texel =
                (static_cast<std::size_t>(face) * level.size + y) * level.size + x;
            for (const std::uint8_t sample : rgbdFromColor(level.texels[texel] / scale))
                out[i++] = sample;
        }
    return image;
}

std::string nameOf(const Environment& environment) {
    if (environment.kind == EnvironmentKind::Sky)
        return "Sky";
    if (environment.kind == EnvironmentKind::Softboxes)
        return "Softboxes";
    return isBuiltin(environment.source)
               ? builtinName(environment.source)
               : std::filesystem::path(environment.source).stem().string();
}

} // namespace

RgbdFit fitRgbd(const Image& environment) {
    CHECK(environment.type() == PixelType::F32);
    CHECK_EQ(environment.channels(), 3);
    const std::span<const float> samples = environment.f32();
    const auto width = static_cast<std::size_t>(environment.width());
    double sum = 0.0, weights = 0.0;
    float brightest = 0.0f;
    for (int y = 0; y < environment.height(); ++y) {
        double row = 0.0;
        for (std::size_t i = 3 * width * y; i < 3 * width * (y + 1); i += 3) {
            const float value = std::max({samples[i], samples[i + 1], samples[i + 2]});
            row += value;
            brightest = std::max(brightest, value);
        }
        const double weight = std::sin(std::numbers::pi * (y + 0.5) / environment.height());
        sum += weight * row;
        weights += weight * static_cast<double>(width);
    }
    RgbdFit fit;
    const double mean = sum / weights;
    if (mean > 0.0 && std::isfinite(mean) && (mean < 0.25 || mean > 4.0))
        fit.scale =
            static_cast<float>(std::exp2(std::clamp(std::round(std::log2(mean)), -60.0, 60.0)));
    fit.tooBright = brightest > kLargestRgbd * fit.scale;
    return fit;
}

namespace {

glm::dquat about(const glm::dvec3& axis, float degrees) {
    const double half = degrees * std::numbers::pi / 360.0;
    return {std::cos(half), std::sin(half) * axis};
}

glm::dquat quaternion(const Orientation& stands) {
    const glm::dquat rotation = about({0.0, 1.0, 0.0}, stands.rotationDeg);
    return stands.isLevel() ? rotation
                            : rotation * about({1.0, 0.0, 0.0}, stands.tiltDeg) *
                                  about({0.0, 0.0, 1.0}, stands.rollDeg);
}

} // namespace

Result<GltfEnvironment> encodeGltfEnvironment(WorkerClient& worker, const Environment& environment,
                                              const JobContext& job) {
    CHECK(environment.image != nullptr);
    IblSettings settings;
    settings.cubeSize = kGltfEnvironmentSize;
    settings.levels = kGltfEnvironmentLevels;
    settings.spacing = LevelSpacing::Even; // levels are mips
    Result<IblMaps> maps = computeIbl(*environment.image, settings, job);
    if (!maps)
        return maps.error();

    GltfEnvironment result;
    const RgbdFit fit = fitRgbd(*environment.image);
    result.name = nameOf(environment);
    result.intensity = static_cast<double>(fit.scale) * std::exp2(environment.exposureEv);
    result.rotation = quaternion(orientationOf(environment));
    for (std::size_t i = 0; i < result.irradiance.size(); ++i)
        result.irradiance[i] = maps->irradianceSh[i] / fit.scale;

    job.setActivity("encoding the environment");
    const std::size_t count = 6 * maps->prefiltered.size();
    std::vector<std::optional<Result<Bytes>>> encoded(count);
    parallelFor(job, count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            encoded[i] = encodeImage(
                worker, rgbdFace(maps->prefiltered[i / 6], static_cast<int>(i % 6), fit.scale),
                ImageFileFormat::Png);
    });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "the export was cancelled; nothing was written", {}, {}};
    result.images.resize(maps->prefiltered.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (!encoded[i]->ok())
            return encoded[i]->error();
        result.images[i / 6][i % 6] = std::move(**encoded[i]);
    }
    return result;
}

} // namespace patina
