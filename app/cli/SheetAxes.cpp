#include "app/cli/SheetAxes.h"

#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/cells/WallAxes.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/library/Library.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;
using AxisKind = SheetOptions::AxisKind;

bool has(const SheetOptions& options, AxisKind kind) {
    return std::ranges::any_of(options.axes,
                               [&](const SheetOptions::Axis& axis) { return axis.kind == kind; });
}

// An environment of the scene by its name, or one that is read when its cells are drawn: the
// scene's with another image, as `patina render --environment` has it.
Result<Id> environmentNamed(const std::string& name, EnvironmentLayout layout, bool skipsBroken,
                            Document& document, SheetWall& result) {
    std::error_code ignored;
    const bool isFile = !isBuiltin(name) && fs::exists(name, ignored);
    if (!isFile && !isBuiltin(name))
        for (const Target& found : targetsNamed(document, Scope::Environment, name))
            return found.id;
    SheetWall::File file{normalizeSource(name), {}};
    if (!isFile && !isBuiltin(name)) {
        file.problem = "there is no such file, nor an environment of the scene with this name";
        if (!skipsBroken)
            return Error{ErrorKind::InputMissing,
                         file.problem + "; --skip-broken draws the others",
                         name,
                         {}};
    }
    Environment environment = document.environment();
    environment.name.clear();
    environment.kind = EnvironmentKind::Image;
    environment.source = file.source;
    environment.layout = layout;
    environment.image = environment.fileImage = nullptr;
    environment.problem.clear();
    const Id id = addEnvironment(document, std::move(environment));
    if (id == 0)
        return usageError(
            fmt::format("a scene holds at most {} environments, its own included; name "
                        "fewer",
                        kMaxEnvironments));
    result.files.emplace(id, std::move(file));
    return id;
}

Result<WallAxis> environments(const SheetOptions& options, Document& document, SheetWall& result) {
    const Result<EnvironmentLayout> layout = parseLayout(options.environmentLayout);
    if (!layout)
        return layout.error();
    std::vector<Id> ids;
    for (const std::string& name : options.environments) {
        const Result<Id> id = environmentNamed(name, *layout, options.skipBroken, document, result);
        if (!id)
            return id.error();
        ids.push_back(*id);
    }
    return environmentAxis(document, ids);
}

Result<WallAxis> materials(const SheetOptions& options, Document& document) {
    std::vector<Id> ids, meshes;
    for (const std::string& name : options.meshes) {
        const Result<ParameterSelection> named =
            selectParameter(document, fmt::format("mesh[{}].material", name));
        if (!named)
            return named.error();
        for (const Target& target : named->targets)
            meshes.push_back(target.id);
    }
    for (const std::string& name : options.materials) {
        const Result<Id> id = materialNamed(document, name);
        if (!id)
            return id.error();
        ids.push_back(*id);
    }
    return materialAxis(document, ids, meshes);
}

Result<WallAxis> lightings(const SheetOptions& options, const Document& document) {
    constexpr const char* kLighting = "view.lighting";
    Result<WallAxis> axis = choiceAxis(document, kLighting, options.lightings);
    if (!axis)
        return axis;
    for (const WallEntry& entry : axis->entries) {
        const Result<Document> shown = documentOf(document, entry.cell);
        if (!shown)
            return shown.error();
        if (Result<void> offered = checkOffered(*shown, kLighting); !offered)
            return offered.error();
    }
    return axis;
}

Result<WallAxis> snapshots(const SheetOptions& options, const Document& document) {
    const Result<std::vector<Id>> ids = snapshotsNamed(document, options.snapshots);
    if (!ids)
        return ids.error();
    return snapshotAxis(document, *ids);
}

Result<WallAxis> wedge(Session& session, const std::string& text, const Document& document) {
    const Result<Wedge> parsed = parseWedge(text);
    if (!parsed)
        return parsed.error();
    Result<WallAxis> axis = wedgeAxis(document, *parsed);
    if (axis)
        warnIfIdle(session, document, "--wedge", parsed->parameter);
    return axis;
}

// --environment and --lighting would have no say.
Result<void> checkConflicts(const SheetOptions& options) {
    if (options.axes.empty() || options.axes.size() > 2)
        return usageError("a sheet compares one or two things: --environments, --materials, "
                          "--lightings, --snapshots, --wedge (two wedges are two)");
    if (has(options, AxisKind::Environments) && !options.environment.empty())
        return usageError(
            "--environment has no effect beside --environments; leave one of them out");
    if (has(options, AxisKind::Lightings) && !options.lighting.empty())
        return usageError("--lighting has no effect beside --lightings; leave one of them out");
    if (options.columns > 0 && options.axes.size() == 2)
        return usageError(
            "--columns is for sheets of one thing; of two, the first makes the columns");
    return {};
}

} // namespace

Result<SheetWall> makeSheetWall(Session& session, const SheetOptions& options, Document& document) {
    if (Result<void> fine = checkConflicts(options); !fine)
        return fine.error();
    SheetWall result;
    std::vector<WallAxis> axes(options.axes.size());
    const auto make = [&](const SheetOptions::Axis& axis) -> Result<WallAxis> {
        switch (axis.kind) {
        case AxisKind::Environments:
            return environments(options, document, result);
        case AxisKind::Materials:
            return materials(options, document);
        case AxisKind::Lightings:
            return lightings(options, document);
        case AxisKind::Snapshots:
            return snapshots(options, document);
        case AxisKind::Wedge:
            break;
        }
        return wedge(session, axis.wedge, document);
    };
    // Wedges last: "material.metallic" is of the built-in materials, too.
    for (const bool wedges : {false, true})
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if ((options.axes[i].kind == AxisKind::Wedge) != wedges)
                continue;
            Result<WallAxis> made = make(options.axes[i]);
            if (!made)
                return made.error();
            axes[i] = std::move(*made);
        }
    Result<Wall> wall = makeWall(std::move(axes), static_cast<std::size_t>(options.columns));
    if (!wall)
        return wall.error();
    result.wall = std::move(*wall);
    return result;
}

std::string sceneTitle(const std::string& scene) {
    if (!isBuiltin(scene))
        return fs::path(scene).stem().string();
    const std::string name = builtinName(scene);
    const auto& models = library::models();
    const auto found = std::ranges::find(models, name, &library::Entry::name);
    return found != models.end() ? found->title : name;
}

} // namespace patina::cli
