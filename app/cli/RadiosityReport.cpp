#include "app/cli/RadiosityReport.h"

#include "core/radiosity/HemicubeDrawer.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina::cli {

using namespace radiosity;

namespace {

// Beyond the light that it is about a bound says nothing.
bool isUseful(const ErrorBound& bound, double meanRadiosity) {
    return bound.total().value_or(bound.solving) <= meanRadiosity;
}

// How far any element's bounced light may be from the exact one of these elements and their direct
// light, whose own noise (of --samples) no bound tells.
void reportBound(const SolveReport& solved, nlohmann::ordered_json& json,
                 std::vector<std::pair<std::string, std::string>>& rows) {
    json["meanRadiosity"] = solved.meanRadiosity;
    if (!solved.bound) {
        json["errorBound"] = nullptr;
        rows.emplace_back("Error of bounces", "no bound: a surface reflects all light");
        return;
    }
    const ErrorBound& bound = *solved.bound;
    const auto orNull = [](const std::optional<double>& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
    };
    json["errorBound"] = {{"total", orNull(bound.total())},
                          {"solving", bound.solving},
                          {"sampling", orNull(bound.sampling)},
                          {"confidence", ErrorBound::kConfidence},
                          {"of", "bounces"},
                          {"useful", isUseful(bound, solved.meanRadiosity)}};
    const auto percent = [&](double value) {
        return fmt::format("{:.2g} %", 100.0 * value / std::max(solved.meanRadiosity, 1e-300));
    };
    rows.emplace_back(
        "Error of bounces",
        bound.sampling
            ? fmt::format(
                  "at most {:.2g} W/m², {} of the mean radiosity ({:g} % confidence): {} unsolved, "
                  "{} by the rays of the form factors",
                  *bound.total(), percent(*bound.total()), 100.0 * ErrorBound::kConfidence,
                  percent(bound.solving), percent(*bound.sampling))
            : fmt::format(
                  "at most {:.2g} W/m², {} of the mean radiosity, for what is unsolved; that of "
                  "the form factors is not known",
                  bound.solving, percent(bound.solving)));
    if (!isUseful(bound, solved.meanRadiosity))
        rows.back().second +=
            "; no useful bound, as it is above the mean itself: raise --resolution";
}

// What found the form factors, and where: " by raycast on the CPU".
std::string factorsBy(const BakeRadiosityOptions& options, const RadiositySettings& settings) {
    if (settings.solve.solver == Solver::Hierarchical)
        return {};
    const std::string device = settings.factors.drawer ? settings.factors.drawer->name()
                               : options.device == HemicubeDevice::Gpu
                                   ? "the graphics cards of the parts"
                                   : "the CPU";
    return fmt::format(", by {} on {}", name(settings.factors.method), device);
}

} // namespace

void reportRadiosity(Report& report, const BakeRadiosityOptions& options,
                     const RadiositySettings& settings, const RadiosityScene& scene,
                     const radiosity::SolveReport& solved) {
    nlohmann::ordered_json& json = report.json();
    json["counts"] = {{"elements", scene.elements().size()},
                      {"faces", scene.elements().faces().size()}};
    json["iterations"] = solved.iterations;
    json["residual"] = solved.residual;
    json["converged"] = solved.converged;
    json["factorBytes"] = solved.factorBytes;
    if (!solved.links) {
        json["counts"]["factorRows"] = solved.rows;
        json["counts"]["factors"] = solved.shares;
    }
    const Patches& patches = scene.elements().patches();
    if (!patches.empty())
        json["counts"]["patches"] = patches.size();
    std::vector<std::pair<std::string, std::string>> rows{
        {"Elements", patches.empty() ? countText(scene.elements().size())
                                     : fmt::format("{}, in {} patches that shoot",
                                                   countText(scene.elements().size()),
                                                   countText(patches.size()))},
        {"Iterations", countText(solved.iterations)},
        {"Residual", fmt::format("{:.2g}{}", solved.residual,
                                 solved.converged ? "" : ", stopped before it was reached")},
        {"Form factors", solved.links
                             ? bytesText(solved.factorBytes)
                             : fmt::format("{}{}: {} in {} rows", bytesText(solved.factorBytes),
                                           factorsBy(options, settings), countText(solved.shares),
                                           countText(solved.rows))}};
    if (solved.quality) {
        json["formFactors"] = {{"closure", solved.quality->closure},
                               {"reciprocity", solved.quality->reciprocity},
                               {"escaped", solved.quality->escaped},
                               {"absorbed", solved.quality->absorbed}};
        rows.emplace_back("Escapes from the scene",
                          fmt::format("{:.1f} %", 100.0 * solved.quality->escaped));
    }
    if (solved.links) {
        json["links"] = {{"first", solved.links->first},
                         {"last", solved.links->last},
                         {"treeBytes", solved.links->treeBytes}};
        rows.emplace_back("Links",
                          fmt::format("{}, {} to begin with; clusters take {}",
                                      countText(solved.links->last), countText(solved.links->first),
                                      bytesText(solved.links->treeBytes)));
    }
    if (solved.energy) {
        json["energy"] = {{"emitted", solved.energy->emitted},
                          {"absorbed", solved.energy->absorbed},
                          {"escaped", solved.energy->lost},
                          {"unshot", solved.energy->unshot}};
        rows.emplace_back("Escapes from the scene",
                          fmt::format("{:.1f} %", 100.0 * solved.energy->lost /
                                                      std::max(solved.energy->emitted, 1e-300)));
    }
    reportBound(solved, json, rows);
    report.table({}, rows);
    if (scene.lit().clamped > 0)
        report.warn(fmt::format("{} elements reflect all light or more; they are taken to reflect "
                                "{:.1f} %, so that it dies out",
                                scene.lit().clamped, 100.0 * ElementSurfaces::kMaxReflectance));
}

} // namespace patina::cli
