#include "app/cli/CacheFolders.h"
#include "app/cli/Commands.h"
#include "app/cli/ErrorAgainst.h"
#include "app/cli/InspectPixel.h"
#include "app/cli/LocalShadows.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/RenderSequence.h"
#include "app/cli/RenderTraced.h"
#include "app/cli/RenderViews.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/document/Lighting.h"
#include "core/image/Channels.h"
#include "core/io/DisplayTransform.h"
#include "core/io/ImageIO.h"
#include "core/io/VideoWriter.h"
#include "core/mix/LightMix.h"
#include "render/FollowedRadiosity.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/gl/Context.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <fmt/format.h>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace patina::cli {
namespace {

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
    Result<std::unique_ptr<gl::Context>> context = createContext(session, frame);
    if (!context)
        return context.error();
    session.beginPhase();
    session.job().setActivity("preparing light");
    // Beside what this thread does with OpenGL.
    std::future<Result<EnvironmentTexelsPtr>> light;
    if (ImagePtr image = lit ? shownEnvironment(document).image : nullptr)
        light = std::async(std::launch::async, [image = std::move(image), job = session.job()] {
            return prepareTexels(image, job);
        });
    Result<std::unique_ptr<render::SceneRenderer>> scene = render::SceneRenderer::create(**context);
    if (!scene)
        return scene.error();
    if (Result<void> set = (*scene)->setDisplay(*display); !set)
        return set.error();
    (*scene)->setDocument(document);
    if (light.valid()) {
        Result<EnvironmentTexelsPtr> texels = light.get();
        if (!texels)
            return texels.error();
        (*scene)->setEnvironment(std::move(*texels));
    }
    session.job().setActivity("drawing");
    return Prepared{std::move(*context), std::move(*scene)};
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

// `live`: what a picture is lit by; null: by something else.
void reportRadiosity(const LiveRadiosityPtr& live, nlohmann::ordered_json& json) {
    if (!live)
        return;
    json["radiosity"] = {{"elements", live->elements().size()},
                         {"sources", live->sources.size()},
                         {"found", live->foundSources()},
                         {"sweeps", live->sweeps},
                         {"residual", live->residual}};
}

} // namespace

