#include "app/cli/SceneSetup.h"

#include "core/bake/file/BakeIO.h"
#include "core/base/AtomicFile.h"
#include "core/base/LowerCase.h"
#include "core/document/SceneSource.h"
#include "core/document/Source.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightList.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/Scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

// NAME=VALUE at the first '=' behind the brackets, which may hold any name.
Result<std::pair<std::string, std::string>> splitAssignment(const std::string& text) {
    std::size_t from = 0;
    if (const std::size_t open = text.find('['); open < text.find('='))
        from = std::min(text.find("].", open), text.size());
    const std::size_t equals = text.find('=', from);
    if (equals == std::string::npos || equals == 0)
        return Error{ErrorKind::Usage,
                     fmt::format("--set wants NAME=VALUE, not \"{}\"; patina parameters lists the "
                                 "names",
                                 text),
                     {},
                     {}};
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

// No parameter of its own: the image of the second environment.
constexpr std::string_view kSecondImage = "environment.secondImage";

// To fade to, in an environment of its own where there is none; no image takes the second one out
// of the mix.
Result<void> setSecondImage(Session& session, Document& document, const std::string& source) {
    if (source.empty()) {
        fadeTo(document, 0);
        return {};
    }
    Environment environment;
    if (const Environment* existing = document.secondEnvironment())
        environment = *existing;
    if (Result<void> set =
            setEnvironment(session, environment, source, EnvironmentLayout::Automatic);
        !set)
        return set;
    if (Environment* existing = document.secondEnvironment()) {
        *existing = std::move(environment);
        return {};
    }
    const Id id = addEnvironment(document, std::move(environment));
    if (id == 0)
        return Error{ErrorKind::Usage,
                     fmt::format("a scene holds at most {} environments", kMaxEnvironments),
                     {},
                     {}};
    fadeTo(document, id);
    return {};
}

// As the editor's panels would.
Result<void> setAll(Document& document, const ParameterSelection& selection,
                    const ParameterValue& value) {
    for (const Target& target : selection.targets)
        for (const ParameterEdit& edit : editsFor(document, *selection.info, target, value))
            if (Result<Change> change = applyParameter(document, *edit.info, target, edit.value);
                !change)
                return change.error();
    return {};
}

Result<void> forEachEnvironment(Document& document, const ParameterSelection& selection,
                                const std::function<Result<void>(Environment&)>& set) {
    for (const Target& target : selection.targets)
        if (Result<void> done = set(*document.environment(target.id)); !done)
            return done;
    return {};
}

Result<void> setMap(Session& session, Document& document, const ParameterSelection& selection,
                    MapSlot slot) {
    if (slot.assigned()) {
        slot.source = normalizeSource(slot.source);
        Result<ImagePtr> image =
            loadMapImage(session.worker(), slot.source, selection.info->mapEncoding);
        if (!image)
            return image.error();
        slot.image = *image;
    }
    return setAll(document, selection, slot);
}

} // namespace

Result<void> setEnvironment(Session& session, Environment& environment, const std::string& source,
                            EnvironmentLayout layout) {
    std::vector<Notice> notices;
    const std::string normalized = normalizeSource(source);
    Result<ImagePtr> image =
        loadEnvironmentImage(session.worker(), normalized, notices, layout, session.job());
    if (!image)
        return image.error();
    for (const Notice& notice : notices)
        session.report().add(notice);
    environment.kind = EnvironmentKind::Image;
    environment.source = normalized;
    environment.layout = layout;
    environment.removedSources = 0;
    environment.image = environment.fileImage = *image;
    environment.problem.clear();
    return {};
}

std::string environmentName(const Environment& environment) {
    if (!environment.enabled)
        return std::string(kNoEnvironment);
    const ParameterInfo& kind = *findParameter("environment.kind");
    return environment.kind == EnvironmentKind::Image
               ? environment.source
               : std::string(kind.choices[static_cast<std::size_t>(environment.kind)]);
}

Result<void> setParameter(Session& session, Document& document, const std::string& name,
                          const std::string& value) {
    if (name == kSecondImage)
        return setSecondImage(session, document, value);
    Result<ParameterSelection> selection = selectParameter(document, name);
    if (!selection)
        return selection.error();
    Result<ParameterValue> parsed = parseParameterValue(*selection->info, value, document);
    if (!parsed)
        return parsed.error();
    if (const MapSlot* slot = std::get_if<MapSlot>(&*parsed)) {
        if (selection->info->scope != Scope::Environment)
            return setMap(session, document, *selection, *slot);
        return forEachEnvironment(document, *selection, [&](Environment& environment) {
            return setEnvironment(session, environment, slot->source, EnvironmentLayout::Automatic);
        });
    }
    // The file is read anew: what it shows depends on its layout.
    if (selection->info->id == "environment.layout")
        return forEachEnvironment(document, *selection, [&](Environment& environment) {
            const Environment before = environment;
            Result<void> set =
                setEnvironment(session, environment, before.source,
                               static_cast<EnvironmentLayout>(std::get<int>(*parsed)));
            // Something else goes on lighting the scene.
            if (before.kind != EnvironmentKind::Image) {
                environment.kind = before.kind;
                environment.image = before.image;
            }
            return set;
        });
    return setAll(document, *selection, *parsed);
}

