#include "app/cli/Commands.h"
#include "app/cli/Numbers.h"
#include "app/cli/SceneSetup.h"
#include "core/compare/DifferencePicture.h"
#include "core/compare/FitImage.h"
#include "core/compare/Flip.h"
#include "core/compare/Metrics.h"
#include "core/compare/Ssim.h"
#include "core/image/Chromaticities.h"
#include "core/io/ImageIO.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace patina::cli {
namespace {

// More channels than a picture has, such as those of a bake file, have no look.
constexpr int kPictureChannels = 4;

struct Scores {
    ImageMetrics metrics;
    std::optional<Flip> flip; // neither where the images are no pictures
    std::optional<double> ssim;

    [[nodiscard]] std::optional<double> byName(std::string_view name) const {
        if (name == "rmse")
            return metrics.rmse;
        if (name == "relmse")
            return metrics.relMse;
        if (name == "psnr")
            return metrics.psnr;
        if (name == "max")
            return metrics.max;
        if (name == "flip")
            return flip ? std::optional(flip->error.summary.mean) : std::nullopt;
        return ssim;
    }
};

struct Limit {
    std::string metric, text;
    double value = 0;
    bool above = true; // it fails above, else below
};

Error usage(const std::string& message) {
    return {ErrorKind::Usage, message, {}, {}};
}

Result<std::vector<Limit>> parseLimits(const CompareOptions& options) {
    constexpr std::array<std::string_view, 6> kMetrics{"rmse", "relmse", "psnr",
                                                       "max",  "flip",   "ssim"};
    std::vector<Limit> limits;
    for (const bool above : {true, false})
        for (const std::string& text : above ? options.failAbove : options.failBelow) {
            const char* name = above ? "--fail-above" : "--fail-below";
            const std::size_t equals = text.find('=');
            std::vector<double> value;
            if (equals == std::string::npos ||
                !parseNumbers(std::string_view(text).substr(equals + 1), ',', value) ||
                value.size() != 1 || std::isnan(value[0]))
                return usage(fmt::format("{} {}: expected METRIC=NUMBER", name, text));
            const std::string metric = text.substr(0, equals);
            if (std::find(kMetrics.begin(), kMetrics.end(), metric) == kMetrics.end())
                return usage(fmt::format("{} {}: there is no metric \"{}\"; metrics are {}", name,
                                         text, metric, fmt::join(kMetrics, ", ")));
            limits.push_back({metric, text.substr(equals + 1), value[0], above});
        }
    return limits;
}

// Measures refuse what is no number, too, but do not know the file.
Result<void> checkNumbers(const std::string& file, const Image& image) {
    if (image.type() != PixelType::F32)
        return {};
    const auto count =
        std::ranges::count_if(image.f32(), [](float value) { return !std::isfinite(value); });
    if (count == 0)
        return {};
    return Error{ErrorKind::InputBroken,
                 fmt::format("{} of its samples are NaN or infinite, so no distance can be given; "
                             "mend them where the file was made",
                             count),
                 file,
                 {}};
}

Result<LoadedImage> load(Session& session, const std::string& file) {
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    options.sanitize = false; // signed coefficients and broken pixels are compared as they are
    return loadImage(session.worker(), file, options);
}

// Where red, green and blue stand: OpenEXR sorts channels by name.
std::optional<std::array<std::size_t, 3>> colorChannels(const Image& image) {
    std::array<std::size_t, 3> places{0, 1, 2};
    const std::vector<std::string>& names = image.channelNames();
    for (std::size_t c = 0; c < places.size() && !names.empty(); ++c) {
        const auto found = std::ranges::find(names, std::string(1, "RGB"[c]));
        if (found == names.end())
            return std::nullopt;
        places[c] = static_cast<std::size_t>(found - names.begin());
    }
    return image.channels() < 3 ? std::nullopt : std::optional(places);
}

// Differences are of linear Rec.709: the same numbers of other primaries are another colour.
void toRec709Primaries(Session& session, const std::string& file, ImagePart& part) {
    const auto text = part.attributes.find("chromaticities");
    if (text == part.attributes.end() || part.image.type() != PixelType::F32)
        return;
    const auto primaries = parseChromaticities(text->second);
    const auto channels = colorChannels(part.image);
    if (!primaries || *primaries == kRec709 || !channels)
        return;
    const auto matrix = toRec709(*primaries);
    if (!matrix)
        return;
    const auto [r, g, b] = *channels;
    const std::span<float> values = part.image.f32();
    const auto step = static_cast<std::size_t>(part.image.channels());
    for (std::size_t i = 0; i < values.size(); i += step) {
        const glm::vec3 color = *matrix * glm::vec3(values[i + r], values[i + g], values[i + b]);
        values[i + r] = color.r;
        values[i + g] = color.g;
        values[i + b] = color.b;
    }
    session.report().json()["converted"].push_back(
        {{"file", file}, {"from", text->second}, {"to", "Rec.709"}});
    session.report().warn(fmt::format(
        "{} says that its colours have primaries of their own ({}); they were converted to Rec.709",
        file, text->second));
}

// Brings the reference to the image's size where that was asked for; never silently.
Result<void> fit(Session& session, const CompareOptions& options, const Image& image,
                 Image& reference) {
    const int width = reference.width(), height = reference.height();
    if (width == image.width() && height == image.height())
        return {};
    const std::string sizes =
        fmt::format("{} × {} and {} × {} pixels", image.width(), image.height(), width, height);
    if (!options.fit)
        return usage(fmt::format("the images differ in size: {}; --fit scales {} to the size of {}",
                                 sizes, options.reference, options.image));
    const bool stretched = static_cast<std::int64_t>(width) * image.height() !=
                           static_cast<std::int64_t>(height) * image.width();
    reference = fitImage(reference, image.width(), image.height());
    session.report().json()["fitted"] = {{"from", {width, height}},
                                         {"to", {image.width(), image.height()}},
                                         {"stretched", stretched}};
    session.report().warn(fmt::format(
        "{} was scaled from {} × {} to {} × {} pixels{}", options.reference, width, height,
        image.width(), image.height(), stretched ? ", which changes its proportions" : ""));
    return {};
}

Result<Scores> computeScores(Session& session, const Image& image, const Image& reference) {
    Scores scores;
    Result<ImageMetrics> metrics = compareImages(image, reference);
    if (!metrics)
        return metrics.error();
    scores.metrics = *metrics;
    if (image.channels() > kPictureChannels)
        return scores;
    session.job().setActivity("comparing");
    Result<Flip> flip = computeFlip(image, reference, session.job());
    if (!flip)
        return flip.error();
    scores.flip = std::move(*flip);
    const Result<Ssim> ssim = computeSsim(image, reference, session.job());
    if (!ssim)
        return ssim.error();
    scores.ssim = ssim->mean;
    return scores;
}

Result<Image> valuesToShow(Session& session, const CompareOptions& options, const Image& image,
                           const Image& reference, const Scores& scores) {
    if (options.difference == DifferenceShown::Flip)
        return scores.flip->error.values;
    const Difference difference = options.difference == DifferenceShown::Signed ? Difference::Signed
                                  : options.difference == DifferenceShown::Absolute
                                      ? Difference::Absolute
                                      : Difference::Relative;
    Result<ErrorMap> map = differenceMap(image, reference, difference, session.job());
    if (!map)
        return map.error();
    return std::move(map->values);
}

// One value per pixel: into an .exr as it is, else in colours.
Result<void> writeValues(Session& session, const CompareOptions& options, Image values,
                         const Scores& scores, ImageFileFormat format) {
    constexpr std::array kNames{"channels", "signed", "absolute", "relative", "flip"};
    const char* name = kNames[static_cast<std::size_t>(options.difference)];
    if (options.visible > 0.0f)
        hideInvisible(values, scores.flip->error.values, options.visible);
    nlohmann::ordered_json& json = session.report().json()["difference"];
    json = {{"shown", name}};
    if (options.visible > 0.0f)
        json["visible"] = options.visible;
    if (format == ImageFileFormat::Exr) {
        values.setChannelNames({"Y"});
        if (Result<void> saved = saveImage(session.worker(), values, options.output); !saved)
            return saved;
        session.report().output(options.output, fmt::format("{} difference as numbers", name));
        return {};
    }

    const bool isSigned = options.difference == DifferenceShown::Signed;
    const bool isFlip = options.difference == DifferenceShown::Flip;
    const auto largest = static_cast<float>(summarize(values).max);
    // Equal images have a range, too, in which they are shown as equal.
    const float to = options.range.value_or(isFlip || !(largest > 0.0f) ? 1.0f : largest);
    const float from = isSigned ? -to : 0.0f;
    const ColorMap map = isSigned ? ColorMap::Diverging
                         : isFlip ? ColorMap::Magma
                                  : ColorMap::Sequential;
    if (Result<void> saved =
            saveImage(session.worker(), colorErrors(values, map, from, to), options.output);
        !saved)
        return saved;
    json["from"] = from;
    json["to"] = to;
    session.report().output(
        options.output,
        fmt::format("{} difference, colours from {:.4g} to {:.4g}", name, from, to));
    return {};
}

Result<void> writeDifference(Session& session, const CompareOptions& options, const Image& image,
                             const Image& reference, const Scores& scores, ImageFileFormat format) {
    if (options.difference == DifferenceShown::Channels) {
        Result<Image> difference = differenceImage(image, reference);
        if (!difference)
            return difference.error();
        if (Result<void> saved = saveImage(session.worker(), *difference, options.output); !saved)
            return saved;
        session.report().output(options.output, "absolute difference");
        return {};
    }
    if (!scores.flip && (options.difference == DifferenceShown::Flip || options.visible > 0.0f))
        return usage(
            fmt::format("flip needs pictures; these images have {} channels", image.channels()));
    Result<Image> values = valuesToShow(session, options, image, reference, scores);
    if (!values)
        return values.error();
    return writeValues(session, options, std::move(*values), scores, format);
}

std::string positionText(PixelPosition position) {
    return fmt::format("{},{}", position.x, position.y);
}

void report(Report& report, const CompareOptions& options, const Scores& scores) {
    const ImageMetrics& metrics = scores.metrics;
    const bool finitePsnr = std::isfinite(metrics.psnr);
    nlohmann::ordered_json& json = report.json();
    json["settings"] = {{"image", options.image}, {"reference", options.reference}};
    json["identical"] = metrics.different == 0;
    json["rmse"] = metrics.rmse;
    json["relmse"] = metrics.relMse;
    // JSON has no infinity, which identical images have.
    json["psnr"] = finitePsnr ? nlohmann::ordered_json(metrics.psnr) : nlohmann::ordered_json();
    json["max"] = metrics.max;
    json["maxPixel"] = {metrics.maxPosition.x, metrics.maxPosition.y};
    json["flip"] = nullptr;
    json["ssim"] = nullptr;
    json["samples"] = metrics.samples;
    json["different"] = metrics.different;
    std::vector<std::pair<std::string, std::string>> rows = {
        {"rmse", fmt::format("{:.6g}", metrics.rmse)},
        {"relmse", fmt::format("{:.6g}", metrics.relMse)},
        {"psnr", finitePsnr ? fmt::format("{:.2f} dB of a peak of 1", metrics.psnr)
                            : std::string("infinite (identical)")},
        {"max", metrics.different == 0
                    ? std::string("0")
                    : fmt::format("{:.6g} at {}", metrics.max, positionText(metrics.maxPosition))}};
    if (scores.flip) {
        const ErrorSummary& flip = scores.flip->error.summary;
        json["flip"] = flip.mean;
        json["ssim"] = *scores.ssim;
        nlohmann::ordered_json& details = json["flipDetails"];
        details = {{"kind", scores.flip->exposures ? "hdr" : "ldr"},
                   {"pixelsPerDegree", kFlipPixelsPerDegree},
                   {"max", flip.max},
                   {"maxPixel", {flip.maxPosition.x, flip.maxPosition.y}},
                   {"median", flip.median},
                   {"percentile95", flip.percentile95},
                   {"percentile99", flip.percentile99}};
        std::string seen = "LDR";
        if (const std::optional<FlipExposures>& exposures = scores.flip->exposures) {
            details["exposures"] = {{"start", exposures->start},
                                    {"stop", exposures->stop},
                                    {"count", exposures->count}};
            seen = fmt::format("HDR, {} exposures from {:+.2f} to {:+.2f} EV", exposures->count,
                               exposures->start, exposures->stop);
        }
        rows.emplace_back("flip", fmt::format("{:.6g} ({}, {:.0f} pixels per degree)", flip.mean,
                                              seen, kFlipPixelsPerDegree));
        if (flip.max > 0)
            rows.emplace_back("", fmt::format("largest {:.6g} at {}; median {:.4g}, 95 % {:.4g}, "
                                              "99 % {:.4g}",
                                              flip.max, positionText(flip.maxPosition), flip.median,
                                              flip.percentile95, flip.percentile99));
        rows.emplace_back("ssim", fmt::format("{:.6g}", *scores.ssim));
    }
    rows.emplace_back("differ", fmt::format("{} of {} samples", countText(metrics.different),
                                            countText(metrics.samples)));
    report.table({}, rows);
}

Result<void> checkLimits(Report& report, const std::vector<Limit>& limits, const Scores& scores) {
    for (const Limit& limit : limits) {
        const std::optional<double> score = scores.byName(limit.metric);
        if (!score)
            return usage(limit.metric + " needs pictures; these images have more than four "
                                        "channels");
        if (limit.above ? *score > limit.value : *score < limit.value)
            report.failCheck(fmt::format("{} is {:.6g}, {} {}", limit.metric, *score,
                                         limit.above ? "above" : "below", limit.text));
    }
    return {};
}

} // namespace

