#include "app/cli/PictureSetup.h"

#include "app/cli/Numbers.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/document/FollowBounces.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/base/AtomicFile.h"
#include "core/base/Limits.h"
#include "core/document/Lighting.h"
#include "core/document/Source.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace patina::cli {

bool needsImageLibraries(const PictureOptions& options) {
    const Result<ImageFileFormat> format = imageFormatForPath(options.output);
    return !isBuiltin(options.scene) || !options.bakes.empty() ||
           (!options.environment.empty() && !isBuiltin(options.environment)) ||
           (format && *format != ImageFileFormat::Png);
}

Result<render::FrameSettings> frameSettings(const PictureOptions& options) {
    render::FrameSettings frame;
    std::vector<int> size;
    if (!parseNumbers(options.size, 'x', size) || size.size() != 2 || size[0] < 1 || size[1] < 1)
        return usageError(
            fmt::format("--size wants WIDTHxHEIGHT in pixels, for example 1920x1080, not "
                        "\"{}\"",
                        options.size));
    if (std::max(size[0], size[1]) > limits::kMaxImageSide)
        return usageError(fmt::format("--size: {} is too large; a picture has at most {} pixels a "
                                      "side",
                                      options.size, limits::kMaxImageSide));
    if (std::uint64_t{16} * static_cast<std::uint64_t>(size[0]) *
            static_cast<std::uint64_t>(size[1]) >
        sizeof(float) * limits::kMaxImageBytes)
        return usageError(
            fmt::format("--size: {} are too many pixels; choose fewer", options.size));
    frame.width = size[0];
    frame.height = size[1];
    frame.samples = options.samples;
    return frame;
}

namespace {

constexpr std::string_view kOfScene = "scene:"; // --camera scene:NAME

Result<Camera> cameraOfScene(Session& session, const PictureOptions& options,
                             const Document& document, const std::vector<SceneCamera>& cameras) {
    const std::string name = options.camera.substr(kOfScene.size());
    const auto found = std::ranges::find(cameras, name, &SceneCamera::name);
    if (found == cameras.end()) {
        std::string names;
        for (const SceneCamera& camera : cameras)
            names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", camera.name);
        return usageError(fmt::format("the scene has no camera \"{}\"; {}", name,
                                      names.empty() ? "its files hold none that is read"
                                                    : "its cameras are " + names));
    }
    std::string notice;
    Camera camera = cameraLike(*found, document.view.camera, document.bounds(), notice);
    if (!notice.empty())
        session.report().warn(notice);
    if (!options.fov.empty())
        camera.fovDeg = document.view.camera.fovDeg;
    return camera;
}

} // namespace

Result<Camera> chooseCamera(Session& session, const PictureOptions& options,
                            const Document& document, const SceneRequest& request, float aspect) {
    if (options.camera.starts_with(kOfScene))
        return cameraOfScene(session, options, document, request.cameras);
    Camera camera = document.view.camera;
    std::vector<float> orbit;
    if (!options.camera.empty()) {
        if (!parseNumbers(options.camera, ',', orbit) || orbit.size() < 2 || orbit.size() > 3 ||
            !(std::abs(orbit[1]) <= 89.0f) || (orbit.size() == 3 && !(orbit[2] > 0.0f)))
            return usageError(fmt::format("--camera wants YAW,PITCH[,DISTANCE] with a pitch within "
                                          "±89° and a distance above 0, or scene:NAME, not \"{}\"",
                                          options.camera));
        camera.yawDeg = orbit[0];
        camera.pitchDeg = orbit[1];
    }
    if (!request.isProject || !options.camera.empty())
        camera = frameBounds(camera, document.bounds(), aspect);
    if (orbit.size() == 3)
        camera.distance = orbit[2];
    return camera;
}

Result<void> applyView(Session& session, const PictureOptions& options, Document& document,
                       render::FrameSettings& frame) {
    const auto set = [&](const char* name, const std::string& value) {
        return value.empty() ? Result<void>() : setParameter(session, document, name, value);
    };
    if (options.exposure == "auto" || options.exposure == "automatic")
        document.view.exposureMode = ExposureMode::Automatic;
    else if (Result<void> result = set("view.exposureEv", options.exposure); !result)
        return usageError(
            fmt::format("--exposure wants a number of EV from -24 to 24 or \"auto\", not "
                        "\"{}\"",
                        options.exposure));
    for (const auto& [name, value] : {std::pair{"view.fovDeg", options.fov},
                                      {"view.toneMap", options.toneMap},
                                      {"view.lighting", options.lighting}})
        if (Result<void> result = set(name, value); !result)
            return result;
    if (!options.toneMap.empty())
        if (Result<void> offered = checkOffered(document, "view.toneMap"); !offered)
            return offered;

    View& view = document.view;
    if (options.background == "visible")
        view.background = BackgroundMode::Environment;
    else if (options.background == "blurred")
        view.background = BackgroundMode::Blurred;
    else if (options.background == "transparent" || options.background == "off")
        view.background = BackgroundMode::Off;
    else if (!options.background.empty()) {
        view.background = BackgroundMode::Color;
        if (Result<void> result = set("environment.backgroundColor", options.background); !result)
            return usageError(fmt::format("--background wants visible, blurred, transparent or a "
                                          "colour as R,G,B or #rrggbb, not \"{}\"",
                                          options.background));
    }
    frame.transparentBackground = view.background == BackgroundMode::Off;
    if (Result<void> offered = checkOffered(document, "view.lighting"); !offered)
        return offered;
    return {};
}

