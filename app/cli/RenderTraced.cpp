#include "app/cli/RenderTraced.h"

#include "app/cli/ErrorAgainst.h"
#include "app/cli/InspectPixel.h"
#include "app/cli/LongBake.h"
#include "app/cli/LongRun.h"
#include "app/cli/RenderWhitted.h"
#include "app/cli/Report.h"
#include "app/cli/TracedBackground.h"
#include "app/cli/TracedPicture.h"
#include "core/bake/BakeMemory.h"
#include "core/base/Limits.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/file/FilmTracer.h"
#include "core/trace/file/OutputImages.h"
#include "core/trace/path/PathTracer.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::cli {
namespace {

// Of which shard; usage errors for what a part cannot do.
Result<TraceShard> shardOfPicture(const RenderOptions& options) {
    if (options.work.shard.empty())
        return TraceShard{};
    const Result<PassShard> shard = parseShard(options.work.shard, environmentVariable);
    if (!shard)
        return shard.error();
    return TraceShard{shard->index, shard->count};
}

// What could not be held or written is refused before the first ray.
Result<void> checkPictureSize(const render::FrameSettings& frame,
                              const std::vector<const OutputInfo*>& outputs, std::size_t counts) {
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
    std::uint64_t channels = (frame.transparentBackground ? 1 : 0) + counts;
    if (outputs.empty())
        channels += 3;
    for (const OutputInfo* info : outputs)
        channels += info->channels.size();
    const std::uint64_t written = pixels * channels * sizeof(float);
    if (written > limits::kMaxImageBytes)
        return usageError(
            fmt::format("the picture has {} of numbers, and a file holds at most {}; "
                        "choose a smaller --size{}",
                        memoryText(written), memoryText(limits::kMaxImageBytes),
                        outputs.size() + counts > 1 ? ", or fewer outputs (--aov)" : ""));
    return checkTracingMemory(frame.width, frame.height,
                              sizeof(Film::Pixel) +
                                  (needTraceOutputs(outputs) ? sizeof(TraceOutputs::Pixel) : 0) +
                                  (counts > 0 ? sizeof(RayCounts) : 0) + channels * sizeof(float));
}

FilmManifest filmManifest(const Session& session, const RenderOptions& options,
                          const Document& document, const TraceInputs& inputs,
                          const render::FrameSettings& frame, std::uint32_t samples) {
    FilmManifest manifest;
    manifest.width = frame.width;
    manifest.height = frame.height;
    manifest.settings = {{"samples", std::to_string(samples)},
                         {"seed", std::to_string(options.seed)},
                         {kCameraSetting, cameraText(frame.camera)},
                         {kBackgroundSetting, backgroundText(document.view)}};
    if (options.noise)
        manifest.settings["noise"] = fmt::format("{} %", *options.noise);
    if (isWhitted(options))
        addSettings(whittedSettings(options), manifest.settings);
    else if (options.maxBounces)
        manifest.settings["max-bounces"] = std::to_string(*options.maxBounces);
    manifest.display = displaySettings(document);
    manifest.inputs = hashTraceInputs(inputs);
    manifest.camera = frame.camera;
    manifest.transparent = frame.transparentBackground;
    manifest.scene = absoluteSource(options.scene);
    manifest.sets = session.options().sets;
    return manifest;
}

// The rays of a pixel of --ray-tree, where it is given.
Result<void> showRayTree(Session& session, const RenderOptions& options, const Document& document,
                         const TraceScene& scene, const TraceView& view,
                         const render::FrameSettings& frame) {
    const Result<std::optional<glm::ivec2>> pixel =
        parsePixel(options.rayTree, frame, "--ray-tree");
    if (!pixel)
        return pixel.error();
    if (*pixel)
        reportRayTree(session, document,
                      traceRayTree(scene, view, whittedSettings(options), (*pixel)->x, (*pixel)->y,
                                   samplesOf(options)),
                      **pixel);
    return {};
}

void reportSamples(Session& session, const RenderOptions& options, const FilmTracer& tracer) {
    nlohmann::ordered_json& json = session.report().json();
    const std::uint32_t done = tracer.manifest().samples;
    if (const std::size_t invalid = tracer.film().invalid(); invalid > 0)
        session.report().warn(fmt::format(
            "{} {} brought no finite number and count as black; look for values that are not "
            "finite in the scene's maps",
            invalid, unitOf(options)));
    json["settings"]["renderer"] = options.renderer;
    json["settings"]["samples"] = done;
    json["settings"]["seed"] = options.seed;
    if (isWhitted(options))
        json["settings"]["whitted"] = describeWhitted(whittedSettings(options));
    else if (options.maxBounces)
        json["settings"]["maxBounces"] = *options.maxBounces;
    if (tracer.resumedFrom())
        json["resumedFrom"] = *tracer.resumedFrom();
    const std::optional<double>& noise = tracer.noise();
    if (!noise)
        return;
    json["noisePercent"] = 100.0 * *noise;
    if (options.noise && 100.0 * *noise > *options.noise)
        session.report().warn(fmt::format("± {:.2f} % of the mean after {} {} per pixel: "
                                          "not yet the {:g} % that --noise asks for",
                                          100.0 * *noise, done, unitOf(options), *options.noise));
    session.report().line(fmt::format("{} {} per pixel, ± {:.2f} % of the mean", done,
                                      unitOf(options), 100.0 * *noise));
}

// The same without a picture.
Result<void> renderRayTree(Session& session, const RenderOptions& options, const Document& document,
                           const render::FrameSettings& frame) {
    session.beginPhase();
    session.job().setActivity("preparing the scene");
    const Result<TraceView> view = traceView(session, document, frame);
    if (!view)
        return view.error();
    const Result<TraceScene> scene = TraceScene::build(traceInputs(document), session.job());
    if (!scene)
        return scene.error();
    session.report().json()["settings"]["renderer"] = options.renderer;
    session.report().json()["settings"]["whitted"] = describeWhitted(whittedSettings(options));
    return showRayTree(session, options, document, *scene, *view, frame);
}

} // namespace

