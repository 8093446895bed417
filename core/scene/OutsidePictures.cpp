#include "core/scene/OutsidePictures.h"

#include "core/document/SceneSource.h"
#include "core/document/Snapshot.h"
#include "core/document/Source.h"
#include "core/edit/Parameters.h"
#include "core/io/TexturePaths.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace patina {
namespace {

void addOnce(std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end())
        list.push_back(text);
}

bool isLeftOut(const MapSlot& slot) {
    return slot.image == nullptr &&
           (slot.problem == kOutsideProblem || slot.problem == kOutsideProjectProblem);
}

// Calls visit(slot) for each map of each material, of snapshots, too.
template <class Visit>
void forEachSlot(const Document& document, const Visit& visit) {
    const auto visitAll = [&](const Material& material) {
        for (const MaterialInputInfo& input : kMaterialInputs)
            visit(material, material.*input.map);
    };
    for (const Material& material : document.materials)
        visitAll(material);
    for (const Snapshot& snapshot : document.snapshots)
        for (const auto& material : snapshot.look->materials)
            visitAll(*material);
}

template <class Visit>
void forEachEnvironment(const Document& document, const Visit& visit) {
    for (const Environment& environment : document.environments)
        visit(environment);
    for (const Snapshot& snapshot : document.snapshots)
        for (const auto& environment : snapshot.look->environments)
            visit(*environment);
}

bool shows(const MeshInstance& mesh, const Material& material) {
    return mesh.material == material.id;
}

// Applies `change` to the materials (or environments) of the document and to those of its snapshots
// for which it returns true on a copy.
template <class Element, class Change>
void changeShared(std::vector<std::shared_ptr<const Element>>& elements, bool& changed,
                  const Change& change) {
    for (auto& element : elements) {
        Element copy = *element;
        if (!change(copy))
            continue;
        element = std::make_shared<const Element>(std::move(copy));
        changed = true;
    }
}

template <class Change>
void changeLooks(Document& document, const Change& change) {
    for (Snapshot& snapshot : document.snapshots) {
        Look look = *snapshot.look;
        bool changed = false;
        change(look, changed);
        if (changed)
            snapshot.look = std::make_shared<Look>(std::move(look));
    }
}

} // namespace

OutsidePictures outsidePictures(const Document& document) {
    OutsidePictures result;
    forEachSlot(document, [&](const Material& material, const MapSlot& slot) {
        if (!isLeftOut(slot))
            return;
        addOnce(result.files, slot.source);
        addOnce(result.ofMaps, slot.source);
        if (slot.problem == kOutsideProjectProblem) {
            addOnce(result.ofProject, slot.source);
            return;
        }
        for (const MeshInstance& mesh : document.meshes)
            if (shows(mesh, material))
                addOnce(result.models, parseSceneSource(mesh.source).file);
    });
    forEachEnvironment(document, [&](const Environment& environment) {
        if (environment.problem != kOutsideProjectProblem)
            return;
        addOnce(result.files, environment.source);
        addOnce(result.ofProject, environment.source);
    });
    return result;
}

std::vector<std::string> outsidePicturesOf(const Document& document, const std::string& model) {
    std::vector<std::string> files;
    forEachSlot(document, [&](const Material& material, const MapSlot& slot) {
        if (isLeftOut(slot) && slot.problem == kOutsideProblem &&
            std::any_of(
                document.meshes.begin(), document.meshes.end(), [&](const MeshInstance& mesh) {
                    return shows(mesh, material) && parseSceneSource(mesh.source).file == model;
                }))
            addOnce(files, slot.source);
    });
    return files;
}

std::string fileOfPicture(const std::string& source) {
    if (isBuiltin(source))
        return {};
    const std::optional<EmbeddedSource> embedded = parseEmbeddedSource(source);
    return embedded ? parseSceneSource(embedded->model).file : source;
}

std::vector<std::string> shownFromOutside(const Document& document,
                                          const std::filesystem::path& project) {
    std::error_code ignored;
    const TexturePaths folder(std::filesystem::absolute(project, ignored).parent_path());
    std::vector<std::string> files;
    const auto add = [&](const std::string& source) {
        const std::string file = fileOfPicture(source);
        if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end() &&
            !folder.isInside(file))
            files.push_back(file);
    };
    forEachSlot(document, [&](const Material&, const MapSlot& slot) {
        if (slot.image != nullptr && !slot.source.empty())
            add(slot.source);
    });
    forEachEnvironment(document, [&](const Environment& environment) {
        if (environment.problem.empty() && !environment.source.empty())
            add(environment.source);
    });
    return files;
}

void fillOutsidePicture(Document& document, const std::string& source, ColorEncoding encoding,
                        const ImagePtr& image) {
    const auto fill = [&](Material& material) {
        bool filled = false;
        for (const MaterialInputInfo& input : kMaterialInputs) {
            MapSlot& slot = material.*input.map;
            if (!isLeftOut(slot) || slot.source != source || input.encoding != encoding)
                continue;
            slot.image = image;
            slot.problem.clear();
            filled = true;
        }
        return filled;
    };
    for (Material& material : document.materials)
        fill(material);
    changeLooks(document,
                [&](Look& look, bool& changed) { changeShared(look.materials, changed, fill); });
}

void fillOutsideEnvironment(Document& document, const std::string& source, EnvironmentLayout layout,
                            const ImagePtr& image) {
    const auto fill = [&](Environment& environment) {
        if (environment.problem != kOutsideProjectProblem || environment.source != source ||
            environment.layout != layout)
            return false;
        environment.fileImage = image;
        environment.problem.clear();
        resolveEnvironment(environment);
        return true;
    };
    for (Environment& environment : document.environments)
        fill(environment);
    changeLooks(document,
                [&](Look& look, bool& changed) { changeShared(look.environments, changed, fill); });
}

} // namespace patina
