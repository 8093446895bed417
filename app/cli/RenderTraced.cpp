#include "app/cli/RenderTraced.h"

#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/TracedBackground.h"
#include "core/document/DisplayedPicture.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/path/PathTracer.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::cli {
namespace {

// Samples of a pass, and so between two looks at the noise.
constexpr std::uint32_t kMostAtOnce = 16;
constexpr std::array kRasterSamples{1, 2, 4, 8, 16};

} // namespace

bool isTraced(const RenderOptions& options) {
    return options.renderer == "path";
}

Result<void> checkRenderer(const RenderOptions& options) {
    if (!isTraced(options)) {
        for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 3>{
                 {{options.noise.has_value(), "--noise"},
                  {options.maxBounces.has_value(), "--max-bounces"},
                  {options.seed != 0, "--seed"}}})
            if (given)
                return usageError(fmt::format("{} is for --renderer path", name));
        if (!std::ranges::count(kRasterSamples, options.samples))
            return usageError("--samples wants 1, 2, 4, 8 or 16; with --renderer path it may be "
                              "any number");
        return {};
    }
    for (const auto& [given, name] :
         std::array<std::pair<bool, const char*>, 6>{{{!options.view.empty(), "--view"},
                                                      {!options.inspect.empty(), "--inspect"},
                                                      {options.turntable > 0, "--turntable"},
                                                      {options.lightTurn > 0, "--light-turn"},
                                                      {!options.bakes.empty(), "--bake"},
                                                      {!options.lighting.empty(), "--lighting"}}})
        if (given)
            return usageError(fmt::format("{} is for --renderer raster: paths bring the light of "
                                          "the whole picture, and need no bake",
                                          name));
    return {};
}

Result<void> renderTraced(Session& session, const RenderOptions& options, const Document& document,
                          const render::FrameSettings& frame, ImageFileFormat format) {
    nlohmann::ordered_json& json = session.report().json();
    session.beginPhase();
    session.job().setActivity("preparing the scene");
    TraceView view;
    view.camera = frame.camera;
    view.width = frame.width;
    view.height = frame.height;
    if (Result<void> set = setBackground(session, document, view); !set)
        return set;
    const Result<TraceScene> scene = TraceScene::build(traceInputs(document), session.job());
    if (!scene)
        return scene.error();

    PathSettings settings;
    settings.maxBounces = options.maxBounces;
    settings.seed = options.seed;
    const auto most =
        static_cast<std::uint32_t>(options.samplesGiven || options.noise
                                       ? (options.samplesGiven ? options.samples : kMostPaths)
                                       : kUsualPaths);
    Film film(frame.width, frame.height);
    session.allowPartialResult();
    std::uint32_t done = 0;
    std::optional<double> noise;
    for (std::uint32_t pass = 1; done < most && !session.job().stopping();
         pass = std::min(2 * pass, kMostAtOnce)) {
        pass = std::min(pass, most - done);
        session.job().setActivity(
            noise ? fmt::format("{} paths per pixel, ± {:.2f} %", done, 100.0 * *noise)
                  : fmt::format("{} paths per pixel", done));
        if (Result<void> traced =
                tracePaths(*scene, view, settings, film, done, pass, session.job());
            !traced)
            return traced;
        done += pass;
        noise = film.noise();
        double share = static_cast<double>(done) / most;
        if (options.noise && noise) { // the error falls with the root of the paths
            const double wanted = *options.noise / 100.0;
            if (*noise <= wanted)
                break;
            share = std::max(share, wanted * wanted / (*noise * *noise));
        }
        session.job().setProgress(share);
    }
    done = film.leastSamples(); // of a pass that was stopped some pixels have more
    if (done == 0)
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    if (const std::size_t invalid = film.invalid(); invalid > 0)
        session.report().warn(fmt::format(
            "{} paths brought no finite number and count as black; look for values that are not "
            "finite in the scene's maps",
            invalid));
    json["settings"]["renderer"] = options.renderer;
    json["settings"]["samples"] = done;
    json["settings"]["seed"] = options.seed;
    if (options.maxBounces)
        json["settings"]["maxBounces"] = *options.maxBounces;
    if (noise) {
        json["noisePercent"] = 100.0 * *noise;
        if (options.noise && 100.0 * *noise > *options.noise)
            session.report().warn(fmt::format("± {:.2f} % of the mean after {} paths per pixel: "
                                              "not yet the {:g} % that --noise asks for",
                                              100.0 * *noise, done, *options.noise));
        session.report().line(
            fmt::format("{} paths per pixel, ± {:.2f} % of the mean", done, 100.0 * *noise));
    }

    std::vector<ImagePart> parts(1);
    const Image radiance = film.radiance(frame.transparentBackground);
    if (isLinearFormat(format)) {
        parts[0].image = radiance;
    } else {
        Result<Image> shown = displayedPicture(radiance, document.view, luminanceOf(radiance));
        if (!shown)
            return shown.error();
        parts[0].image = *std::move(shown);
    }
    return writePictures(session, options.output, std::move(parts), format);
}

} // namespace patina::cli
