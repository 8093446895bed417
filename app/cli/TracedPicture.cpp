#include "app/cli/TracedPicture.h"

#include "app/cli/ErrorAgainst.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/base/FileLock.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"
#include "core/trace/file/FilmMerge.h"
#include "core/trace/file/OutputImages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <unistd.h>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

// OpenColorIO's names are of no use to pictures that only the CPU has.
bool decidesDisplay(const ParameterInfo& info) {
    return info.scope == Scope::View && info.type != ParameterType::Text &&
           (info.group == "Exposure" || info.group == "Tone curve" || info.group == "Display");
}

Result<View> displayOf(const StateSettings& settings) {
    Document document;
    for (const auto& [name, text] : settings) {
        const ParameterInfo* info = findParameter(name);
        const Error unknown{ErrorKind::InputBroken,
                            fmt::format("the part asks for {} = {}, which this Patina does not "
                                        "have; render it anew",
                                        name, text),
                            {},
                            {}};
        if (info == nullptr || !decidesDisplay(*info))
            return unknown;
        const Result<ParameterValue> value = parseParameterValue(*info, text);
        if (!value)
            return unknown;
        info->set(document, 0, *value);
    }
    return document.view;
}

// What a pixel has several of.
const char* unitOfSamples(const FilmManifest& manifest) {
    return manifest.settings.contains("renderer") ? "samples" : "paths";
}

// What the picture is of, and how it was traced.
std::map<std::string, std::string> headerOf(const FilmManifest& manifest) {
    std::map<std::string, std::string> header =
        attributesOf({manifest.inputs, manifest.settings.at(kCameraSetting),
                      manifest.settings.at(kBackgroundSetting)});
    const auto renderer = manifest.settings.find("renderer");
    header["patina:renderer"] = renderer != manifest.settings.end() ? renderer->second : "path";
    for (const auto& [name, value] : manifest.settings)
        if (name != "renderer" && name != kCameraSetting && name != kBackgroundSetting &&
            name != kOutputsSetting)
            header["patina:render." + name] = value;
    header["patina:render.samplesDone"] = std::to_string(manifest.samples);
    return header;
}

// One part for each output that was asked for.
Result<std::vector<ImagePart>> outputParts(const FilmManifest& manifest, const Film& film,
                                           const TraceOutputs& outputs, const std::string& names) {
    const Result<std::vector<const OutputInfo*>> chosen = parseOutputs(names);
    if (!chosen || needTraceOutputs(*chosen) != manifest.hasOutputs)
        return Error{ErrorKind::InputBroken,
                     fmt::format("the part asks for outputs that this Patina does not have ({}); "
                                 "render it anew",
                                 names),
                     {},
                     {}};
    std::vector<ImagePart> parts;
    for (const OutputInfo* info : *chosen) {
        ImagePart part;
        part.name = info->id;
        part.image = outputImage(info->kind, film, outputs, manifest.camera, manifest.transparent);
        part.attributes["patina:view"] = info->label;
        if (!info->unit.empty())
            part.attributes["patina:units"] = info->unit;
        parts.push_back(std::move(part));
    }
    return parts;
}

Result<std::vector<ImagePart>> picturesOf(const FilmManifest& manifest, const Film& film,
                                          const TraceOutputs& outputs, ImageFileFormat format) {
    if (const auto names = manifest.settings.find(kOutputsSetting);
        names != manifest.settings.end() && format == ImageFileFormat::Exr)
        return outputParts(manifest, film, outputs, names->second);
    std::vector<ImagePart> parts(1);
    Image radiance = film.radiance(manifest.transparent);
    if (isLinearFormat(format)) {
        parts[0].image = std::move(radiance);
        return parts;
    }
    const Result<View> view = displayOf(manifest.display);
    if (!view)
        return view.error();
    Result<Image> shown = displayedPicture(radiance, *view, luminanceOf(radiance));
    if (!shown)
        return shown.error();
    parts[0].image = *std::move(shown);
    return parts;
}

} // namespace

StateSettings displaySettings(const Document& document) {
    StateSettings settings;
    for (const ParameterInfo& info : parameters())
        if (decidesDisplay(info))
            settings[std::string(info.id)] = formatParameterValue(info, info.get(document, 0));
    return settings;
}

std::string cameraText(const Camera& camera) {
    const std::string lens =
        camera.lens.depthOfField
            ? fmt::format(", f/{} in focus at {} m", camera.lens.fStop, camera.lens.focusDistance)
            : std::string();
    return fmt::format("{},{},{} at {},{},{}, {}°{}", camera.yawDeg, camera.pitchDeg,
                       camera.distance, camera.target.x, camera.target.y, camera.target.z,
                       camera.fovDeg, lens);
}

std::string backgroundText(const View& view) {
    switch (view.background) {
    case BackgroundMode::Environment:
        return "visible";
    case BackgroundMode::Blurred:
        return fmt::format("blurred by {}", view.backgroundBlur);
    case BackgroundMode::Color:
        return fmt::format("{},{},{}", view.backgroundColor.r, view.backgroundColor.g,
                           view.backgroundColor.b);
    case BackgroundMode::Off:
        break;
    }
    return "transparent";
}

