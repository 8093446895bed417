// `patina ladder`: every way of lighting in real time against the traced picture of the same scene.
#include "app/cli/Commands.h"
#include "app/cli/LocalShadows.h"
#include "app/cli/PictureSetup.h"
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
#include "core/mix/LightMix.h"
#include "core/sheet/SheetCanvas.h"
#include "core/sheet/WallSheet.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/error/PictureErrorMap.h"
#include "core/trace/error/SeenMaterials.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/WallRenderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace patina::cli {
namespace {

constexpr std::uint32_t kMostInPass = 16;
constexpr std::array kShownErrors{ErrorShown::Exposure, ErrorShown::Visible};

double secondsFrom(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What all rungs are held against.
struct Truth {
    TracedPicture picture;
    std::vector<Id> materials; // seen at its pixels
    std::uint32_t samples = 0;
    double noise = 0.0, seconds = 0.0;
};

Result<Truth> traceTruth(Session& session, const LadderOptions& options, const Document& document,
                         const render::FrameSettings& frame) {
    session.beginPhase();
    session.job().setActivity("preparing the scene");
    TraceView view;
    view.camera = frame.camera;
    view.width = frame.width;
    view.height = frame.height;
    if (Result<void> set = setBackground(session, document, view); !set)
        return set.error();
    const Result<TraceScene> scene = TraceScene::build(traceInputs(document), session.job());
    if (!scene)
        return scene.error();
    if (const std::optional<std::string> limit = scene->limit())
        session.report().warn(*limit);
    const auto start = std::chrono::steady_clock::now();
    Film film(frame.width, frame.height);
    Truth truth;
    const auto most = static_cast<std::uint32_t>(options.paths);
    for (std::uint32_t pass = 2; truth.samples < most; pass = std::min(2 * pass, kMostInPass)) {
        pass = std::min(pass, most - truth.samples);
        session.job().setActivity(fmt::format("tracing: {} paths per pixel", truth.samples));
        if (Result<void> traced =
                tracePaths(*scene, view, {}, film, truth.samples, pass, session.job());
            !traced)
            return traced.error();
        truth.samples += pass;
        truth.noise = film.noise().value_or(0.0);
        session.job().setProgress(static_cast<double>(truth.samples) / most);
        if (options.noise && truth.samples > 2 && 100.0 * truth.noise <= *options.noise)
            break;
    }
    if (session.job().stopping())
        return cancelledError();
    truth.seconds = secondsFrom(start);
    truth.picture = *tracedPicture(film);
    truth.materials = seenMaterials(*scene, view, session.job());
    if (truth.materials.empty())
        return cancelledError();
    return truth;
}

struct DrawnRung {
    Image picture; // F32, linear
    double milliseconds = 0.0;
    PictureError error;
};

// Draws documents that differ in their lighting.
class RungDrawer {
  public:
    RungDrawer(Session& session, const LadderOptions& options, render::FrameSettings frame)
        : m_session(session)
        , m_options(options)
        , m_frame(std::move(frame)) {}

    Result<void> begin(const Document& document) {
        Result<std::unique_ptr<gl::Context>> context = createContext(m_session, m_frame);
        if (!context)
            return context.error();
        m_context = std::move(*context);
        m_session.beginPhase();
        m_session.job().setActivity("preparing light");
        if (const ImagePtr image = shownEnvironment(document).image;
            image && !environmentParts(document).empty()) {
            Result<EnvironmentTexelsPtr> light = prepareTexels(image, m_session.job());
            if (!light)
                return light.error();
            m_light = *std::move(light);
        }
        Result<std::unique_ptr<render::SceneRenderer>> scene =
            render::SceneRenderer::create(*m_context);
        if (!scene)
            return scene.error();
        m_scene = std::move(*scene);
        m_cells = std::make_unique<render::WallRenderer>(*m_scene);
        return {};
    }

    // Twice: what its programs take to be compiled is no part of its time.
    Result<DrawnRung> draw(Document document) {
        render::CellView cell;
        cell.frame = m_frame;
        cell.light = m_light;
        if (isLitByBake(m_frame.view, document))
            if (Result<void> followed = followBounces(m_session, m_frame.view, document); !followed)
                return followed.error();
        const Result<NearShadowsPtr> shadows = traceLocalShadows(
            m_session, m_options, document, isLitByBake(m_frame.view, document), m_shadows);
        if (!shadows)
            return shadows.error();
        cell.nearShadows = m_shadows = *shadows;
        cell.document = std::move(document);
        DrawnRung rung;
        for (int time = 0; time < 2; ++time) {
            render::ViewRenderer picture(*m_scene);
            const auto start = std::chrono::steady_clock::now();
            int frames = 0;
            do {
                if (m_session.job().stopping())
                    return cancelledError();
                if (Result<void> drawn = m_cells->drawFrame(cell, picture, frames > 0); !drawn)
                    return drawn.error();
                ++frames;
            } while (!render::WallRenderer::isFine(cell, picture));
            rung.picture = picture.readLinear();
            rung.milliseconds = 1000.0 * secondsFrom(start) / frames;
        }
        return rung;
    }

  private:
    Session& m_session;
    const LadderOptions& m_options;
    const render::FrameSettings m_frame;
    std::unique_ptr<gl::Context> m_context; // outlives what it holds
    std::unique_ptr<render::SceneRenderer> m_scene;
    std::unique_ptr<render::WallRenderer> m_cells;
    EnvironmentTexelsPtr m_light;
    NearShadowsPtr m_shadows;
};

std::string evText(double ev) {
    return std::abs(ev) < 0.005 ? "0.00 EV" : fmt::format("{:+.2f} EV", ev);
}

std::string scoreText(const ErrorScore& score) {
    return fmt::format("FLIP {:.3f} · {}", score.flip, evText(score.biasEv));
}

// Rungs beside each other: as they are drawn, and how far they are from the truth, which stands
// last.
Result<Image> ladderSheet(const std::vector<LadderRung>& rungs,
                          const std::vector<std::optional<DrawnRung>>& drawn, const Truth& truth,
                          const View& view, const std::string& title) {
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
    const Result<Wall> wall = makeWall({columns, rows});
    if (!wall)
        return wall.error();
    const int width = truth.picture.radiance.width(), height = truth.picture.radiance.height();
    const Result<sheet::WallSheet> paper = sheet::WallSheet::create(
        *wall, width, height,
        sheet::WallSheetText{title, fmt::format("against {} paths per pixel", truth.samples)});
    if (!paper)
        return paper.error();
    Image picture = paper->draw(*wall);
    const Luminance luminance = luminanceOf(truth.picture.radiance);
    for (const WallCell& cell : cellsOf(*wall)) {
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
            one["bakeSeconds"] = rungs[i].bakeSeconds;
            one["error"] = errorJson(drawn[i]->error, rungs[i].document);
        } else {
            one["problem"] = rungs[i].whyNot;
        }
        list.push_back(std::move(one));
    }
    return list;
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
    const float aspect = static_cast<float>(frame->width) / static_cast<float>(frame->height);
    const Result<Camera> camera = chooseCamera(options, *document, request.isProject, aspect);
    if (!camera)
        return camera.error();
    document->view.camera = frame->camera = *camera;
    describeView(json["settings"], document->view);
    json["settings"].erase("lighting");

    const Result<Truth> truth = traceTruth(session, options, *document, *frame);
    if (!truth)
        return truth.error();
    session.beginPhase();
    LadderSettings settings;
    settings.order = options.order;
    settings.rays = options.rays;
    const Result<LadderBakes> bakes = ladderBakes(*document, settings, session.job());
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
        const ErrorScore& score = rung->error.whole;
        table.emplace_back(
            rungs[i].label,
            fmt::format("FLIP {:.3f} (noise {:.3f})  {:>8}  relative {:5.1f} %  {:5.0f} ms{}",
                        score.flip, score.flipNoise, evText(score.biasEv), 100.0 * score.relative,
                        rung->milliseconds,
                        rungs[i].bakeSeconds > 0.0
                            ? fmt::format("  baked in {:.1f} s", rungs[i].bakeSeconds)
                            : std::string()));
        drawn[i] = *std::move(rung);
    }
    session.report().table(fmt::format("Against {} paths per pixel, ± {:.2f} %, {:.1f} s:",
                                       truth->samples, 100.0 * truth->noise, truth->seconds),
                           table);
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