void warnIfIdle(Session& session, const Document& document, std::string_view option,
                const std::string& name) {
    if (name == kSecondImage)
        return;
    const Result<ParameterSelection> selection = selectParameter(document, name);
    if (!selection)
        return;
    std::string_view why;
    for (const Target& target : selection->targets) {
        why = whyIdle(*selection->info, document, target.id);
        if (why.empty())
            return;
    }
    if (!why.empty())
        session.report().warn(fmt::format("{} {} has no effect: {}", option, name, why));
}

Result<void> checkOffered(const Document& document, const std::string& name) {
    if (name == kSecondImage)
        return {};
    const Result<ParameterSelection> selection = selectParameter(document, name);
    if (!selection)
        return selection.error();
    for (const Target& target : selection->targets) {
        const ParameterValue value = selection->info->get(document, target.id);
        if (const int* choice = std::get_if<int>(&value))
            if (std::string why = whyUnavailable(*selection->info, document, *choice);
                !why.empty()) {
                if (selection->info->id == "view.lighting")
                    why += "; compute one with \"patina bake prt\" and add it with --bake";
                return Error{ErrorKind::Usage, std::move(why), {}, {}};
            }
    }
    return {};
}

nlohmann::ordered_json lightsJson(const std::vector<LightName>& names) {
    auto list = nlohmann::ordered_json::array();
    for (const LightName& one : names)
        list.push_back({{"kind", one.kind == LightKind::Environment ? "environment"
                                 : one.kind == LightKind::Light     ? "light"
                                                                    : "glow"},
                        {"name", one.name}});
    return list;
}

Result<EnvironmentLayout> parseLayout(const std::string& name) {
    if (name.empty())
        return EnvironmentLayout::Automatic;
    if (const auto layout = layoutNamed(name))
        return *layout;
    return Error{ErrorKind::Usage,
                 fmt::format("there is no layout \"{}\"; layouts are lat-long, angular-map, "
                             "mirror-ball, horizontal-cross, vertical-cross, horizontal-strip, "
                             "vertical-strip and six-faces",
                             name),
                 {},
                 {}};
}

namespace {

// --set, maps first: putting one on raises its number to 1, and numbers given should win. The
// layout of an environment last: naming an image starts it anew, and what was given should win.
Result<void> applySets(Session& session, Document& document, const std::vector<std::string>& sets) {
    std::map<Id, EnvironmentRecipe> before;
    for (const Environment& environment : document.environments)
        before[environment.id] = environmentRecipe(environment);
    std::vector<std::pair<std::string, std::string>> assignments;
    for (const std::string& text : sets) {
        Result<std::pair<std::string, std::string>> assignment = splitAssignment(text);
        if (!assignment)
            return assignment.error();
        assignments.push_back(*assignment);
        session.report().json()["settings"]["set"][assignment->first] = assignment->second;
    }
    std::stable_partition(assignments.begin(), assignments.end(),
                          [](const auto& a) { return a.first.ends_with(".map"); });
    std::stable_partition(assignments.begin(), assignments.end(),
                          [](const auto& a) { return a.first != "environment.layout"; });
    // A second environment first of all: others are set in it.
    std::stable_partition(assignments.begin(), assignments.end(),
                          [](const auto& a) { return a.first == kSecondImage; });
    for (const auto& [name, value] : assignments)
        if (Result<void> set = setParameter(session, document, name, value); !set)
            return set.error();
    // Only now: a later assignment may be what makes a choice possible.
    for (const auto& [name, value] : assignments)
        if (Result<void> offered = checkOffered(document, name); !offered)
            return offered.error();
    for (const auto& [name, value] : assignments)
        warnIfIdle(session, document, "--set", name);
    for (Environment& environment : document.environments)
        if (environmentRecipe(environment) != before[environment.id])
            resolveEnvironment(environment, session.job());
    resolveBlend(document, session.job());
    return {};
}

} // namespace

