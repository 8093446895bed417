#include "core/document/SceneModels.h"

#include "core/light/Light.h"
#include "core/material/Material.h"

namespace patina {

std::vector<SceneModelPart> sceneModels(const Document& document) {
    std::vector<SceneModelPart> models;
    const MeshInstance* before = nullptr; // hidden ones, too: they tell models apart
    bool begins = true;                   // the next visible mesh is the first of its model
    for (const MeshInstance& mesh : document.meshes) {
        begins = begins || before == nullptr || mesh.source != before->source ||
                 mesh.sourceIndex <= before->sourceIndex;
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

} // namespace patina
