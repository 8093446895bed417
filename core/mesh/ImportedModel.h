// A model file as values: what its reader found, before it becomes part of a document.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/material/MaterialInput.h"
#include "core/mesh/Mesh.h"

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina {

// A texture as the model names it: a file beside it or an image embedded in it.
struct ImportedTexture {
    std::filesystem::path file; // absolute; empty when embedded; where it should be when missing
    int embedded = -1;          // index into ImportedModel::embeddedImages
    char channel = 0;           // 'r','g','b','a' for single-channel use; 0: whole colour
    glm::vec2 uvScale{1.0f}, uvOffset{0.0f};
    float uvRotationDeg = 0.0f; // KHR_texture_transform: T * R * S
};

// KHR_materials_pbrSpecularGlossiness: the rest of a material whose base colour and its map are the
// diffuse ones of the file, until importModel() has converted it (core/io/SpecularGlossiness.h).
struct ImportedGlossiness {
    glm::vec3 specular{1.0f};           // linear sRGB
    float glossiness = 1.0f;            // 1 - perceptual roughness
    std::optional<ImportedTexture> map; // specular colour, and glossiness as alpha
};

struct ImportedMaterial {
    std::string name;
    glm::vec4 baseColor{0.8f, 0.8f, 0.8f, 1.0f}; // linear sRGB, alpha
    PerInput<float> numbers = defaultNumbers();  // of inputs that have one
    glm::vec3 emissive{0.0f};
    bool doubleSided = false;
    bool alphaMask = false, alphaBlend = false;
    float alphaCutoff = 0.5f;
    float ior = 1.5f;
    bool thinWalled = true;
    glm::vec3 attenuationColor{1.0f};
    float attenuationDistance = 0.0f; // metres; 0: without end
    PerInput<std::optional<ImportedTexture>> maps;
    std::optional<ImportedGlossiness> glossiness;
};

struct ImportedInstance {
    std::string name;
    int mesh = 0;              // index into ImportedModel::meshes
    int material = 0;          // index into ImportedModel::materials
    int node = -1;             // glTF: index of the node that shows it
    glm::mat4 transform{1.0f}; // mesh to world, in metres and +Y up; never mirrors
};

struct ImportedLight {
    enum class Type { Point, Directional, Spot };
    std::string name;
    Type type = Type::Directional;
    glm::vec3 position{0.0f}, direction{0.0f, -1.0f, 0.0f};
    glm::vec3 color{1.0f}; // linear, intensity included: candela, or lux of a directional light
    float range = 0.0f;    // metres, 0: without end
    float innerConeDeg = 0.0f, outerConeDeg = 45.0f; // half angles of a spot
};

struct ImportedCamera { // perspective
    std::string name;
    glm::vec3 position{0.0f}, forward{0.0f, 0.0f, -1.0f}, up{0.0f, 1.0f, 0.0f}; // unit vectors
    float fovDeg = 35.0f;                                                       // vertical
};

struct ImportedModel {
    std::vector<std::shared_ptr<Mesh>> meshes;
    std::vector<ImportedMaterial> materials; // at least one
    std::vector<ImportedInstance> instances; // at least one
    std::vector<ImportedLight> lights;
    std::vector<ImportedCamera> cameras;      // glTF, COLLADA, FBX
    std::vector<Bytes> embeddedImages;        // compressed files (PNG, JPEG …) or empty when raw
    std::vector<std::string> missingTextures; // files the model names that are absent or empty
    // Pictures outside the model's folder, absolute: not to be read, as nobody has agreed to it
    // (WorkerClient::allowOutside()).
    std::vector<std::string> outsideTextures;
    std::vector<std::string> warnings; // one sentence each: what was repaired, dropped, generated
    std::string format;                // "gltf2", "obj" …
    // COLLADA, where there are several: visualSceneTitles(), and which of them this is.
    std::vector<std::string> scenes;
    std::size_t scene = 0;
    std::size_t triangleCount = 0;
    MeshRepairs repairs; // summed over the meshes
};

} // namespace patina
