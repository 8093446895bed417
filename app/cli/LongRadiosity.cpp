#include "app/cli/LongRadiosity.h"

#include "app/cli/BakeRadiosity.h"
#include "app/cli/CommandLine.h"
#include "app/cli/LongBake.h"
#include "app/cli/LongRun.h"
#include "app/cli/Report.h"
#include "core/radiosity/file/RadiosityMerge.h"
#include "core/radiosity/file/ResumableRadiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <variant>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;
using namespace radiosity;

constexpr std::string_view kGiven = "yes"; // the value of a flag

// Options that a solution depends on, by their names.
StateSettings solvedBy(const BakeRadiosityOptions& options, const RadiositySettings& settings) {
    StateSettings result = {{"form-factors", std::string(name(settings.factors.method))},
                            {"resolution", std::to_string(settings.factors.resolution)},
                            {"samples", std::to_string(settings.lightSamples)},
                            {"seed", std::to_string(settings.factors.seed)},
                            {"solver", std::string(name(settings.solve.solver))},
                            {"residual", fmt::format("{}", settings.solve.residual)}};
    if (hasStands(settings.factors.method))
        result["stands"] = std::to_string(settings.factors.stands);
    if (options.device == HemicubeDevice::Gpu) // at the edges of cells it rounds otherwise
        result["device"] = "gpu";
    if (!options.subdivide.empty())
        result["subdivide"] = options.subdivide;
    if (settings.divideBy != DivisionRule::Gradient)
        result["divide-by"] = std::string(name(settings.divideBy));
    if (settings.patchArea > 0.0)
        result["patches"] = fmt::format("{}", settings.patchArea);
    if (settings.classic)
        result["classic"] = kGiven;
    if (settings.solve.maxIterations > 0)
        result["iterations"] = std::to_string(settings.solve.maxIterations);
    if (settings.solve.shotsPerStep > 1)
        result["shots-per-step"] = std::to_string(settings.solve.shotsPerStep);
    return result;
}

// What else was asked for.
StateSettings writtenWith(const BakeRadiosityOptions& options, const RadiositySettings& settings) {
    StateSettings result = {{"max-elements", std::to_string(settings.maxElements)}};
    if (options.outputEvery)
        result["output-every"] = std::to_string(*options.outputEvery);
    if (!options.environment.empty())
        result["environment"] = environmentFromAnywhere(options.environment);
    if (!options.environmentLayout.empty())
        result["environment-layout"] = options.environmentLayout;
    if (!options.exposure.empty())
        result["exposure"] = options.exposure;
    if (options.estimateDiscretisation)
        result["estimate-discretisation"] = kGiven;
    if (options.findLeaks)
        result["find-leaks"] = kGiven;
    if (options.target == BakeTarget::Texel)
        result["target"] = "texel";
    if (options.size)
        result["size"] = *options.size;
    if (options.camera)
        result["camera"] = *options.camera;
    if (options.look)
        result["look"] = *options.look == Look::Smooth     ? "smooth"
                         : *options.look == Look::Elements ? "elements"
                                                           : "gathered";
    return result;
}

