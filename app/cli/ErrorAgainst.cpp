#include "app/cli/ErrorAgainst.h"

#include "app/cli/Report.h"
#include "app/cli/TracedPicture.h"
#include "core/compare/Flip.h"
#include "core/compare/Metrics.h"
#include "core/image/Channels.h"
#include "core/io/ImageIO.h"
#include "core/math/Shading.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

constexpr const char* kGeometryKey = "patina:scene.geometry";
constexpr const char* kMaterialsKey = "patina:scene.materials";
constexpr const char* kLightsKey = "patina:scene.lights";
constexpr const char* kEnvironmentKey = "patina:scene.environment";
constexpr const char* kCameraKey = "patina:camera";
constexpr const char* kBackgroundKey = "patina:background";

Error otherReference(const std::string& file, std::string message) {
    return {ErrorKind::InputBroken, std::move(message), file, {}};
}

// The first thing that the reference says of itself and that is not so here.
std::optional<std::string> differingSubject(const std::map<std::string, std::string>& there,
                                            const PictureSubject& subject) {
    const std::map<std::string, std::string> here = attributesOf(subject);
    const auto differs = [&](const char* key) {
        const auto said = there.find(key);
        return said != there.end() && said->second != here.at(key);
    };
    for (const auto& [key, what] :
         {std::pair{kGeometryKey, "the geometry of its scene"},
          {kMaterialsKey, "the materials or the shading model of its scene"},
          {kLightsKey, "the lights of its scene"},
          {kEnvironmentKey, "the environment of its scene"}})
        if (differs(key))
            return what;
    for (const auto& [key, what] :
         {std::pair{kCameraKey, "the camera"}, {kBackgroundKey, "the background"}})
        if (differs(key))
            return fmt::format("{} ({} there, {} here)", what, there.at(key), here.at(key));
    return std::nullopt;
}

double meanLuminance(const Image& image) {
    const auto stride = static_cast<std::size_t>(image.channels());
    const auto values = image.f32();
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); i += stride)
        sum += static_cast<double>(
            shading::luminance(glm::vec3(values[i], values[i + 1], values[i + 2])));
    return sum / static_cast<double>(values.size() / stride);
}

Image colorOf(const Image& image) {
    return image.channels() > 3 ? withoutAlpha(image) : image;
}

} // namespace

PictureSubject subjectOf(const Document& document, const Camera& camera) {
    return {hashTraceInputs(traceInputs(document)), cameraText(camera),
            backgroundText(document.view)};
}

std::map<std::string, std::string> attributesOf(const PictureSubject& subject) {
    return {{kGeometryKey, subject.scene.geometry.hex()},
            {kMaterialsKey, subject.scene.materials.hex()},
            {kLightsKey, subject.scene.lights.hex()},
            {kEnvironmentKey, subject.scene.environment.hex()},
            {kCameraKey, subject.camera},
            {kBackgroundKey, subject.background}};
}

Result<Image> loadReference(Session& session, const std::string& file, int width, int height,
                            const PictureSubject& subject) {
    ImageLoadOptions options;
    options.sanitize = false; // broken pixels are no reference, and said so
    options.colorOnly = true;
    Result<LoadedImage> loaded = loadImage(session.worker(), file, options, session.job());
    if (!loaded)
        return loaded.error();
    const Image& image = loaded->image();
    if (image.type() != PixelType::F32 || image.encoding() != ColorEncoding::Linear ||
        image.channels() < 3)
        return otherReference(file, "--error-against wants linear colour, as .exr and .hdr have "
                                    "it: render the reference into such a file");
    if (image.width() != width || image.height() != height)
        return otherReference(
            file, fmt::format("the reference has {} × {} pixels, the picture {} × {}; render it "
                              "in the same size",
                              image.width(), image.height(), width, height));
    if (const auto what = differingSubject(loaded->parts.front().attributes, subject))
        return otherReference(
            file, fmt::format("the reference is of another picture: they differ in {}", *what));
    return colorOf(image);
}

Result<void> reportError(Session& session, const std::string& file, const Image& radiance,
                         const Image& reference) {
    session.job().setActivity("comparing");
    const Image image = colorOf(radiance);
    const auto naming = [&](Error error) {
        if (error.file.empty())
            error.file = file;
        return error;
    };
    const Result<ImageMetrics> metrics = compareImages(image, reference);
    if (!metrics)
        return naming(metrics.error());
    const Result<Flip> flip = computeFlip(image, reference, session.job());
    if (!flip)
        return naming(flip.error());
    const double there = meanLuminance(reference), here = meanLuminance(image);
    const bool finiteBias = there > 0.0 && here > 0.0;
    const double biasEv = finiteBias ? std::log2(here / there) : 0.0;
    const bool finitePsnr = std::isfinite(metrics->psnr);

    const auto orNull = [](bool known, double value) {
        return known ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
    };
    nlohmann::ordered_json& json = session.report().json()["errorAgainst"];
    json = {{"reference", file},
            {"rmse", metrics->rmse},
            {"relmse", metrics->relMse},
            {"psnr", orNull(finitePsnr, metrics->psnr)}, // JSON has no infinity
            {"flip", flip->error.summary.mean},
            {"biasEv", orNull(finiteBias, biasEv)},
            {"max", metrics->max},
            {"maxPixel", {metrics->maxPosition.x, metrics->maxPosition.y}}};
    std::string seen;
    if (const std::optional<FlipExposures>& exposures = flip->exposures) {
        json["flipExposures"] = {
            {"start", exposures->start}, {"stop", exposures->stop}, {"count", exposures->count}};
        seen =
            fmt::format(" (HDR, {} exposures from {:+.2f} to {:+.2f} EV, {:.0f} pixels per "
                        "degree)",
                        exposures->count, exposures->start, exposures->stop, kFlipPixelsPerDegree);
    }
    session.report().table(
        fmt::format("Error against {}", file),
        {{"rmse", fmt::format("{:.6g}", metrics->rmse)},
         {"relmse", fmt::format("{:.6g}", metrics->relMse)},
         {"psnr", finitePsnr ? fmt::format("{:.2f} dB of a peak of 1", metrics->psnr)
                             : std::string("infinite (identical)")},
         {"flip", fmt::format("{:.6g}{}", flip->error.summary.mean, seen)},
         {"bias", finiteBias ? fmt::format("{:+.4f} EV of the mean luminance", biasEv)
                             : std::string("unknown: one of them is black")},
         {"max", fmt::format("{:.6g} at {},{}", metrics->max, metrics->maxPosition.x,
                             metrics->maxPosition.y)}});
    return {};
}

} // namespace patina::cli
