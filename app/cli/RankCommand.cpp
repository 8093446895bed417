// `patina rank`: the light in which a material fails, found among environments × rotations.
#include "app/cli/Commands.h"
#include "app/cli/Numbers.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/RankEnvironments.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/base/AtomicFile.h"
#include "core/base/LowerCase.h"
#include "core/compare/DifferencePicture.h"
#include "core/document/ViewChoices.h"
#include "core/image/ColorMap.h"
#include "core/rank/LightSweep.h"
#include "core/rank/RankingJson.h"
#include "core/rank/SweepBake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace patina::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLargestSide = 1024; // a side of the pictures
constexpr std::size_t kShown = 10; // lights that people are shown

// Which transfer the scene is lit with, and where it comes from.
struct RankTransfer {
    BakeArtifactPtr bake; // null: nothing is hidden
    const char* source = "unshadowed";
    std::string text;
};

Result<RankTransfer> chooseTransfer(Session& session, const RankOptions& options,
                                    Document& document) {
    if (options.unshadowed)
        return RankTransfer{
            nullptr, "unshadowed",
            fmt::format("none: nothing is hidden, {} bands in closed form", kUnshadowedOrder)};
    if (attachedSweepBake(document)) {
        warnOfStaleBakes(session, document);
        document.view.lighting = LightingMode::Prt;
        if (Result<void> followed = followBounces(session, {}, document); !followed)
            return followed.error();
    } else if (!options.bakes.empty()) {
        return usageError("the bake holds no radiance transfer; compute one with \"patina bake "
                          "prt\"");
    } else {
        session.beginPhase();
    }
    const Result<SweepBake> chosen = chooseSweepBake(document, session.job());
    if (!chosen)
        return chosen.error();
    if (chosen->quick)
        return RankTransfer{chosen->bake, "quick",
                            fmt::format("a quick bake, {} bands, {} rays per vertex; --bake FILE "
                                        "takes a better one",
                                        kQuickSweepBands, kQuickSweepRays)};
    return RankTransfer{
        chosen->bake, options.bakes.empty() ? "project" : "file",
        fmt::format("{}, {} bands, {}",
                    options.bakes.empty() ? "the project's bake" : options.bakes.back(),
                    chosen->bake->order,
                    restsOnRays(*chosen->bake) ? fmt::format("{} rays", chosen->bake->samplesDone)
                                               : "without rays")};
}

// ENV[@DEG]
Result<std::optional<SweepLight>> parseReference(const std::string& text,
                                                 const RankEnvironments& environments) {
    if (text.empty())
        return std::optional<SweepLight>();
    SweepLight light;
    std::string name = text;
    if (const std::size_t at = text.rfind('@'); at != std::string::npos) {
        std::vector<double> degrees;
        if (parseNumbers(std::string_view(text).substr(at + 1), ',', degrees) &&
            degrees.size() == 1 && std::isfinite(degrees[0])) {
            light.rotationDeg = degrees[0];
            name = text.substr(0, at);
        }
    }
    const auto isNamed = [&](const RankedEnvironment& environment) {
        const std::filesystem::path file = environment.file;
        std::error_code unknown;
        return environment.file == name ||
               lowerCase(environment.measured.name) == lowerCase(name) || file.filename() == name ||
               std::filesystem::equivalent(file, name, unknown);
    };
    const auto found = std::ranges::find_if(environments.good, isNamed);
    if (found == environments.good.end())
        return usageError(fmt::format("--reference {}: no environment that is ranked has this "
                                      "name; name one of --environments, as ENV or ENV@DEG",
                                      text));
    light.environment = static_cast<std::size_t>(found - environments.good.begin());
    return std::optional(light);
}

std::string flagText(const std::string& flag) {
    return flag == "blackFromOneSide" ? "black from one side" : flag;
}

