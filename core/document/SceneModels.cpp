#include "core/document/SceneModels.h"

#include "core/light/Light.h"
#include "core/material/Material.h"

#include <algorithm>

namespace patina {
namespace {

// Whether a mesh is the first of its model, known by the mesh before it in the document.
bool beginsModel(const MeshInstance* before, const MeshInstance& mesh) {
    return before == nullptr || mesh.source != before->source ||
           mesh.sourceIndex <= before->sourceIndex;
}

} // namespace

std::vector<SceneModelPart> sceneModels(const Document& document) {
    std::vector<SceneModelPart> models;
    const MeshInstance* before = nullptr; // hidden ones, too: they tell models apart
    bool begins = true;                   // the next visible mesh is the first of its model
    for (const MeshInstance& mesh : document.meshes) {
        begins = begins || beginsModel(before, mesh);
        before = &mesh;
        if (!mesh.visible)
            continue;
        if (begins)
            models.push_back({mesh.source, {}, {}});
        begins = false;
        models.back().meshes.push_back(mesh.id);
    }
    if (models.size() != 1)
        return models;
    std::vector<SceneModelPart> meshes;
    for (const Id id : models.front().meshes)
        meshes.push_back({{}, document.mesh(id)->name, {id}});
    return meshes;
}

std::vector<Id> meshesOfModel(const Document& document, Id mesh) {
    std::vector<Id> model;
    const MeshInstance* before = nullptr;
    for (const MeshInstance& instance : document.meshes) {
        if (beginsModel(before, instance)) {
            if (std::ranges::find(model, mesh) != model.end())
                return model;
            model.clear();
        }
        before = &instance;
        model.push_back(instance.id);
    }
    return std::ranges::find(model, mesh) != model.end() ? model : std::vector<Id>{};
}

} // namespace patina
