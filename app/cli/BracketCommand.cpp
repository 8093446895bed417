// `patina bracket`: photos of one scene at different exposures, as one picture of radiance.
#include "app/cli/Commands.h"
#include "app/cli/Numbers.h"
#include "app/cli/SceneSetup.h"
#include "core/bracket/Bracket.h"
#include "core/bracket/BracketPreview.h"
#include "core/io/ImageIO.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

// The marks are shown over all of the picture, however large it is.
constexpr int kAnySide = 0;

Result<BracketOptions> bracketOptions(const BracketCommandOptions& options) {
    BracketOptions result;
    result.align = !options.noAlign;
    if (options.exposures.empty())
        return result;
    if (!parseNumbers(options.exposures, ',', result.exposuresEv))
        return usageError(fmt::format("--exposures {}: expected a number of stops for each photo, "
                                      "such as -2,0,2",
                                      options.exposures));
    if (result.exposuresEv.size() != options.photos.size())
        return usageError(fmt::format("--exposures {}: {} exposures were given for {} photos",
                                      options.exposures, result.exposuresEv.size(),
                                      options.photos.size()));
    return result;
}

Result<void> checkOutputs(const BracketCommandOptions& options) {
    const Result<ImageFileFormat> format = imageFormatForPath(options.output);
    if (!format || (*format != ImageFileFormat::Exr && *format != ImageFileFormat::Hdr))
        return usageError(
            fmt::format("{}: radiance is written as .exr or .hdr; choose one of these "
                        "endings",
                        options.output));
    if (Result<void> output = checkOutput(options.output); !output)
        return output;
    if (options.marks.empty())
        return {};
    const Result<ImageFileFormat> marks = imageFormatForPath(options.marks);
    if (!marks)
        return marks.error();
    if (*marks == ImageFileFormat::Exr || *marks == ImageFileFormat::Hdr)
        return usageError(
            fmt::format("--marks {}: colours of 8 bits are written as .png", options.marks));
    return checkOutput(options.marks);
}

std::string percent(double share) {
    return fmt::format("{:.2f} %", 100.0 * share);
}

nlohmann::ordered_json photoJson(const BracketPhoto& photo) {
    const auto known = [](double value) {
        return value > 0.0 ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
    };
    return {{"file", photo.file.string()},
            {"ev", photo.ev},
            {"seconds", known(photo.exposure.seconds)},
            {"fNumber", known(photo.exposure.fNumber)},
            {"iso", known(photo.exposure.iso)},
            {"shift", {photo.shift.dx, photo.shift.dy}},
            {"white", photo.white},
            {"black", photo.black}};
}

void report(Report& report, const BracketReport& found) {
    nlohmann::ordered_json& json = report.json();
    auto photos = nlohmann::ordered_json::array();
    std::vector<std::pair<std::string, std::string>> rows;
    for (const BracketPhoto& photo : found.photos) {
        photos.push_back(photoJson(photo));
        const std::string exposure = exposureText(photo.exposure);
        rows.emplace_back(photo.file.filename().string(),
                          fmt::format("{:+.2f} EV{}{}; shifted by {}, {}; white {}, black {}",
                                      photo.ev, exposure.empty() ? "" : ", ", exposure,
                                      photo.shift.dx, photo.shift.dy, percent(photo.white),
                                      percent(photo.black)));
    }
    json["photos"] = std::move(photos);
    auto curves = nlohmann::ordered_json::array();
    for (const LogResponse& curve : found.curves)
        curves.push_back(curve);
    const bool linear = found.response == ResponseKind::Linear;
    json["response"] = {{"kind", responseText(found.response)},
                        {"srgbDifference", linear ? nlohmann::ordered_json()
                                                  : nlohmann::ordered_json(found.srgbDifference)},
                        {"noiseCodes", found.noiseCodes},
                        {"logExposures", std::move(curves)}};
    json["clippedAbove"] = found.clippedAbove;
    json["clippedBelow"] = found.clippedBelow;
    json["disagreeing"] = found.disagreeing;

    rows.emplace_back("response", std::string(responseText(found.response)));
    if (!linear)
        rows.back().second +=
            fmt::format("; {:.1f} % from sRGB at most", 100.0 * found.srgbDifference);
    rows.emplace_back("clipped",
                      fmt::format("{} white in all photos, {} black", percent(found.clippedAbove),
                                  percent(found.clippedBelow)));
    rows.emplace_back("disagree", percent(found.disagreeing) + " of the pixels");
    report.table({}, rows);
    for (const std::string& warning : found.warnings)
        report.warn(warning);
}

} // namespace

Result<void> run(Session& session, const BracketCommandOptions& options) {
    const Result<BracketOptions> wanted = bracketOptions(options);
    if (!wanted)
        return wanted.error();
    if (Result<void> outputs = checkOutputs(options); !outputs)
        return outputs;
    session.report().json()["settings"] = {{"photos", options.photos.size()},
                                           {"exposures", wanted->exposuresEv},
                                           {"align", wanted->align}};
    session.beginPhase();
    const std::vector<std::filesystem::path> files(options.photos.begin(), options.photos.end());
    const Result<Bracket> bracket = makeBracket(session.worker(), files, *wanted, session.job());
    if (!bracket)
        return bracket.error();
    const Image& image = bracket->merged.image;
    session.report().json()["width"] = image.width();
    session.report().json()["height"] = image.height();
    if (Result<void> saved = saveImage(session.worker(), image, options.output); !saved)
        return saved;
    session.report().output(options.output,
                            fmt::format("{} × {} pixels", image.width(), image.height()));
    if (!options.marks.empty()) {
        const Image marks = drawPreview(shrinkMerged(bracket->merged, kAnySide), 0.0f, true);
        if (Result<void> saved = saveImage(session.worker(), marks, options.marks); !saved)
            return saved;
        session.report().output(options.marks, "clipped and disagreeing pixels");
    }
    report(session.report(), bracket->report);
    return {};
}

} // namespace patina::cli
