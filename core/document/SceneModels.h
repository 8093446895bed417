// The models that a scene consists of, to show one of them at a time.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <vector>

namespace patina {

struct SceneModelPart {
    std::string source;     // MeshInstance::source of its meshes; empty: one mesh of a model
    std::string name;       // of that mesh
    std::vector<Id> meshes; // in the document's order, at least one
    friend bool operator==(const SceneModelPart&, const SceneModelPart&) = default;
};

// The visible meshes by the models that were added to the scene; where they are all of one, the
// meshes themselves. The same file added twice is two models: its first mesh begins it.
[[nodiscard]] std::vector<SceneModelPart> sceneModels(const Document& document);

// All meshes of the model that the mesh came with, hidden ones too, in the document's order; empty
// where there is no such mesh.
[[nodiscard]] std::vector<Id> meshesOfModel(const Document& document, Id mesh);

} // namespace patina