void reportForPeople(Report& report, const Ranking& ranking, const Json& json) {
    std::vector<std::pair<std::string, std::string>> rows;
    const std::vector<std::size_t> order = rankLights(*ranking.sweep, ranking.by);
    for (std::size_t k = 0; k < std::min(kShown, order.size()); ++k) {
        const LightScore& score = ranking.sweep->scores[order[k]];
        const Json& light = json["ranking"][k];
        std::string text = fmt::format(
            "white {:.2f} %, black {:.2f} %, contrast {:.2f} stops ({:.0f} % lost), difference "
            "{:.3f} (mean {:.3f})",
            100.0 * score.clipped.highlights, 100.0 * score.clipped.shadows, score.contrastStops,
            100.0 * score.lostContrast, score.difference.worst, score.difference.mean);
        for (const Json& flag : light["flags"])
            text += ", " + flagText(flag.get<std::string>());
        rows.emplace_back(fmt::format("{} {:.4g}°", light["environment"].get<std::string>(),
                                      score.light.rotationDeg),
                          std::move(text));
    }
    report.table(
        fmt::format("Worst of {} lights by {}", countText(order.size()), nameOf(ranking.by)), rows);
    std::vector<std::pair<std::string, std::string>> notes;
    for (std::size_t i = 0; i < ranking.environments.size(); ++i) {
        const SweepEnvironment& measured = ranking.environments[i];
        std::vector<std::string> texts;
        if (measured.black)
            texts.emplace_back("black all over");
        if (measured.blackFromOneSide())
            texts.push_back(fmt::format("black from one side ({:.2f} % of the light of the "
                                        "brightest side)",
                                        100.0 * measured.darkestShare));
        if (const std::optional<SameEnvironment>& same = ranking.same[i])
            texts.push_back(fmt::format(
                "{} {}{}", same->exactly ? "exactly the same as" : "the same light as",
                ranking.environments[same->of].name,
                same->rotationDeg != 0.0f ? fmt::format(", rotated by {:.1f}°", same->rotationDeg)
                                          : std::string()));
        if (!texts.empty())
            notes.emplace_back(measured.name, fmt::format("{}", fmt::join(texts, "; ")));
    }
    if (!notes.empty())
        report.table("Environments", notes);
}

Result<void> writeSensitivity(Session& session, const std::string& output, ImageFileFormat format,
                              Image map) {
    float most = 0.0f;
    for (const float value : map.f32())
        most = std::max(most, value);
    Json& json = session.report().json()["sensitivity"];
    json = {{"file", output}, {"unit", "stops"}, {"largest", most}};
    std::vector<ImagePart> parts;
    if (format == ImageFileFormat::Exr)
        map.setChannelNames({"Y"});
    else
        map = colorErrors(map, ColorMap::Sequential, 0.0f, most > 0.0f ? most : 1.0f);
    parts.push_back({{}, std::move(map), {}});
    return writePictures(session, output, std::move(parts), format);
}

Result<RankBy> checkOptions(const RankOptions& options) {
    if (lowerCase(std::filesystem::path(options.output).extension().string()) != ".json")
        return usageError("the ranking is written as JSON; name a file that ends in .json");
    if (options.unshadowed && !options.bakes.empty())
        return usageError("--unshadowed and --bake exclude each other");
    for (const std::string& file : {options.output, options.sensitivity})
        if (!file.empty())
            if (Result<void> output = checkOutput(file); !output)
                return output.error();
    return options.by == "clipping"   ? RankBy::Clipping
           : options.by == "contrast" ? RankBy::Contrast
                                      : RankBy::Difference;
}

} // namespace