Result<void> run(Session& session, const CompareOptions& options) {
    const Result<std::vector<Limit>> limits = parseLimits(options);
    if (!limits)
        return limits.error();
    ImageFileFormat format = ImageFileFormat::Png;
    if (!options.output.empty()) {
        const Result<ImageFileFormat> named = imageFormatForPath(options.output);
        if (!named)
            return named.error();
        format = *named;
        if (format == ImageFileFormat::Hdr && options.difference != DifferenceShown::Channels)
            return usage(fmt::format("{}: .hdr has neither signs nor colours of 8 bits; write "
                                     "numbers into an .exr, colours into a .png",
                                     options.output));
        if (Result<void> output = checkOutput(options.output); !output)
            return output;
    }
    Result<LoadedImage> image = load(session, options.image);
    if (!image)
        return image.error();
    Result<LoadedImage> reference = load(session, options.reference);
    if (!reference)
        return reference.error();
    if (Result<void> numbers = checkNumbers(options.image, image->image()); !numbers)
        return numbers;
    if (Result<void> numbers = checkNumbers(options.reference, reference->image()); !numbers)
        return numbers;
    toRec709Primaries(session, options.image, image->parts.front());
    toRec709Primaries(session, options.reference, reference->parts.front());
    Image& fitted = reference->parts.front().image;
    if (Result<void> same = fit(session, options, image->image(), fitted); !same)
        return same;

    session.beginPhase();
    const Result<Scores> scores = computeScores(session, image->image(), fitted);
    if (!scores)
        return scores.error();
    if (!options.output.empty())
        if (Result<void> written =
                writeDifference(session, options, image->image(), fitted, *scores, format);
            !written)
            return written;
    report(session.report(), options, *scores);
    return checkLimits(session.report(), *limits, *scores);
}

} // namespace patina::cli