Result<void> followBounces(Session& session, const render::ViewSettings& shown,
                           Document& document) {
    session.beginPhase();
    const Result<std::vector<std::string>> followed = patina::followBounces(
        lightingOf(shown.shown.kind, document.view.lighting), document, session.job());
    if (!followed)
        return followed.error();
    for (const std::string& warning : *followed)
        session.report().warn(warning);
    return {};
}

bool isLitByBake(const render::ViewSettings& shown, const Document& document) {
    return readsBake(lightingOf(shown.shown.kind, document.view.lighting));
}

void warnOfStaleBakes(Session& session, const Document& document) {
    if (document.bakes.empty())
        return;
    const Hash geometry = hashBakeInputs(bakeInputs(document));
    for (const BakeArtifactPtr& bake : document.bakes)
        for (const std::string& reason :
             bakeStaleness(*bake, document, geometry, bake->albedo,
                           bake->kind == BakeKind::LightMap
                               ? hashLightMapLight(traceInputs(document))
                               : Hash{})
                 .reasons)
            session.report().warn(fmt::format("a bake is stale: {}; bake it anew", reason));
}

Result<DisplayTransformPtr> openDisplay(Session& session, const View& view) {
    if (view.toneMap != ToneMap::OpenColorIo)
        return DisplayTransformPtr();
    const std::string config = openColorIoConfig(view.ocioConfig);
    if (config.empty())
        return usageError(
            "the view is shown through OpenColorIO, and there is no configuration; set "
            "the environment variable OCIO to one, or choose another --tone-map");
    Result<DisplayTransform> display =
        loadDisplayTransform(session.worker(), config, view.ocioDisplay, view.ocioView);
    if (!display)
        return display.error();
    session.report().json()["settings"]["openColorIo"] = {{"config", display->config},
                                                          {"display", display->display},
                                                          {"view", display->view},
                                                          {"workingSpace", display->space}};
    return std::make_shared<const DisplayTransform>(std::move(*display));
}

Result<EnvironmentTexelsPtr> prepareTexels(const ImagePtr& image, const JobContext& job) {
    Result<IblMaps> ibl = prepareLight(*image, job);
    if (!ibl)
        return ibl.error();
    Result<HalfMipmapsPtr> background = makeBackground(*image, job);
    if (!background)
        return background.error();
    return std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(image, *ibl, std::move(*background)));
}

Result<std::unique_ptr<gl::Context>> createContext(Session& session,
                                                   const render::FrameSettings& frame) {
    Result<std::unique_ptr<gl::Context>> context = gl::Context::createHeadless();
    if (!context)
        return context.error();
    const gl::ContextInfo& info = (*context)->info();
    session.report().json()["openGl"] = {
        {"vendor", info.vendor}, {"renderer", info.renderer}, {"version", info.version}};
    if (std::max(frame.width, frame.height) > info.maxTextureSize)
        return usageError(
            fmt::format("{} can draw at most {} pixels a side; choose a smaller --size",
                        info.renderer, info.maxTextureSize));
    if (frame.samples > info.maxSamples)
        return usageError(
            fmt::format("{} takes at most {} samples per pixel; choose fewer --samples",
                        info.renderer, info.maxSamples));
    return context;
}

Result<void> writePictures(Session& session, const std::filesystem::path& output,
                           std::vector<ImagePart> pictures, ImageFileFormat format) {
    const Image& first = pictures.front().image;
    const std::string what =
        fmt::format("{} × {} pixels{}", first.width(), first.height(),
                    pictures.size() > 1 ? fmt::format(", {} parts", pictures.size()) : "");
    Result<Bytes> bytes = encodeImage(session.worker(), std::move(pictures), format);
    if (!bytes) {
        Error error = bytes.error();
        error.file = output;
        return error;
    }
    if (Result<void> saved = writeFileAtomically(output, *bytes); !saved)
        return saved;
    session.report().output(output, what);
    return {};
}

Result<void> drawFine(render::ViewRenderer& renderer, render::FrameSettings& frame,
                      const JobContext& job) {
    frame = render::withDepthOfField(frame);
    do {
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        if (Result<void> drawn = renderer.render(frame, 0); !drawn)
            return drawn;
    } while (!renderer.isSteady());
    return {};
}

} // namespace patina::cli