// The command that a part is of, from here on into `output`.
Result<BakeRadiosityOptions> optionsOf(const RadiosityPart& part, const std::string& scene,
                                       const std::string& output) {
    constexpr std::array<std::string_view, 25> kNames = {"form-factors",
                                                         "resolution",
                                                         "device",
                                                         "stands",
                                                         "samples",
                                                         "seed",
                                                         "solver",
                                                         "residual",
                                                         "subdivide",
                                                         "divide-by",
                                                         "patches",
                                                         "classic",
                                                         "iterations",
                                                         "output-every",
                                                         "shots-per-step",
                                                         "max-elements",
                                                         "environment",
                                                         "environment-layout",
                                                         "exposure",
                                                         "estimate-discretisation",
                                                         "find-leaks",
                                                         "target",
                                                         "size",
                                                         "camera",
                                                         "look"};
    const auto unknown = [&](const std::string& why) {
        return Error{ErrorKind::InputBroken,
                     fmt::format("the part asks for what this Patina does not have ({}); bake it "
                                 "anew",
                                 why),
                     part.file,
                     {}};
    };
    std::vector<std::string> words{"patina", "bake", "radiosity", scene, "-o", output};
    for (const StateSettings* settings : {&part.manifest.settings, &part.manifest.options})
        for (const auto& [option, value] : *settings) {
            if (std::ranges::find(kNames, option) == kNames.end())
                return unknown(option);
            const bool flag = option == "classic" || option == "estimate-discretisation" ||
                              option == "find-leaks";
            words.push_back(flag ? "--" + option : fmt::format("--{}={}", option, value));
        }
    std::vector<const char*> argv;
    for (const std::string& word : words)
        argv.push_back(word.c_str());
    const auto parsed = parseCommandLine(static_cast<int>(argv.size()), argv.data());
    if (!parsed)
        return unknown(parsed.error().message);
    const auto* invocation = std::get_if<Invocation>(&*parsed);
    const auto* options =
        invocation != nullptr ? std::get_if<BakeRadiosityOptions>(&invocation->options) : nullptr;
    return options != nullptr ? Result<BakeRadiosityOptions>(*options) : unknown("its options");
}

// What the options of a long run come to.
struct RadiosityPlan : LongRun {
    ElementShard shard;
    bool part = false;
};

Result<RadiosityPlan> planRadiosity(const CommonOptions& common,
                                    const BakeRadiosityOptions& options,
                                    const RadiositySettings& settings) {
    const LongBakeOptions& work = options.work;
    if (settings.solve.solver == Solver::Hierarchical) {
        for (const auto& [given, option] : std::array<std::pair<bool, const char*>, 3>{
                 {{!work.shard.empty(), "--shard"},
                  {!work.checkpoint.empty(), "--checkpoint"},
                  {work.resume, "--resume"}}})
            if (given)
                return usageError(fmt::format(
                    "{} keeps and splits rows of form factors, and --solver hierarchical has none: "
                    "its links follow from the light; leave it out, or choose another solver",
                    option));
        return RadiosityPlan{};
    }
    const Result<LongRun> run = planLongRun(options.output, work);
    if (!run)
        return run.error();
    RadiosityPlan plan{*run, {}, false};
    if (work.shard.empty())
        return plan;
    const Result<PassShard> shard = parseShard(work.shard, environmentVariable);
    if (!shard)
        return shard.error();
    plan.shard = {shard->index, shard->count};
    plan.part = true;
    if (common.keepPartial)
        return usageError("--keep-partial is for whole bakes; a part that is stopped goes on with "
                          "--checkpoint and --resume");
    if (settings.adaptive > 0.0)
        return usageError(fmt::format("--subdivide {} looks at the light of the whole scene, of "
                                      "which a part knows little; give the parts an area instead",
                                      settings.dynamic ? "dynamic" : "adaptive"));
    return plan;
}

RadiosityManifest radiosityManifest(const Session& session, const BakeRadiosityOptions& options,
                                    const RadiositySettings& settings,
                                    const RadiosityInputs& inputs, const ElementShard& shard) {
    RadiosityManifest manifest;
    manifest.settings = solvedBy(options, settings);
    manifest.options = writtenWith(options, settings);
    manifest.inputs = hashTraceInputs(inputs.traced);
    manifest.scene = absoluteSource(options.scene);
    manifest.sets = session.options().sets;
    manifest.shard = shard;
    return manifest;
}

Result<void> bakePart(Session& session, const BakeRadiosityOptions& options,
                      const RadiositySettings& settings, const RadiosityInputs& inputs,
                      const ElementShard& shard, ResumableRadiosity& keeper) {
    session.beginPhase();
    if (Result<void> found =
            RadiosityScene::findPart(inputs.traced, settings, shard, session.job(), keeper);
        !found)
        return found;
    keeper.finish(false);
    nlohmann::ordered_json& json = session.report().json();
    const std::size_t elements = keeper.state().light.size();
    json["counts"] = {{"elements", elements}, {"rows", shard.held(keeper.state().rows.size())}};
    json["shard"] = {shard.index + 1, shard.count};
    if (Result<void> written = keeper.writePart(options.output); !written)
        return written;
    session.report().output(options.output, fmt::format("part {} of {}, for patina merge",
                                                        shard.index + 1, shard.count));
    return {};
}

