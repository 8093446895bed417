#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/image/Compare.h"
#include "core/io/ImageIO.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

Result<LoadedImage> load(Session& session, const std::string& file) {
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    options.sanitize = false; // signed coefficients and broken pixels are compared as they are
    return loadImage(session.worker(), file, options);
}

} // namespace

Result<void> run(Session& session, const CompareOptions& options) {
    if (!options.difference.empty())
        if (Result<void> output = checkOutput(options.difference); !output)
            return output;
    Result<LoadedImage> image = load(session, options.image);
    if (!image)
        return image.error();
    Result<LoadedImage> reference = load(session, options.reference);
    if (!reference)
        return reference.error();
    Result<ImageMetrics> metrics = compareImages(image->image(), reference->image());
    if (!metrics)
        return metrics.error();

    if (!options.difference.empty()) {
        Result<Image> difference = differenceImage(image->image(), reference->image());
        if (!difference)
            return difference.error();
        if (Result<void> saved = saveImage(session.worker(), *difference, options.difference);
            !saved)
            return saved;
        session.report().output(options.difference, "absolute difference");
    }

    Report& report = session.report();
    nlohmann::ordered_json& json = report.json();
    json["settings"] = {{"image", options.image}, {"reference", options.reference}};
    json["identical"] = metrics->different == 0;
    json["rmse"] = metrics->rmse;
    json["relmse"] = metrics->relMse;
    json["psnr"] = metrics->psnr; // null for identical images: JSON has no infinity
    json["max"] = metrics->max;
    json["samples"] = metrics->samples;
    json["different"] = metrics->different;
    if (!std::isfinite(metrics->psnr))
        json["psnr"] = nullptr;
    report.table({},
                 {{"rmse", fmt::format("{:.6g}", metrics->rmse)},
                  {"relmse", fmt::format("{:.6g}", metrics->relMse)},
                  {"psnr", std::isfinite(metrics->psnr) ? fmt::format("{:.2f} dB", metrics->psnr)
                                                        : std::string("infinite (identical)")},
                  {"max", fmt::format("{:.6g}", metrics->max)},
                  {"differ", fmt::format("{} of {} samples", countText(metrics->different),
                                         countText(metrics->samples))}});
    return {};
}

} // namespace patina::cli