Result<void> checkRenderer(const CommonOptions& common, const RenderOptions& options) {
    if (Result<void> tracing = checkTracing(options); !tracing)
        return tracing;
    if (Result<void> whitted = checkWhitted(options); !whitted)
        return whitted;
    if (options.renderer == "path" && !options.aov.empty())
        if (const auto outputs = parseOutputs(options.aov); !outputs)
            return outputs.error();
    if (!isTraced(options)) {
        for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 4>{
                 {{!options.aov.empty(), "--aov"},
                  {!options.work.shard.empty(), "--shard"},
                  {!options.work.checkpoint.empty(), "--checkpoint"},
                  {options.work.resume, "--resume"}}})
            if (given)
                return usageError(fmt::format("{} is for --renderer path and whitted", name));
        return {};
    }
    for (const auto& [given, name] :
         std::array<std::pair<bool, const char*>, 4>{{{!options.view.empty(), "--view"},
                                                      {!options.inspect.empty(), "--inspect"},
                                                      {options.turntable > 0, "--turntable"},
                                                      {options.lightTurn > 0, "--light-turn"}}})
        if (given)
            return usageError(fmt::format("{} is for --renderer raster: rays bring the light of "
                                          "the whole picture, and need no bake",
                                          name));
    if (options.work.shard.empty())
        return {};
    if (common.keepPartial)
        return usageError("--keep-partial is for whole pictures; a part that is stopped goes on "
                          "with --checkpoint and --resume");
    if (!options.errorAgainst.empty())
        return usageError("--error-against is for whole pictures; merge the parts and use patina "
                          "compare");
    if (options.noise)
        return usageError("--noise looks at the whole picture, of which a part sees little; give "
                          "the parts --samples instead");
    return {};
}