Result<void> bakeWhole(Session& session, const BakeRadiosityOptions& options,
                       const RadiositySettings& settings, RadiosityInputs& inputs,
                       ResumableRadiosity* keeper) {
    const Result<SolvedRadiosity> solved =
        solveRadiosity(session, options, settings, inputs, keeper);
    if (!solved)
        return solved.error();
    if (keeper != nullptr)
        keeper->finish(session.interrupted());
    return writeRadiositySolution(session, options, settings, inputs, *solved);
}

} // namespace

Result<void> bakeRadiosity(Session& session, const BakeRadiosityOptions& options,
                           const RadiositySettings& settings) {
    const Result<RadiosityPlan> plan = planRadiosity(session.options(), options, settings);
    if (!plan)
        return plan.error();
    if (Result<void> checked =
            plan->part ? checkOutput(options.output) : checkRadiosityFile(options);
        !checked)
        return checked;
    const Result<std::optional<FileLock>> lock =
        beginLongRun(session, *plan, options.output, "radiosity");
    if (!lock)
        return lock.error();
    reportRadiositySettings(session, options, settings);
    Result<RadiosityInputs> inputs = openRadiosityScene(session, options);
    if (!inputs)
        return inputs.error();
    if (settings.solve.solver == Solver::Hierarchical)
        return bakeWhole(session, options, settings, *inputs, nullptr);

    RadiosityKeeping keeping;
    keeping.manifest = radiosityManifest(session, options, settings, *inputs, plan->shard);
    keeping.checkpoint = plan->checkpoint;
    keeping.everySeconds = plan->everySeconds;
    keeping.resume = plan->resume;
    keeping.keepOnCancel = plan->keepWhenInterrupted;
    keeping.maxRowBytes = settings.solve.maxBytes;
    keeping.warn = [&](const Error& error) {
        session.report().warn(fmt::format(
            "no checkpoint could be kept, the radiosity goes on without: {}", error.text()));
    };
    ResumableRadiosity keeper(std::move(keeping));
    session.expectCheckpoint(plan->checkpoint, plan->keepWhenInterrupted);
    const Result<void> done =
        plan->part ? bakePart(session, options, settings, *inputs, plan->shard, keeper)
                   : bakeWhole(session, options, settings, *inputs, &keeper);
    if (const auto& from = keeper.resumedFrom())
        session.report().json()["resumedFrom"] = {
            {"lit", from->lit}, {"rows", from->rows}, {"iterations", from->iterations}};
    if (!done) {
        Error error = done.error();
        if (error.kind == ErrorKind::Cancelled)
            keeper.finish(true);
        else if ((error.kind == ErrorKind::Io || error.kind == ErrorKind::CannotCreate) &&
                 keeper.keepResult())
            error.message += fmt::format("; what was computed is kept in {}, from which --resume "
                                         "goes on",
                                         plan->checkpoint.string());
        if (keeper.keptCheckpoint())
            session.keptCheckpoint(plan->checkpoint);
        return error;
    }
    if (keeper.keptCheckpoint())
        session.keptCheckpoint(plan->checkpoint);
    // What is complete needs no checkpoint; neither does anybody need an older one.
    if (!session.interrupted())
        keeper.removeCheckpoint();
    return {};
}