Result<void> run(Session& session, const RankOptions& options) {
    const Result<RankBy> by = checkOptions(options);
    if (!by)
        return by.error();
    Result<render::FrameSettings> frame = frameSettings(options);
    if (!frame)
        return frame.error();
    if (std::max(frame->width, frame->height) > kLargestSide)
        return usageError(fmt::format("--size: at most {} pixels a side; a ranking does not see "
                                      "more in large pictures",
                                      kLargestSide));
    ImageFileFormat format = ImageFileFormat::Png;
    if (!options.sensitivity.empty()) {
        const Result<ImageFileFormat> named = imageFormatForPath(options.sensitivity);
        if (!named)
            return named.error();
        format = *named;
        if (format == ImageFileFormat::Hdr)
            return usageError("--sensitivity writes numbers into an .exr, colours into .png, .jpg, "
                              ".tif, .tga");
    }
    if (!needsImageLibraries(options) &&
        std::ranges::all_of(options.environments,
                            [](const std::string& name) { return name.starts_with("builtin:"); }) &&
        (options.sensitivity.empty() || format == ImageFileFormat::Png))
        session.expectNoImages();

    // The scene and how it is looked at.
    Report& report = session.report();
    report.json()["settings"] = {{"scene", options.scene},
                                 {"size", {frame->width, frame->height}},
                                 {"rotations", options.rotations},
                                 {"by", nameOf(*by)}};
    session.beginPhase();
    SceneRequest request{options.scene, {}, {}, options.bakes};
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    document->view.lighting = LightingMode::Ibl; // which bake there is decides, not the project
    if (Result<void> view = applyView(session, options, *document, *frame); !view)
        return view;
    if (document->view.toneMap == ToneMap::OpenColorIo)
        return usageError("lights are ranked with Patina's own tone curves; choose one with "
                          "--tone-map");
    const Result<Camera> camera =
        chooseCamera(session, options, *document, request,
                     static_cast<float>(frame->width) / static_cast<float>(frame->height));
    if (!camera)
        return camera.error();

    Result<RankEnvironments> environments = readRankEnvironments(session, options);
    if (!environments)
        return environments.error();
    SweepSettings settings;
    settings.rotations = options.rotations;
    settings.view = document->view;
    settings.scale = document->environment().tint * std::exp2(document->environment().exposureEv);
    Result<std::optional<SweepLight>> reference = parseReference(options.reference, *environments);
    if (!reference)
        return reference.error();
    settings.reference = *reference;

    const Result<RankTransfer> transfer = chooseTransfer(session, options, *document);
    if (!transfer)
        return transfer.error();
    session.beginPhase();
    const Result<SweepPixels> pixels = traceSweepPixels(*document, transfer->bake.get(), *camera,
                                                        frame->width, frame->height, session.job());
    if (!pixels)
        return pixels.error();

    if (pixels->count() < pixels->covered)
        report.warn(fmt::format("{:.0f} % of the pixels of surfaces are metal or black, which "
                                "radiance transfer does not light; they are left out",
                                100.0 * (1.0 - static_cast<double>(pixels->count()) /
                                                   static_cast<double>(pixels->covered))));

    // The ranking.
    std::vector<SweepEnvironment> measured;
    for (const RankedEnvironment& environment : environments->good)
        measured.push_back(environment.measured);
    session.beginPhase();
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::optional<SameEnvironment>> same =
        findSameEnvironments(measured, session.job());
    Result<LightSweep> sweep = sweepLights(*pixels, measured, settings, session.job());
    if (!sweep)
        return sweep.error();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Ranking ranking;
    ranking.scene = options.scene;
    ranking.by = *by;
    ranking.camera = *camera;
    ranking.settings = &settings;
    ranking.pixels = &*pixels;
    ranking.sweep = &*sweep;
    ranking.environments = measured;
    for (const RankedEnvironment& environment : environments->good)
        ranking.files.push_back(environment.file);
    ranking.same = same;
    for (const BrokenEnvironment& broken : environments->broken)
        ranking.unread.push_back({broken.file, broken.problem});
    ranking.transfer = transfer->source;
    ranking.rays = transfer->bake && restsOnRays(*transfer->bake) ? transfer->bake->samplesDone : 0;

    // In full in the file, its beginning in the report.
    Json found = rankingJson(ranking);
    Json& json = report.json();
    json["settings"].update(found["settings"]);
    found.erase("settings");
    json.update(found);
    json["rankingSeconds"] = seconds;
    const Json file = json;
    Json worst = std::move(json["ranking"]);
    json.erase("ranking");
    const std::size_t lights = worst.size();
    worst.erase(worst.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, lights)), worst.end());
    json["worst"] = std::move(worst);

    report.table({}, {{"transfer", transfer->text},
                      {"speed", fmt::format("{} lights in {:.2f} s", countText(lights), seconds)}});
    reportForPeople(report, ranking, file);
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    if (!options.sensitivity.empty())
        if (Result<void> written = writeSensitivity(session, options.sensitivity, format,
                                                    std::move(sweep->sensitivity));
            !written)
            return written;
    const std::string text = rankingText(file);
    if (Result<void> written = writeFileAtomically(options.output, std::string_view(text));
        !written)
        return written;
    report.output(options.output, fmt::format("ranking of {} lights", countText(lights)));
    return {};
}

} // namespace patina::cli
