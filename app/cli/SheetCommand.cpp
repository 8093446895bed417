// `patina sheet`: environments, materials, lighting modes, snapshots and values of a parameter
// beside each other.
#include "app/cli/Commands.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "app/cli/SheetAxes.h"
#include "app/cli/SheetCells.h"
#include "app/cli/TracingOptions.h"
#include "core/base/Limits.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/light/Light.h"
#include "core/sheet/SheetPictures.h"
#include "render/ViewRenderer.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace patina::cli {
namespace {

Result<ImageFileFormat> sheetFormat(const std::string& output) {
    Result<ImageFileFormat> format = imageFormatForPath(output);
    if (format && *format == ImageFileFormat::Hdr)
        return usageError(
            "a sheet is a displayed picture (.png, .jpg, .tif, .tga) or an .exr with a "
            "part for each cell; .hdr can be neither");
    return format;
}

// Environment by environment, so that one at a time is in memory; the result is in the order of
// `cells`.
Result<std::vector<sheet::DrawnCell>> drawCells(Session& session, const SheetOptions& options,
                                                SheetCells& source, const SheetWall& wall,
                                                const Document& document,
                                                const std::vector<WallCell>& cells) {
    std::vector<sheet::DrawnCell> drawn(cells.size());
    std::vector<Id> environments;
    for (const WallCell& cell : cells)
        if (std::ranges::find(environments, cell.cell.environment) == environments.end())
            environments.push_back(cell.cell.environment);
    const auto count = static_cast<double>(cells.size());
    std::size_t done = 0;
    session.beginPhase();
    if (isTraced(options))
        session.allowPartialResult();
    for (std::size_t e = 0; e < environments.size(); ++e) {
        const Id environment = environments[e];
        std::string of; // which, where there are several
        if (environments.size() > 1)
            of =
                fmt::format("{} ({} of {}): ", environmentTitle(*document.environment(environment)),
                            e + 1, environments.size());
        if (!isTraced(options)) // whose progress is that of all cells, and a signal ends it
            session.beginPhase();
        session.job().setActivity(of + "preparing light");
        if (Result<void> opened = source.open(environment); !opened)
            return opened.error();
        const auto file = wall.files.find(environment);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i].cell.environment != environment)
                continue;
            if (file != wall.files.end() && !file->second.problem.empty()) {
                drawn[i].problem = file->second.problem;
                continue;
            }
            if (session.job().cancelled())
                return cancelledError();
            const auto start = std::chrono::steady_clock::now();
            const auto before = static_cast<double>(done++);
            Result<sheet::DrawnCell> picture =
                source.draw(cells[i].cell, of, before / count, (before + 1.0) / count);
            if (!picture)
                return picture.error();
            drawn[i] = std::move(*picture);
            drawn[i].seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
        source.close(environment);
    }
    return drawn;
}

nlohmann::ordered_json describeAxis(const WallAxis& axis) {
    auto captions = nlohmann::ordered_json::array();
    for (const WallEntry& entry : axis.entries)
        captions.push_back(entry.caption);
    return {{"title", axis.title}, {"captions", std::move(captions)}};
}

// `sheet`: null where cells are parts.
void describeCells(nlohmann::ordered_json& json, const Wall& wall, const sheet::WallSheet* sheet,
                   const std::vector<WallCell>& cells, const std::vector<sheet::DrawnCell>& drawn,
                   const render::FrameSettings& frame) {
    json["columns"] = describeAxis(wall.columns);
    if (wall.isTable())
        json["rows"] = describeAxis(wall.rows);
    auto& list = json["cells"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        nlohmann::ordered_json cell{
            {"column", cells[i].column}, {"row", cells[i].row}, {"captions", cells[i].captions}};
        if (sheet != nullptr) {
            const glm::ivec2 place = sheet->place(cells[i]);
            cell["rectangle"] = {place.x, place.y, frame.width, frame.height};
        } else if (drawn[i].problem.empty()) {
            cell["part"] = drawn[i].part;
        }
        if (!drawn[i].problem.empty())
            cell["problem"] = drawn[i].problem;
        else
            cell["seconds"] = drawn[i].seconds;
        if (drawn[i].samples > 0)
            cell["samples"] = drawn[i].samples;
        if (drawn[i].noise)
            cell["noisePercent"] = 100.0 * *drawn[i].noise;
        list.push_back(std::move(cell));
    }
}

// How certain traced cells are.
void reportTracing(Report& report, const SheetOptions& options, const std::vector<WallCell>& cells,
                   const std::vector<sheet::DrawnCell>& drawn) {
    std::optional<double> least, most;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::optional<double>& noise = drawn[i].noise;
        if (!noise)
            continue;
        least = std::min(least.value_or(*noise), *noise);
        most = std::max(most.value_or(*noise), *noise);
        if (options.noise && 100.0 * *noise > *options.noise)
            report.warn(fmt::format("{}: ± {:.2f} % of the mean after {} {} per pixel: not yet the "
                                    "{:g} % that --noise asks for",
                                    fmt::join(cells[i].captions, ", "), 100.0 * *noise,
                                    drawn[i].samples, unitOf(options), *options.noise));
    }
    if (most)
        report.line(fmt::format("cells are certain to ± {:.2f} … {:.2f} % of their mean",
                                100.0 * *least, 100.0 * *most));
}

// Environments that were skipped, by their files.
void reportBroken(Report& report, const SheetWall& wall) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& [id, file] : wall.files) {
        if (file.problem.empty())
            continue;
        list.push_back({{"file", file.source}, {"problem", file.problem}});
        report.warn(fmt::format("{}: {}", file.source, file.problem));
    }
    report.json()["broken"] = std::move(list);
}

