#include "app/cli/Commands.h"
#include "app/cli/InspectPixel.h"
#include "app/cli/LocalShadows.h"
#include "app/cli/Numbers.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/RenderViews.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/io/DisplayTransform.h"
#include "core/io/ImageIO.h"
#include "core/mix/LightMix.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/gl/Context.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace patina::cli {
namespace {

Result<render::FrameSettings> frameSettings(const RenderOptions& options) {
    render::FrameSettings frame;
    std::vector<int> size;
    if (!parseNumbers(options.size, 'x', size) || size.size() != 2 || size[0] < 1 || size[1] < 1)
        return usageError(
            fmt::format("--size wants WIDTHxHEIGHT in pixels, for example 1920x1080, not "
                        "\"{}\"",
                        options.size));
    frame.width = size[0];
    frame.height = size[1];
    frame.samples = options.samples;
    return frame;
}

// The camera frames the scene as the editor does, unless a project has one of its own.
Result<Camera> chooseCamera(const RenderOptions& options, const Document& document, bool isProject,
                            float aspect) {
    Camera camera = document.view.camera;
    std::vector<float> orbit;
    if (!options.camera.empty()) {
        if (!parseNumbers(options.camera, ',', orbit) || orbit.size() < 2 || orbit.size() > 3 ||
            !(std::abs(orbit[1]) <= 89.0f) || (orbit.size() == 3 && !(orbit[2] > 0.0f)))
            return usageError(fmt::format("--camera wants YAW,PITCH[,DISTANCE] with a pitch within "
                                          "±89° and a distance above 0, not \"{}\"",
                                          options.camera));
        camera.yawDeg = orbit[0];
        camera.pitchDeg = orbit[1];
    }
    if (!isProject || !options.camera.empty())
        camera = frameBounds(camera, document.bounds(), aspect);
    if (orbit.size() == 3)
        camera.distance = orbit[2];
    return camera;
}

Result<void> applyView(Session& session, const RenderOptions& options, Document& document,
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

// What the picture is lit by bounces as often as view.bounces says, and off the colours that
// surfaces have now.
Result<void> followBounces(Session& session, const render::ViewSettings& shown,
                           Document& document) {
    const int bounces = document.view.bounces;
    // Less than 0 bounces: none are shown, which needs no other bake.
    if (document.bakes.empty() || bounces < 0 ||
        lightingOf(shown.shown.kind, document.view.lighting) != LightingMode::Prt)
        return {};
    const BakeInputs inputs = bakeInputs(document);
    const Hash geometry = hashBakeInputs(inputs);
    std::optional<Hash> albedo; // reads every texel of the maps
    for (BakeArtifactPtr& bake : document.bakes) {
        if (!holdsTransfer(bake->kind) || bake->transfer != TransferKind::Interreflected)
            continue;
        if (!albedo)
            albedo = hashBakeAlbedo(inputs);
        const bool otherColors = bake->albedo != *albedo;
        const bool otherNumber = bounces != 0 && bake->bounces != bounces;
        if (!otherColors && !otherNumber)
            continue;
        const bool canFollow = bake->kind == BakeKind::PrtVertex && bake->inputs == geometry;
        if (!otherNumber && !canFollow) {
            session.report().warn("the bounces of the bake are of other colours than the scene "
                                  "has now, and show those; bake it anew");
            continue;
        }
        session.beginPhase();
        Result<BakeArtifactPtr> followed =
            withBounces(*bake, inputs, bounces != 0 ? bounces : bake->bounces, session.job());
        if (!followed)
            return followed.error();
        bake = std::move(*followed);
    }
    return {};
}

// Pictures of a scene that has changed since are no pictures of the scene.
void warnOfStaleBakes(Session& session, const Document& document) {
    if (document.bakes.empty())
        return;
    const Hash geometry = hashBakeInputs(bakeInputs(document));
    for (const BakeArtifactPtr& bake : document.bakes)
        for (const std::string& reason :
             bakeStaleness(*bake, document, geometry, bake->albedo).reasons)
            session.report().warn(fmt::format("a bake is stale: {}; bake it anew", reason));
}

// Opaque pictures carry no alpha.
Image withoutAlpha(const Image& image) {
    Image result(image.width(), image.height(), 3, image.type(), image.encoding());
    const std::size_t pixels =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    const std::size_t bytes = result.bytesPerPixel();
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(image.bytes().begin() + static_cast<std::ptrdiff_t>(i * image.bytesPerPixel()),
                    bytes, result.bytes().begin() + static_cast<std::ptrdiff_t>(i * bytes));
    return result;
}

// The view of OpenColorIO that the document asks for; null when it asks for none.
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

// The document and its light on the GPU; the context lives as long as they.
struct Prepared {
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<render::SceneRenderer> scene;
};

// `lit`: the environment's light is part of what is drawn.
Result<Prepared> prepare(Session& session, const Document& document,
                         const render::FrameSettings& frame, bool linear, bool lit) {
    // Linear pictures need no display.
    Result<DisplayTransformPtr> display =
        linear ? DisplayTransformPtr() : openDisplay(session, document.view);
    if (!display)
        return display.error();
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

    Result<std::unique_ptr<render::SceneRenderer>> scene = render::SceneRenderer::create(**context);
    if (!scene)
        return scene.error();
    session.beginPhase();
    session.job().setActivity("preparing light");
    if (const ImagePtr image = lit ? shownEnvironment(document).image : nullptr) {
        Result<IblMaps> ibl = prepareLight(*image, session.job());
        if (!ibl)
            return ibl.error();
        Result<HalfMipmapsPtr> background = makeBackground(*image, session.job());
        if (!background)
            return background.error();
        (*scene)->setEnvironment(std::make_shared<const EnvironmentTexels>(
            makeEnvironmentTexels(image, *ibl, std::move(*background))));
    }
    if (Result<void> set = (*scene)->setDisplay(*display); !set)
        return set.error();
    session.job().setActivity("drawing");
    (*scene)->setDocument(document);
    return Prepared{std::move(*context), std::move(*scene)};
}

bool isLinear(ImageFileFormat format) {
    return format == ImageFileFormat::Exr || format == ImageFileFormat::Hdr;
}

// What the file will hold, after the frame has been drawn.
Result<std::vector<ImagePart>> takePictures(Session& session, render::ViewRenderer& renderer,
                                            const Document& document, const RenderOptions& options,
                                            const render::FrameSettings& frame, bool linear) {
    const render::ViewChoice& shown = frame.view.shown;
    if (linear && wantsAllViews(options))
        return viewParts(renderer, document, frame.view);
    std::vector<ImagePart> parts(1);
    const auto take = [&](Result<Image> image) -> Result<std::vector<ImagePart>> {
        if (!image)
            return image.error();
        parts[0].image = std::move(*image);
        return std::move(parts);
    };
    if (wantsAllViews(options))
        return take(contactSheet(session, renderer, document, frame));
    if (linear && (shown.kind != shading::kViewFinal || shown.mode != render::ViewMode::Raw))
        return take(viewNumbers(renderer, shown));
    const Image picture = linear ? renderer.readLinear() : renderer.readDisplayed();
    return take(frame.transparentBackground ? picture : withoutAlpha(picture));
}

Result<void> writePictures(Session& session, render::ViewRenderer& renderer,
                           const Document& document, const RenderOptions& options,
                           const render::FrameSettings& frame, ImageFileFormat format) {
    Result<std::vector<ImagePart>> pictures =
        takePictures(session, renderer, document, options, frame, isLinear(format));
    if (!pictures)
        return pictures.error();
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    Result<Bytes> bytes = encodeImage(session.worker(), *pictures, format);
    if (!bytes) {
        Error error = bytes.error();
        error.file = options.output;
        return error;
    }
    if (Result<void> saved = writeFileAtomically(options.output, *bytes); !saved)
        return saved;
    const Image& first = pictures->front().image;
    session.report().output(
        options.output,
        fmt::format("{} × {} pixels{}", first.width(), first.height(),
                    pictures->size() > 1 ? fmt::format(", {} parts", pictures->size()) : ""));
    return {};
}

void reportLeftOut(Report& report, const std::vector<LeftOut>& left) {
    auto& json = report.json()["leftOut"] = nlohmann::ordered_json::array();
    std::vector<std::pair<std::string, std::string>> rows;
    for (const LeftOut& one : left) {
        json.push_back({{"view", std::string(one.view->id)}, {"reason", one.reason}});
        rows.emplace_back(one.view->id, one.reason);
    }
    if (!rows.empty())
        report.table("Does not apply to this scene:", rows);
}

} // namespace

Result<void> run(Session& session, const RenderOptions& options) {
    const bool writes = !options.output.empty();
    if (!writes && options.inspect.empty())
        return usageError(
            "--output is required: where the picture goes; only --inspect does without");
    Result<ImageFileFormat> format =
        writes ? imageFormatForPath(options.output) : ImageFileFormat::Png;
    if (!format)
        return format.error();
    Result<render::FrameSettings> frame = frameSettings(options);
    if (!frame)
        return frame.error();
    const Result<std::optional<glm::ivec2>> inspected = parsePixel(options.inspect, *frame);
    if (!inspected)
        return inspected.error();
    if (writes)
        if (Result<void> output = checkOutput(options.output); !output)
            return output;

    nlohmann::ordered_json& json = session.report().json();
    json["settings"] = {{"scene", options.scene},
                        {"size", {frame->width, frame->height}},
                        {"samples", options.samples}};
    session.beginPhase();
    SceneRequest request{options.scene, options.environment, options.environmentLayout,
                         options.bakes};
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    if (Result<void> view = applyView(session, options, *document, *frame); !view)
        return view;
    Result<render::ViewSettings> shown = viewSettings(options, *document);
    if (!shown)
        return shown.error();
    frame->view = *shown;
    frame->floats = writes && isLinear(*format);
    if (wantsAllViews(options))
        reportLeftOut(session.report(), leftOutViews(*document, *shown));
    warnOfStaleBakes(session, *document);
    for (const render::LightLimit& limit : render::lightLimits(*document))
        session.report().warn(limit.text);
    if (Result<void> followed = followBounces(session, *shown, *document); !followed)
        return followed;
    if (!options.view.empty()) {
        json["settings"]["view"] = options.view;
        json["settings"]["viewMode"] = options.viewMode;
    }
    const float aspect = static_cast<float>(frame->width) / static_cast<float>(frame->height);
    Result<Camera> camera = chooseCamera(options, *document, request.isProject, aspect);
    if (!camera)
        return camera.error();
    document->view.camera = frame->camera = *camera;
    json["settings"]["environment"] = environmentName(document->environment());
    json["settings"]["camera"] = {
        {"yawDeg", camera->yawDeg},
        {"pitchDeg", camera->pitchDeg},
        {"distance", camera->distance},
        {"fovDeg", camera->fovDeg},
        {"target", {camera->target.x, camera->target.y, camera->target.z}}};
    const View& view = document->view;
    json["settings"]["exposure"] = {
        {"mode", view.exposureMode == ExposureMode::Automatic ? "automatic" : "fixed"},
        {"ev", view.exposureEv}};
    json["settings"]["toneMap"] =
        formatParameterValue(*findParameter("view.toneMap"), static_cast<int>(view.toneMap));
    json["settings"]["lighting"] =
        formatParameterValue(*findParameter("view.lighting"), static_cast<int>(view.lighting));

    // Light that is switched off is looked at only by views and by explanations.
    const bool lit =
        !environmentParts(*document).empty() || !options.view.empty() || inspected->has_value();
    // An explanation ends with the displayed colour, even where the picture is linear.
    Result<Prepared> prepared =
        prepare(session, *document, *frame, isLinear(*format) && !inspected->has_value(), lit);
    if (!prepared)
        return prepared.error();
    render::ViewRenderer renderer(*prepared->scene);
    const Result<NearShadowsPtr> shadows = traceLocalShadows(session, options, *document, *shown);
    if (!shadows)
        return shadows.error();
    prepared->scene->setNearShadows(*shadows);
    if (Result<void> drawn = renderer.render(*frame, 0); !drawn)
        return drawn;
    if (const std::optional<Luminance> luminance = renderer.readLuminance())
        json["logAverageLuminance"] = luminance->logAverage;
    if (const auto range = renderer.shownRange())
        json["viewRange"] = {range->min, range->max};
    if (writes)
        if (Result<void> written =
                writePictures(session, renderer, *document, options, *frame, *format);
            !written)
            return written;
    if (*inspected)
        if (Result<void> done = explainPixel(session, renderer, *document, *shadows, **inspected);
            !done)
            return done;
    json["counts"] = {{"meshes", document->meshes.size()},
                      {"triangles", document->triangleCount()}};
    return {};
}

} // namespace patina::cli