Result<void> mergeRadiosity(Session& session, const MergeOptions& options) {
    const std::vector<fs::path> files(options.parts.begin(), options.parts.end());
    const Result<std::vector<RadiosityPart>> parts = readRadiosityParts(files);
    if (!parts)
        return parts.error();
    const RadiosityPart& first = parts->front();
    const std::string scene = options.scene.empty() ? first.manifest.scene : options.scene;
    const Result<BakeRadiosityOptions> bake = optionsOf(first, scene, options.output);
    if (!bake)
        return bake.error();
    const Result<RadiositySettings> settings = radiositySettingsOf(*bake);
    if (!settings)
        return settings.error();
    if (Result<void> file = checkRadiosityFile(*bake); !file)
        return file;
    const Result<FileLock> lock = FileLock::take(options.output);
    if (!lock)
        return lock.error();
    reportRadiositySettings(session, *bake, *settings);
    session.report().json()["settings"]["parts"] = options.parts;
    Result<RadiosityInputs> inputs = openRadiosityScene(session, *bake, first.manifest.sets);
    if (!inputs) {
        Error error = inputs.error();
        if (options.scene.empty())
            error.message += "; it is the scene of the parts: name it with --scene if it is "
                             "elsewhere now";
        return error;
    }
    // All rows are in the parts: nothing is drawn here, whatever device found them.
    JoinedRadiosity joined(*parts, absoluteSource(scene), hashTraceInputs(inputs->traced),
                           settings->solve.maxBytes);
    const Result<SolvedRadiosity> solved =
        solveRadiosity(session, *bake, *settings, *inputs, &joined);
    if (!solved)
        return solved.error();
    return writeRadiositySolution(session, *bake, *settings, *inputs, *solved);
}

Result<void> describeUnfinishedRadiosity(Report& report, const std::string& file) {
    const Result<RadiosityManifest> manifest = readRadiosityManifest(file);
    if (!manifest)
        return manifest.error();
    const RadiosityManifest& m = *manifest;
    const bool whole = m.shard.count == 1;
    // A part ends with its rows; a checkpoint is of what is still to be solved.
    const bool part = m.complete && m.steps == 0;
    const std::uint64_t held = m.shard.held(m.elementCount);
    nlohmann::ordered_json json = {{"elements", m.elementCount},
                                   {"shard", {{"part", m.shard.index + 1}, {"of", m.shard.count}}},
                                   {"complete", m.complete},
                                   {"lit", m.lit},
                                   {"rows", m.rows},
                                   {"shares", m.shares},
                                   {"divisions", m.divided.size()},
                                   {"iterations", m.iterations},
                                   {"residual", m.residual},
                                   {"scene", m.scene},
                                   {"sets", m.sets},
                                   {"settings", m.settings},
                                   {"options", m.options}};
    std::vector<std::pair<std::string, std::string>> rows = {
        {"kind", part ? "part of a radiosity, complete" : "checkpoint of a radiosity, unfinished"},
        {"elements", countText(m.elementCount)},
        {"part", whole ? "1 of 1, all elements"
                       : fmt::format("{} of {}, {} elements", m.shard.index + 1, m.shard.count,
                                     countText(held))},
        {"direct light", fmt::format("of {} elements", countText(m.lit))},
        {"form factors", fmt::format("{} rows, {} shares", countText(m.rows), countText(m.shares))},
        {"scene", m.scene}};
    if (!m.divided.empty())
        rows.emplace_back("divided", fmt::format("{} times where light changes{}", m.divided.size(),
                                                 m.divisionDone ? "" : ", not for the last time"));
    if (m.steps > 0)
        rows.emplace_back("solved", fmt::format("{} shots or sweeps, residual {:.2g}",
                                                countText(m.iterations), m.residual));
    if (!m.sets.empty())
        rows.emplace_back("with", fmt::format("{}", fmt::join(m.sets, ", ")));
    rows.emplace_back("goes on with", part ? "patina merge, with the other parts"
                                           : "the command that began it, and --resume");
    report.table({}, rows);
    rows.assign(m.settings.begin(), m.settings.end());
    report.table("Settings", rows);
    rows.assign(m.options.begin(), m.options.end());
    report.table("Options", rows);
    report.json()["kind"] = part ? "part" : "checkpoint";
    report.json()["radiosity"] = std::move(json);
    return {};
}

} // namespace patina::cli
