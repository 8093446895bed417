#include "core/cells/WallPlan.h"

#include "core/cells/WallAxes.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace patina {
namespace {

constexpr const char *kLighting = "view.lighting", *kToneCurve = "view.toneMap";
constexpr int kDefaultValues = 5;

Error planError(std::string message) {
    return {ErrorKind::Usage, std::move(message), {}, {}};
}

const char* parameterOf(Compared compared) {
    return compared == Compared::LightingModes ? kLighting : kToneCurve;
}

void addChoices(std::vector<AxisChoice>& choices, const Document& document, const char* name) {
    const ParameterInfo& info = *findParameter(name);
    for (std::size_t i = 0; i < info.choiceLabels.size(); ++i)
        choices.push_back({static_cast<Id>(i), std::string(info.choiceLabels[i]),
                           whyUnavailable(info, document, static_cast<int>(i)), false});
}

// Every element that the values are set in.
std::vector<Target> targetsOf(const Document& document, const AxisPlan& plan) {
    const Scope scope = plan.target.scope;
    if (plan.target.id != 0 || (scope != Scope::Material && scope != Scope::Light &&
                                scope != Scope::Mesh && scope != Scope::Softbox))
        return {plan.target};
    std::vector<Target> targets;
    if (scope == Scope::Material)
        for (const Material& material : document.materials)
            targets.push_back({scope, material.id});
    if (scope == Scope::Light)
        for (const Light& light : document.lights)
            targets.push_back({scope, light.id});
    if (scope == Scope::Mesh)
        for (const MeshInstance& mesh : document.meshes)
            targets.push_back({scope, mesh.id});
    return targets;
}

Result<WallAxis> valuesOf(const Document& document, const AxisPlan& plan) {
    if (plan.info == nullptr)
        return planError("no parameter is chosen for the values of the wall; choose one");
    std::vector<Target> targets = targetsOf(document, plan);
    std::erase_if(targets, [&](const Target& target) { return !targetExists(document, target); });
    if (targets.empty())
        return planError(fmt::format("{} cannot be compared: its {} is no longer in the scene; "
                                     "choose another parameter",
                                     plan.info->label, scopeName(plan.target.scope)));
    return valueAxis(document, *plan.info, targets, plan.from, plan.to, plan.count,
                     plan.target.id != 0);
}

Result<WallAxis> axisOf(const Document& document, const AxisPlan& plan, std::size_t most) {
    if (plan.compared == Compared::Values)
        return valuesOf(document, plan);
    std::vector<Id> ids;
    for (const AxisChoice& choice : choicesOf(document, plan, most))
        if (choice.shown)
            ids.push_back(choice.id);
    if (plan.compared == Compared::Environments)
        return environmentAxis(document, ids);
    if (plan.compared == Compared::Snapshots) {
        if (document.snapshots.empty())
            return planError("the scene has no snapshots any more; keep one (Edit menu), or "
                             "choose something else to compare");
        return snapshotAxis(document, ids);
    }
    if (plan.compared == Compared::Materials) {
        // Those that are left; all visible meshes were not meant where none is.
        std::vector<Id> meshes = plan.meshes;
        std::erase_if(meshes, [&](Id id) { return document.mesh(id) == nullptr; });
        if (meshes.empty() && !plan.meshes.empty())
            return planError("the mesh that materials are compared on is no longer in the scene; "
                             "choose what to compare again");
        return materialAxis(document, ids, meshes);
    }
    const ParameterInfo& info = *findParameter(parameterOf(plan.compared));
    std::vector<std::string> names;
    for (const Id id : ids)
        names.emplace_back(info.choices[static_cast<std::size_t>(id)]);
    return choiceAxis(document, info.id, names);
}

} // namespace

AxisPlan valuesPlan(const ParameterInfo& info, Target target) {
    AxisPlan plan;
    plan.compared = Compared::Values;
    plan.info = &info;
    plan.target = target;
    plan.from = std::max(info.softMin, info.hardMin);
    plan.to = std::min(info.softMax, info.hardMax);
    plan.count = kDefaultValues;
    return plan;
}

WallPlan defaultWallPlan(const Document& document) {
    std::vector<AxisPlan> axes;
    if (document.environments.size() > 1)
        axes.emplace_back().compared = Compared::Environments;
    if (document.materials.size() > 1)
        axes.emplace_back().compared = Compared::Materials;
    if (axes.empty())
        axes.push_back(
            valuesPlan(*findParameter("material.perceptualRoughness"), {Scope::Material, 0}));
    WallPlan plan;
    plan.columns = axes.front();
    if (axes.size() > 1)
        plan.rows = axes.back();
    return plan;
}

std::vector<AxisChoice> choicesOf(const Document& document, const AxisPlan& plan,
                                  std::size_t most) {
    std::vector<AxisChoice> choices;
    switch (plan.compared) {
    case Compared::Environments:
        for (const Environment& environment : document.environments)
            choices.push_back({environment.id, environmentTitle(environment), {}, false});
        break;
    case Compared::Materials:
        for (const Material& material : document.materials)
            choices.push_back({material.id, material.name, {}, false});
        break;
    case Compared::Snapshots:
        for (const Snapshot& snapshot : document.snapshots)
            choices.push_back({snapshot.id, snapshot.name, {}, false});
        break;
    case Compared::LightingModes:
    case Compared::ToneCurves:
        addChoices(choices, document, parameterOf(plan.compared));
        break;
    case Compared::Nothing:
    case Compared::Values:
        break;
    }
    for (AxisChoice& choice : choices) {
        choice.shown = most > 0 && choice.whyNot.empty() &&
                       std::ranges::find(plan.hidden, choice.id) == plan.hidden.end();
        most -= choice.shown ? 1 : 0;
    }
    return choices;
}

std::size_t mostOnAxis(const WallPlan& plan) {
    const bool table =
        plan.columns.compared != Compared::Nothing && plan.rows.compared != Compared::Nothing;
    return table ? kMostOnWallSide : kMostOnWallSide * kMostOnWallSide;
}

Result<Wall> planWall(const Document& document, const WallPlan& plan) {
    std::vector<WallAxis> axes;
    for (const AxisPlan* axis : {&plan.columns, &plan.rows}) {
        if (axis->compared == Compared::Nothing)
            continue;
        Result<WallAxis> made = axisOf(document, *axis, mostOnAxis(plan));
        if (!made)
            return made.error();
        axes.push_back(std::move(*made));
    }
    // Rows alone stand below each other, as far as they can.
    const bool column = axes.size() == 1 && plan.columns.compared == Compared::Nothing &&
                        axes.front().entries.size() <= kMostOnWallSide;
    return makeWall(std::move(axes), column ? 1 : 0);
}

} // namespace patina