Result<void> renderTraced(Session& session, const RenderOptions& options, const Document& document,
                          const render::FrameSettings& frame, ImageFileFormat format,
                          const Image* reference) {
    const Result<TraceShard> shard = shardOfPicture(options);
    if (!shard)
        return shard.error();
    if (options.output.empty())
        return renderRayTree(session, options, document, frame);
    const bool isPart = isTracedPart(options);
    const bool byPaths = !isWhitted(options), hasAov = !options.aov.empty();
    const Result<std::vector<const OutputInfo*>> outputs =
        hasAov && byPaths
            ? parseOutputs(options.aov)
            : Result<std::vector<const OutputInfo*>>(std::vector<const OutputInfo*>());
    if (!outputs)
        return outputs.error();
    const Result<std::vector<const RayCountInfo*>> counts =
        hasAov && !byPaths
            ? parseRayCounts(options.aov)
            : Result<std::vector<const RayCountInfo*>>(std::vector<const RayCountInfo*>());
    if (!counts)
        return counts.error();
    if (hasAov && format != ImageFileFormat::Exr)
        return usageError("--aov writes a part of an .exr for each output; name such a file");
    const Result<LongRun> run = planLongRun(options.output, options.work);
    if (!run)
        return run.error();
    if (Result<void> shown = isPart ? Result<void>() : checkDisplay(document.view, format); !shown)
        return shown;
    if (Result<void> fits = checkPictureSize(frame, *outputs, counts->size()); !fits)
        return fits;
    const Result<std::optional<FileLock>> lock =
        beginLongRun(session, *run, options.output, "picture");
    if (!lock)
        return lock.error();

    session.beginPhase();
    session.job().setActivity("preparing the scene");
    const Result<TraceView> view = traceView(session, document, frame);
    if (!view)
        return view.error();
    const TraceInputs inputs = traceInputs(document);
    const Result<TraceScene> scene = TraceScene::build(inputs, session.job());
    if (!scene)
        return scene.error();
    if (const std::optional<std::string> limit = scene->limit(); limit && byPaths)
        session.report().warn(*limit);

    PathSettings paths;
    paths.maxBounces = options.maxBounces;
    paths.seed = options.seed;
    FilmTracerSettings settings;
    settings.samples = samplesOf(options);
    settings.unit = unitOf(options);
    if (options.noise)
        settings.noise = *options.noise / 100.0;
    settings.manifest = filmManifest(session, options, document, inputs, frame, settings.samples);
    settings.manifest.shard = *shard;
    if (!outputs->empty()) {
        settings.manifest.settings[kOutputsSetting] = namesOf(*outputs);
        settings.manifest.hasOutputs = needTraceOutputs(*outputs);
    }
    settings.checkpoint = run->checkpoint;
    settings.everySeconds = run->everySeconds;
    settings.resume = run->resume;
    settings.keepOnCancel = run->keepWhenInterrupted;
    settings.warn = [&](const Error& error) {
        session.report().warn(fmt::format(
            "no checkpoint could be kept, the picture goes on without: {}", error.text()));
    };
    FilmTracer tracer(std::move(settings));
    session.allowPartialResult();
    session.expectCheckpoint(run->checkpoint, run->keepWhenInterrupted);
    Result<WhittedPicture> whitted =
        WhittedPicture::prepare(*scene, *view, whittedSettings(options), *counts, session.job());
    if (!whitted)
        return whitted.error();
    const Result<void> traced = byPaths ? tracer.trace(*scene, *view, paths, session.job())
                                        : tracer.trace(whitted->pass(), session.job());
    if (tracer.keptCheckpoint())
        session.keptCheckpoint(run->checkpoint);
    if (!traced)
        return traced;
    const FilmManifest& manifest = tracer.manifest();
    if (!manifest.complete && manifest.samples == 0)
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    reportSamples(session, options, tracer);
    if (!byPaths)
        whitted->describe(session.report().json());
    if (Result<void> tree = showRayTree(session, options, document, *scene, *view, frame); !tree)
        return tree;

    const Result<void> written =
        isPart ? writeFilm(options.output, manifest, tracer.film(), tracer.outputs(),
                           StateFileName::OfUser)
               : writeTracedPicture(session, manifest, tracer.film(), tracer.outputs(),
                                    whitted->parts(), options.output, format);
    if (!written) {
        Error error = written.error();
        if (tracer.keepResult())
            error.message += fmt::format("; what was traced is kept in {}, from which --resume "
                                         "goes on",
                                         run->checkpoint.string());
        return error;
    }
    if (isPart) {
        session.report().json()["shard"] = {shard->index + 1, shard->count};
        session.report().output(options.output, fmt::format("part {} of {}, for patina merge",
                                                            shard->index + 1, shard->count));
    }
    if (reference != nullptr)
        if (Result<void> compared =
                reportError(session, options.errorAgainst, tracer.film().radiance(), *reference);
            !compared)
            return compared;
    // What is complete needs no checkpoint; neither does anybody need an older one.
    if (!session.interrupted())
        tracer.removeCheckpoint();
    return {};
}

} // namespace patina::cli
