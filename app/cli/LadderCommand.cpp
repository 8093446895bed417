// `patina ladder`: every way of lighting in real time against the traced picture of the same scene.
#include "app/cli/Commands.h"
#include "app/cli/LadderBlame.h"
#include "app/cli/LadderDrawer.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "app/cli/SheetAxes.h"
#include "app/cli/TracedBackground.h"
#include "core/base/AtomicFile.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/edit/ViewJson.h"
#include "core/image/Channels.h"
#include "core/ladder/Ladder.h"
#include "core/ladder/LadderJson.h"
#include "core/ladder/LadderTruth.h"
#include "core/sheet/SheetCanvas.h"
#include "core/sheet/WallSheet.h"
#include "core/trace/error/PictureErrorMap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace patina::cli {
namespace {

constexpr std::array kShownErrors{ErrorShown::Exposure, ErrorShown::Visible};

// What all rungs are held against.
Result<LadderTruth> traceTruth(Session& session, const LadderOptions& options,
                               const Document& document, const render::FrameSettings& frame) {
    session.beginPhase();
    session.job().setActivity("preparing the scene");
    const Result<TraceView> view = traceView(session, document, frame);
    if (!view)
        return view.error();
    LadderTruthSettings settings;
    settings.samples = static_cast<std::uint32_t>(options.paths);
    settings.blame = wantsBlame(options);
    if (options.noise)
        settings.noise = *options.noise / 100.0;
    Result<LadderTruth> truth = traceLadderTruth(document, *view, settings, session.job());
    if (truth && truth->limit)
        session.report().warn(*truth->limit);
    return truth;
}

std::string evText(double ev) {
    return std::abs(ev) < 0.005 ? "0.00 EV" : fmt::format("{:+.2f} EV", ev);
}

std::string scoreText(const ErrorScore& score) {
    return fmt::format("FLIP {:.3f} · {}", score.flip, evText(score.biasEv));
}

// Rungs beside each other: as they are drawn, and how far they are from the truth, which stands
// last.
Result<Image> ladderSheet(const std::vector<LadderRung>& rungs,
                          const std::vector<std::optional<DrawnRung>>& drawn,
                          const LadderTruth& truth, const View& view, const std::string& title) {
    WallAxis columns{"Lighting", {}}, rows{"Shown", {}};
    for (std::size_t i = 0; i < rungs.size(); ++i)
        columns.entries.push_back(
            {drawn[i] ? fmt::format("{} · {} · {:.0f} ms", rungs[i].label,
                                    scoreText(drawn[i]->error.whole), drawn[i]->milliseconds)
                      : rungs[i].label,
             {}});
    columns.entries.push_back({fmt::format("Path traced · ± {:.1f} %", 100.0 * truth.noise), {}});
    for (const char* row : {"Picture", "Too bright, too dark (±1 EV)", "Visible difference"})
        rows.entries.push_back({row, {}});
    // Not by makeWall(): these are pictures on paper, of which a row may have more than a wall.
    Wall wall;
    wall.columns = columns;
    wall.rows = rows;
    wall.width = columns.entries.size();
    wall.height = rows.entries.size();
    const int width = truth.picture.radiance.width(), height = truth.picture.radiance.height();
    const Result<sheet::WallSheet> paper = sheet::WallSheet::create(
        wall, width, height,
        sheet::WallSheetText{title, fmt::format("against {} paths per pixel", truth.samples)});
    if (!paper)
        return paper.error();
    Image picture = paper->draw(wall);
    const Luminance luminance = luminanceOf(truth.picture.radiance);
    for (const WallCell& cell : cellsOf(wall)) {
        const glm::ivec2 place = paper->place(cell);
        const bool isTruth = cell.column == rungs.size();
        if (!isTruth && !drawn[cell.column]) {
            paper->drawProblem(picture, cell, rungs[cell.column].whyNot);
        } else if (cell.row > 0 && isTruth) {
            paper->drawProblem(picture, cell, "what the others are compared with");
        } else if (cell.row > 0) {
            sheet::paste(picture, place.x, place.y,
                         errorPicture(drawn[cell.column]->error, kShownErrors[cell.row - 1]));
        } else {
            Result<Image> shown = displayedPicture(
                isTruth ? truth.picture.radiance : withoutAlpha(drawn[cell.column]->picture), view,
                luminance);
            if (!shown)
                return shown.error();
            sheet::paste(picture, place.x, place.y, *shown);
        }
    }
    return picture;
}

nlohmann::ordered_json describeRungs(const std::vector<LadderRung>& rungs,
                                     const std::vector<std::optional<DrawnRung>>& drawn) {
    auto list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        nlohmann::ordered_json one = {{"name", rungs[i].name}, {"label", rungs[i].label}};
        if (drawn[i]) {
            one["milliseconds"] = drawn[i]->milliseconds;
            one["bakeSeconds"] = rungs[i].bakeSeconds + drawn[i]->solvedSeconds;
            one["error"] = errorJson(drawn[i]->error, rungs[i].document);
            if (drawn[i]->blame)
                one["blame"] = blameJson(*drawn[i]->blame, rungs[i].document);
        } else {
            one["problem"] = rungs[i].whyNot;
        }
        list.push_back(std::move(one));
    }
    return list;
}

