// A scene that did not come from COLLADA as a COLLADA 1.4.1 document: lit meshes in world space,
// materials and a camera. It holds no lights: the light is in the vertices or in a light map.
#pragma once

#include "core/base/Result.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/math/Camera.h"
#include "core/mesh/Mesh.h"

#include <chrono>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct NewColladaMesh {
    std::string name;                     // what the schema allows in names; the rest becomes _
    int material = -1;                    // of NewColladaScene::materials; -1: none
    Mesh mesh;                            // world space; texture coordinates may be missing
    std::vector<glm::vec4> colors;        // as in ColladaLitMesh
    std::vector<glm::vec3> radiosity;     // as in ColladaLitMesh
    std::vector<glm::vec3> white{};       // as in ColladaLitMesh
    std::vector<glm::vec2> lightMapUvs{}; // as in ColladaLitMesh
};

struct NewColladaScene {
    std::string name;
    std::vector<ColladaMaterial> materials; // their ids are made anew; textures: names of files
    std::vector<NewColladaMesh> meshes;
    Camera camera;
    double aspect = 16.0 / 9.0; // of the camera's picture, width by height
    // Of all meshes, whose materials have its picture as their emission.
    std::optional<ColladaLightMap> lightMap{};
};

// Errors: Usage (a mesh that is not consistent, no meshes).
[[nodiscard]] Result<ColladaDocument> newColladaDocument(const NewColladaScene& scene,
                                                         std::chrono::sys_seconds modified);

} // namespace patina