Result<OpenedScene> openNamedScene(Session& session, const std::string& scene) {
    const std::string& title = session.options().visualScene;
    if (!title.empty() && (isBuiltin(scene) || !holdsVisualScenes(scene)))
        return Error{ErrorKind::Usage,
                     "--visual-scene chooses one of the scenes of a COLLADA file (.dae), which "
                     "this is not",
                     scene,
                     {}};
    return openScene(session.worker(), formatSceneSource({scene, title}), session.job());
}

Result<Document> openSceneFor(Session& session, SceneRequest& request) {
    Result<OpenedScene> opened = openNamedScene(session, request.scene);
    if (!opened)
        return opened.error();
    session.report().add(*opened);
    request.isProject = opened->isProject;
    request.cameras = opened->cameras;
    Document document = std::move(opened->document);

    const bool byName = !request.environment.empty() || !request.environmentLayout.empty();
    const std::vector<std::string>& sets = request.sets ? *request.sets : session.options().sets;
    const bool bySet = std::ranges::any_of(
        sets, [](const std::string& text) { return text.starts_with("environment"); });
    if (request.environment == kNoEnvironment) {
        if (!request.environmentLayout.empty())
            return Error{ErrorKind::Usage,
                         "--environment none has no layout; leave --environment-layout out",
                         {},
                         {}};
        document.environment().enabled = false;
    } else if (byName) {
        const Result<EnvironmentLayout> layout = parseLayout(request.environmentLayout);
        if (!layout)
            return layout.error();
        const std::string source =
            request.environment.empty() ? document.environment().source : request.environment;
        if (Result<void> set = setEnvironment(session, document.environment(), source, *layout);
            !set)
            return set.error();
        document.environment().enabled = true;
    } else if (request.ownLightAlone && !opened->isProject && !bySet &&
               hasLightOfItsOwn(document)) {
        document.environment().enabled = false;
    }

    if (Result<void> set = applySets(session, document, sets); !set)
        return set.error();

    for (const std::string& file : request.bakes) {
        Result<BakeArtifact> bake = loadBake(session.worker(), file, document);
        if (!bake)
            return bake.error();
        attachBake(document, std::make_shared<const BakeArtifact>(std::move(*bake)));
    }
    session.report().json()["lights"] = lightsJson(lightNames(document));
    return document;
}

Result<Document> openEnvironmentFor(Session& session, const std::string& source,
                                    const std::string& layoutName) {
    Document document;
    const Result<EnvironmentLayout> layout = parseLayout(layoutName);
    if (!layout)
        return layout.error();
    if (extensionOf(source) == ".patina") {
        if (!layoutName.empty())
            return Error{ErrorKind::Usage,
                         "a project stores the layout of its environment; --environment-layout is "
                         "for images",
                         source,
                         {}};
        Result<OpenedScene> opened = openScene(session.worker(), source, session.job());
        if (!opened)
            return opened.error();
        session.report().add(*opened);
        document.environments = opened->document.environments;
        document.mix = opened->document.mix;
        document.nextId = opened->document.nextId;
        document.model = opened->document.model;
        if (document.environment().kind == EnvironmentKind::Image &&
            !document.environment().problem.empty())
            return Error{ErrorKind::InputMissing,
                         "its environment cannot be read: " + document.environment().problem,
                         source,
                         {}};
    } else if (Result<void> set = setEnvironment(session, document.environment(), source, *layout);
               !set) {
        return set.error();
    }
    for (const std::string& text : session.options().sets)
        if (!text.starts_with("environment") && !text.starts_with("softbox") &&
            !text.starts_with("model."))
            return Error{ErrorKind::Usage,
                         fmt::format("\"{}\" changes nothing here; set parameters of environment, "
                                     "softbox and model",
                                     text),
                         {},
                         {}};
    if (Result<void> set = applySets(session, document, session.options().sets); !set)
        return set.error();
    return document;
}

Result<void> checkOutput(const fs::path& output) {
    const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
    std::error_code ignored;
    const auto refuse = [&](const char* why) {
        return Error{ErrorKind::CannotCreate, why, output, {}};
    };
    if (fs::is_directory(output, ignored))
        return refuse("this is a folder; name a file in it");
    if (!fs::is_directory(folder, ignored))
        return refuse("its folder does not exist; create it first");
    const long longest = ::pathconf(folder.c_str(), _PC_NAME_MAX);
    if (const std::size_t bytes = output.filename().native().size();
        longest > 0 && bytes > static_cast<std::size_t>(longest))
        return Error{ErrorKind::CannotCreate,
                     fmt::format("its name has {} bytes, and its folder takes {} at most; choose a "
                                 "shorter one",
                                 bytes, longest),
                     output,
                     {}};
    if (::access(folder.c_str(), W_OK) != 0 && !fs::exists(output, ignored))
        return refuse("its folder is not writable; choose another one");
    return {};
}

} // namespace patina::cli