// Which shortcut makes which share of the errors of the rungs that are lit by images.
Result<void> blameRungs(Session& session, const LadderOptions& options,
                        const std::vector<LadderRung>& rungs, const LadderTruth& truth,
                        RungDrawer& drawer, std::vector<std::optional<DrawnRung>>& drawn) {
    session.beginPhase();
    session.job().setActivity("drawing the terms of image-based light");
    const auto isImageBased = [&](std::size_t i) {
        return drawn[i] && rungs[i].document.view.lighting == LightingMode::Ibl;
    };
    const DrawnRung* last = nullptr;
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        if (!isImageBased(i))
            continue;
        const Result<DrawnTerms> terms = drawer.terms(rungs[i].document, drawn[i]->picture);
        if (!terms)
            return terms.error();
        Result<Blame> made = blame(*terms, *truth.blame, truth.film, rungs[i].document.view,
                                   truth.materials, session.job());
        if (!made)
            return made.error();
        drawn[i]->blame = *std::move(made);
        session.report().table(fmt::format("Blame, {}:", rungs[i].label),
                               blameTable(*drawn[i]->blame));
        last = &*drawn[i];
    }
    if (options.blamePictures.empty() || last == nullptr)
        return {};
    return writePictures(session, options.blamePictures,
                         blameParts(*last->blame, last->picture, truth.picture.radiance),
                         ImageFileFormat::Exr);
}

bool writesNumbers(const LadderOptions& options) {
    return std::filesystem::path(options.output).extension() == ".json";
}

Result<void> checkLadder(const LadderOptions& options) {
    if (!options.lighting.empty())
        return usageError("--lighting is not for patina ladder, which compares all of them");
    if (!writesNumbers(options)) {
        const Result<ImageFileFormat> format = imageFormatForPath(options.output);
        if (!format)
            return format.error();
        if (isLinearFormat(*format))
            return usageError("patina ladder writes numbers (.json) or a displayed picture (.png, "
                              ".jpg, .tif, .tga); --renderer path --error-against compares linear "
                              "pictures");
    }
    return checkOutput(options.output);
}

} // namespace