Result<void> run(Session& session, const RenderOptions& options) {
    const bool writes = !options.output.empty();
    if (!writes && options.inspect.empty() && options.rayTree.empty())
        return usageError("--output is required: where the picture goes; only --inspect and "
                          "--ray-tree do without");
    if (Result<void> fits = checkRenderer(session.options(), options); !fits)
        return fits;
    if (!options.errorAgainst.empty() && !options.view.empty() && options.view != "final")
        return usageError("--error-against compares the picture; leave --view out");
    if (!options.errorAgainst.empty() && (options.turntable > 0 || options.lightTurn > 0))
        return usageError("--error-against compares one picture; leave --turntable and "
                          "--light-turn out");
    const Result<std::optional<SequenceRequest>> sequence = sequenceRequest(options);
    if (!sequence)
        return sequence.error();
    Result<ImageFileFormat> format = ImageFileFormat::Png;
    if (isTracedPart(options))
        format = ImageFileFormat::Exr; // for which a part holds all there is
    else if (writes && !isVideoFile(options.output))
        format = imageFormatForPath(options.output);
    if (!format)
        return format.error();
    Result<render::FrameSettings> frame = frameSettings(options);
    if (!frame)
        return frame.error();
    const Result<std::optional<glm::ivec2>> inspected = parsePixel(options.inspect, *frame);
    if (!inspected)
        return inspected.error();
    if (const auto rays = parsePixel(options.rayTree, *frame, "--ray-tree"); !rays)
        return rays.error();
    if (writes)
        if (Result<void> output = checkOutput(options.output); !output)
            return output;

    if (!needsImageLibraries(options) && options.errorAgainst.empty())
        session.expectNoImages();
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
    frame->floats = writes && isLinearFormat(*format);
    if (wantsAllViews(options))
        reportLeftOut(session.report(), leftOutViews(*document, *shown));
    warnOfStaleBakes(session, *document);
    for (const render::LightLimit& limit : render::lightLimits(*document))
        if (!isTraced(options)) // paths have other limits
            session.report().warn(limit.text);
    if (Result<void> followed = followBounces(session, *shown, *document); !followed)
        return followed;
    if (!options.view.empty()) {
        json["settings"]["view"] = options.view;
        json["settings"]["viewMode"] = options.viewMode;
    }
    const float aspect = static_cast<float>(frame->width) / static_cast<float>(frame->height);
    Result<Camera> camera = chooseCamera(session, options, *document, request, aspect);
    if (!camera)
        return camera.error();
    document->view.camera = frame->camera = *camera;
    json["settings"]["environment"] = environmentName(document->environment());
    json["settings"]["camera"] = describeCamera(*camera);
    describeView(json["settings"], document->view);

    json["counts"] = {{"meshes", document->meshes.size()},
                      {"triangles", document->triangleCount()}};
    std::optional<PictureSubject> subject;
    if (!options.errorAgainst.empty() || *format == ImageFileFormat::Exr)
        subject = subjectOf(*document, frame->camera);
    std::optional<Image> reference;
    if (!options.errorAgainst.empty()) {
        Result<Image> loaded =
            loadReference(session, options.errorAgainst, frame->width, frame->height, *subject);
        if (!loaded)
            return loaded.error();
        reference = *std::move(loaded);
        frame->floats = true;
    }
    if (isTraced(options))
        return renderTraced(session, options, *document, *frame, *format,
                            reference ? &*reference : nullptr);

    // Light that is switched off is looked at only by views and by explanations.
    const bool lit =
        !environmentParts(*document).empty() || !options.view.empty() || inspected->has_value();
    // An explanation ends with the displayed colour, even where the picture is linear.
    Result<Prepared> prepared = prepare(session, *document, *frame,
                                        isLinearFormat(*format) && !inspected->has_value(), lit);
    if (!prepared)
        return prepared.error();
    render::ViewRenderer renderer(*prepared->scene);
    const Result<NearShadowsPtr> shadows = traceLocalShadows(
        session, options, *document, wantsAllViews(options) || isLitByBake(*shown, *document));
    if (!shadows)
        return shadows.error();
    prepared->scene->setNearShadows(*shadows);
    render::FollowedRadiosity radiosity(radiosityCache());
    if (!sequence->has_value()) {
        session.beginPhase();
        if (Result<void> solved =
                radiosity.update(*prepared->scene, *document, *shown, session.job());
            !solved)
            return solved;
        reportRadiosity(radiosity.live(), json);
    }
    if (*sequence)
        return renderSequence(session, options, **sequence, *document, *prepared->scene, renderer,
                              *frame);
    if (Result<void> drawn = drawFine(renderer, *frame, session.job()); !drawn)
        return drawn;
    if (const std::optional<Luminance> luminance = renderer.readLuminance())
        json["logAverageLuminance"] = luminance->logAverage;
    if (const auto range = renderer.shownRange())
        json["viewRange"] = {range->min, range->max};
    if (writes) {
        Result<std::vector<ImagePart>> pictures =
            takePictures(session, renderer, *document, options, *frame, isLinearFormat(*format));
        if (!pictures)
            return pictures.error();
        if (session.job().cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        if (*format == ImageFileFormat::Exr)
            for (ImagePart& picture : *pictures)
                picture.attributes.merge(attributesOf(*subject));
        if (Result<void> written =
                writePictures(session, options.output, std::move(*pictures), *format);
            !written)
            return written;
    }
    if (reference)
        if (Result<void> compared =
                reportError(session, options.errorAgainst, renderer.readLinear(), *reference);
            !compared)
            return compared;
    if (*inspected)
        if (Result<void> done = explainPixel(session, renderer, *document, *shadows, **inspected);
            !done)
            return done;
    return {};
}

} // namespace patina::cli