Result<void> checkDisplay(const View& view, ImageFileFormat format) {
    if (isLinearFormat(format) || view.toneMap != ToneMap::OpenColorIo)
        return {};
    return usageError("traced pictures are not shown through OpenColorIO; write a linear .exr, or "
                      "choose another --tone-map");
}

Result<void> writeTracedPicture(Session& session, const FilmManifest& manifest, const Film& film,
                                const TraceOutputs& outputs, std::vector<ImagePart> more,
                                const std::string& output, ImageFileFormat format) {
    Result<std::vector<ImagePart>> pictures = picturesOf(manifest, film, outputs, format);
    if (!pictures)
        return pictures.error();
    if (!more.empty()) {
        pictures->front().name = "beauty";
        std::ranges::move(more, std::back_inserter(*pictures));
    }
    if (format == ImageFileFormat::Exr)
        for (ImagePart& picture : *pictures)
            picture.attributes.merge(headerOf(manifest));
    const Result<void> written = writePictures(session, output, *pictures, format);
    if (written ||
        (written.error().kind != ErrorKind::Io && written.error().kind != ErrorKind::CannotCreate))
        return written;
    std::error_code none;
    const fs::path kept =
        fs::temp_directory_path(none) /
        fmt::format("patina-{}-{}", ::getpid(), fs::path(output).filename().string());
    if (none || !writePictures(session, kept, *std::move(pictures), format))
        return written;
    Error error = written.error();
    error.message += fmt::format("; the picture is kept in {}", kept.string());
    return error;
}

Result<void> mergeFilms(Session& session, const MergeOptions& options) {
    nlohmann::ordered_json& json = session.report().json();
    if (!options.scene.empty())
        return usageError("--scene is for parts of bakes: those of pictures need no scene");
    const Result<ImageFileFormat> format = imageFormatForPath(options.output);
    if (!format)
        return format.error();
    if (Result<void> output = checkOutput(options.output); !output)
        return output;
    const Result<FileLock> lock = FileLock::take(options.output);
    if (!lock)
        return lock.error();
    session.beginPhase();
    const std::vector<fs::path> files(options.parts.begin(), options.parts.end());
    const Result<JoinedFilm> joined = joinFilms(files);
    if (!joined)
        return joined.error();
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    json["settings"]["scene"] = joined->manifest.scene;
    json["settings"]["samples"] = joined->manifest.samples;
    if (const std::optional<double> noise = joined->film.noise()) {
        json["noisePercent"] = 100.0 * *noise;
        session.report().line(fmt::format("{} {} per pixel, ± {:.2f} % of the mean",
                                          joined->manifest.samples, unitOfSamples(joined->manifest),
                                          100.0 * *noise));
    }
    return writeTracedPicture(session, joined->manifest, joined->film, joined->outputs, {},
                              options.output, *format);
}

Result<void> describeUnfinishedPicture(Report& report, const std::string& file) {
    const Result<FilmManifest> manifest = readFilmManifest(file);
    if (!manifest)
        return manifest.error();
    const FilmManifest& m = *manifest;
    nlohmann::ordered_json json = {{"size", {m.width, m.height}},
                                   {"shard", {{"part", m.shard.index + 1}, {"of", m.shard.count}}},
                                   {"complete", m.complete},
                                   {"done", m.done},
                                   {"samplesDone", m.samples},
                                   {"scene", m.scene},
                                   {"sets", m.sets},
                                   {"settings", m.settings},
                                   {"display", m.display}};
    std::vector<std::pair<std::string, std::string>> rows = {
        {"kind", m.complete ? "part of a traced picture, complete"
                            : "checkpoint of a traced picture, unfinished"},
        {"size", fmt::format("{} × {} pixels", m.width, m.height)},
        {"part", m.shard.count == 1 ? "1 of 1, the whole picture"
                                    : fmt::format("{} of {}", m.shard.index + 1, m.shard.count)},
        {"done", fmt::format("{:.0f} % of its {}; every pixel has {} or more",
                             std::floor(100.0 * m.done), unitOfSamples(m), m.samples)},
        {"scene", m.scene}};
    if (!m.sets.empty())
        rows.emplace_back("with", fmt::format("{}", fmt::join(m.sets, ", ")));
    rows.emplace_back("goes on with", m.complete ? "patina merge, with the other parts"
                                                 : "the command that began it, and --resume");
    report.table({}, rows);
    rows.assign(m.settings.begin(), m.settings.end());
    report.table("Settings", rows);
    rows.assign(m.display.begin(), m.display.end());
    report.table("Display", rows);
    report.json()["kind"] = m.complete ? "part" : "checkpoint";
    report.json()["picture"] = std::move(json);
    return {};
}

} // namespace patina::cli