Result<void> run(Session& session, const LadderOptions& options) {
    if (Result<void> fits = checkLadder(options); !fits)
        return fits;
    Result<render::FrameSettings> frame = frameSettings(options);
    if (!frame)
        return frame.error();
    frame->samples = 1; // the mean of several frames, as the editor shows a picture at rest
    frame->accumulate = frame->floats = true;
    nlohmann::ordered_json& json = session.report().json();
    json["settings"] = {{"scene", options.scene},
                        {"size", {frame->width, frame->height}},
                        {"order", options.order},
                        {"rays", options.rays}};
    session.beginPhase();
    SceneRequest request{options.scene, options.environment, options.environmentLayout,
                         options.bakes};
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    if (Result<void> view = applyView(session, options, *document, *frame); !view)
        return view;
    if (document->view.toneMap == ToneMap::OpenColorIo)
        return usageError("patina ladder compares displayed pictures, and the tone curve of this "
                          "scene is OpenColorIO's: choose another with --tone-map");
    if (wantsBlame(options))
        if (Result<void> blames = checkBlame(options, document->view); !blames)
            return blames;
    const float aspect = static_cast<float>(frame->width) / static_cast<float>(frame->height);
    const Result<Camera> camera = chooseCamera(session, options, *document, request, aspect);
    if (!camera)
        return camera.error();
    document->view.camera = frame->camera = *camera;
    describeView(json["settings"], document->view);
    json["settings"].erase("lighting");

    const Result<LadderTruth> truth = traceTruth(session, options, *document, *frame);
    if (!truth)
        return truth.error();
    session.beginPhase();
    LadderSettings settings;
    settings.order = options.order;
    settings.rays = options.rays;
    const Result<LadderBakes> bakes = ladderBakes(
        *document, settings, [&](const Image& image) { return prepareLight(image, session.job()); },
        session.job());
    if (!bakes)
        return bakes.error();
    const std::vector<LadderRung> rungs = ladderRungs(*document, *bakes);
    RungDrawer drawer(session, options, *frame);
    if (Result<void> begun = drawer.begin(*document); !begun)
        return begun;
    std::vector<std::optional<DrawnRung>> drawn(rungs.size());
    std::vector<std::pair<std::string, std::string>> table;
    session.beginPhase();
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        session.job().setActivity(rungs[i].label);
        session.job().setProgress(static_cast<double>(i) / static_cast<double>(rungs.size()));
        if (!rungs[i].whyNot.empty()) {
            table.emplace_back(rungs[i].label, rungs[i].whyNot);
            continue;
        }
        Result<DrawnRung> rung = drawer.draw(rungs[i].document);
        if (!rung)
            return rung.error();
        Result<PictureError> error = pictureError(rung->picture, truth->picture, document->view,
                                                  truth->materials, session.job());
        if (!error)
            return error.error();
        rung->error = *std::move(error);
        drawn[i] = *std::move(rung);
        const ErrorScore& score = drawn[i]->error.whole;
        table.emplace_back(
            rungs[i].label,
            fmt::format("FLIP {:.3f} (noise {:.3f})  {:>8}  relative {:5.1f} %  {:5.0f} ms{}",
                        score.flip, score.flipNoise, evText(score.biasEv), 100.0 * score.relative,
                        drawn[i]->milliseconds,
                        rungs[i].bakeSeconds > 0.0
                            ? fmt::format("  baked in {:.1f} s", rungs[i].bakeSeconds)
                        : drawn[i]->solvedSeconds > 0.0
                            ? fmt::format("  solved in {:.1f} s", drawn[i]->solvedSeconds)
                            : std::string()));
    }
    session.report().table(fmt::format("Against {} paths per pixel, ± {:.2f} %, {:.1f} s:",
                                       truth->samples, 100.0 * truth->noise, truth->seconds),
                           table);
    if (wantsBlame(options))
        if (Result<void> blamed = blameRungs(session, options, rungs, *truth, drawer, drawn);
            !blamed)
            return blamed;
    json["reference"] = {{"samples", truth->samples},
                         {"noisePercent", 100.0 * truth->noise},
                         {"seconds", truth->seconds}};
    json["rungs"] = describeRungs(rungs, drawn);
    if (writesNumbers(options)) {
        nlohmann::ordered_json file = {{"settings", json["settings"]},
                                       {"reference", json["reference"]},
                                       {"rungs", json["rungs"]}};
        if (Result<void> written = writeFileAtomically(options.output, file.dump(2) + "\n");
            !written)
            return written;
        session.report().output(options.output, "errors and costs");
        return {};
    }
    Result<Image> sheet =
        ladderSheet(rungs, drawn, *truth, document->view, sceneTitle(options.scene));
    if (!sheet)
        return sheet.error();
    std::vector<ImagePart> parts(1);
    parts[0].image = *std::move(sheet);
    return writePictures(session, options.output, std::move(parts),
                         *imageFormatForPath(options.output));
}

} // namespace patina::cli