Result<void> checkSheet(const CommonOptions& common, const SheetOptions& options) {
    if (Result<void> tracing = checkTracing(options); !tracing)
        return tracing;
    if (!isTraced(options))
        return common.keepPartial
                   ? Result<void>(usageError("--keep-partial is for --renderer path and whitted"))
                   : Result<void>();
    if (!options.lightings.empty())
        return usageError("--lightings is for --renderer raster: rays bring the light of the whole "
                          "picture");
    return {};
}

// Title and subtitle of the sheet; nothing: there are to be none.
std::optional<sheet::WallSheetText> sheetText(const SheetOptions& options, const Wall& wall,
                                              const Document& document, std::uint32_t leastSamples,
                                              std::uint32_t mostSamples) {
    if (options.noCaptions)
        return std::nullopt;
    std::string common = sheet::commonText(wall, document);
    if (isTraced(options))
        common += "  ·  " + tracingText(options, leastSamples, mostSamples);
    return sheet::WallSheetText{sceneTitle(options.scene), std::move(common)};
}

// Traced cells may have fewer samples than they were to have at most.
Result<sheet::WallSheet> paperOf(const SheetOptions& options, const Wall& wall,
                                 const Document& document, const render::FrameSettings& frame,
                                 const std::vector<sheet::DrawnCell>& drawn) {
    std::uint32_t least = samplesOf(options), most = 0;
    for (const sheet::DrawnCell& cell : drawn) {
        if (cell.samples == 0)
            continue;
        least = std::min(least, cell.samples);
        most = std::max(most, cell.samples);
    }
    return sheet::WallSheet::create(
        wall, frame.width, frame.height,
        sheetText(options, wall, document, least, most > 0 ? most : least));
}

void describeTracing(nlohmann::ordered_json& settings, const SheetOptions& options) {
    settings["renderer"] = options.renderer;
    if (!isTraced(options))
        return;
    settings["samples"] = samplesOf(options);
    settings["seed"] = options.seed;
    if (isWhitted(options))
        settings["whitted"] = describeWhitted(whittedSettings(options));
    else if (options.maxBounces)
        settings["maxBounces"] = *options.maxBounces;
}

} // namespace

Result<void> run(Session& session, const SheetOptions& options) {
    if (Result<void> fits = checkSheet(session.options(), options); !fits)
        return fits;
    const Result<ImageFileFormat> format = sheetFormat(options.output);
    if (!format)
        return format.error();
    Result<render::FrameSettings> frame = frameSettings(options);
    if (!frame)
        return frame.error();
    if (Result<void> output = checkOutput(options.output); !output)
        return output;
    const bool linear = isLinearFormat(*format);
    frame->floats = linear;
    // As the editor shows cells at rest, on any driver.
    if (!isTraced(options) && frame->samples == render::ViewRenderer::kSteadyFrames) {
        frame->samples = 1;
        frame->accumulate = true;
    }

    if (!needsImageLibraries(options) && std::ranges::all_of(options.environments, isBuiltin))
        session.expectNoImages();
    nlohmann::ordered_json& json = session.report().json();
    json["settings"] = {{"scene", options.scene},
                        {"size", {frame->width, frame->height}},
                        {"samples", options.samples}};
    describeTracing(json["settings"], options);
    session.beginPhase();
    SceneRequest request{options.scene, options.environment,
                         options.environments.empty() ? options.environmentLayout : std::string(),
                         options.bakes};
    Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    if (Result<void> view = applyView(session, options, *document, *frame); !view)
        return view;
    Result<SheetWall> wall = makeSheetWall(session, options, *document);
    if (!wall)
        return wall.error();
    const std::vector<WallCell> cells = cellsOf(wall->wall);
    std::optional<sheet::WallSheet> paper;
    if (linear) {
        if (Result<void> fit = sheet::checkPartsFit(cells.size(), frame->width, frame->height);
            !fit)
            return fit;
    } else {
        Result<sheet::WallSheet> made = paperOf(options, wall->wall, *document, *frame, {});
        if (!made)
            return made.error();
        paper = std::move(*made);
    }
    warnOfStaleBakes(session, *document);
    for (const render::LightLimit& limit : render::lightLimits(*document))
        if (!isTraced(options)) // rays have other limits
            session.report().warn(limit.text);
    describeView(json["settings"], document->view);

    const SheetSource source{session, options, *document, *wall, request, *frame};
    const std::unique_ptr<SheetCells> pictures =
        isTraced(options) ? tracedCells(source) : drawnCells(source);
    if (Result<void> begun = pictures->begin(); !begun)
        return begun;
    Result<std::vector<sheet::DrawnCell>> drawn =
        drawCells(session, options, *pictures, *wall, *document, cells);
    if (!drawn)
        return drawn.error();
    reportBroken(session.report(), *wall);
    reportTracing(session.report(), options, cells, *drawn);
    if (std::ranges::all_of(*drawn,
                            [](const sheet::DrawnCell& cell) { return !cell.problem.empty(); }))
        return session.interrupted()
                   ? cancelledError()
                   : Error{ErrorKind::InputBroken, "none of the environments can be read", {}, {}};
    if (paper && isTraced(options)) {
        Result<sheet::WallSheet> made = paperOf(options, wall->wall, *document, *frame, *drawn);
        if (!made)
            return made.error();
        paper = std::move(*made);
    }

    std::vector<ImagePart> parts;
    if (paper)
        parts.push_back({{}, sheet::pictureOf(*paper, wall->wall, cells, *drawn), {}});
    else
        parts = sheet::partsOf(cells, *drawn);
    describeCells(json, wall->wall, paper ? &*paper : nullptr, cells, *drawn, *frame);
    if (session.job().cancelled())
        return cancelledError();
    return writePictures(session, options.output, std::move(parts), *format);
}

} // namespace patina::cli
