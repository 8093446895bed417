// The document: everything the user made, as one value. A copy is a snapshot (heavy payloads are
// shared and immutable); everything else in Patina is a view of it.
#pragma once

#include "core/bake/BakeArtifact.h"
#include "core/image/Image.h"
#include "core/material/Material.h"
#include "core/math/Camera.h"
#include "core/mesh/Mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace patina {

struct MeshInstance {
    Id id = 0;
    std::string name;
    // Where the mesh came from: absolute path (UTF-8) or "builtin:NAME", and which of its
    // instances.
    std::string source;
    int sourceIndex = 0;
    MeshPtr mesh; // never null in a resolved document
    glm::mat4 transform{1.0f};
    Id material = 0;
    bool visible = true;
    friend bool operator==(const MeshInstance&, const MeshInstance&) = default;
};

enum class LightType { Point, Directional };

struct Light {
    Id id = 0;
    std::string name = "Light";
    LightType type = LightType::Directional;
    bool enabled = true;
    glm::vec3 color{1.0f}; // linear sRGB
    float intensity =
        3.0f; // Directional: lux / pi-free irradiance E at normal incidence; Point: candela (W/sr)
    glm::vec3 position{2.0f, 3.0f, 2.0f}; // Point: metres
    float azimuthDeg = 40.0f;   // Directional: where the light comes from, around +Y, 0 is +Z
    float elevationDeg = 45.0f; // Directional: above the horizon
    [[nodiscard]] glm::vec3 directionToLight() const; // Directional: unit vector
    friend bool operator==(const Light&, const Light&) = default;
};

enum class BackgroundMode { Environment, Blurred, Color };

// A lat-long environment: the centre of the image is -Z, its top +Y, u grows to the right as seen
// from inside: u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
struct Environment {
    std::string source = "builtin:studio"; // absolute path or builtin:NAME
    ImagePtr image;                        // F32 linear, 3 channels, w = 2h
    std::string problem;                   // why it could not be read; a neutral grey stands in
    float rotationDeg = 0.0f; // turns the surroundings about +Y, counter-clockwise from above
    float exposureEv = 0.0f;  // scales radiance by 2^EV
    BackgroundMode background = BackgroundMode::Environment;
    glm::vec3 backgroundColor{0.05f};
    friend bool operator==(const Environment&, const Environment&) = default;
};

enum class ToneMap { Clamp, Reinhard };
enum class LightingMode { Ibl, Prt };

struct View {
    Camera camera; // navigation is saved, but is no undo step
    float exposureEv = 0.0f;
    ToneMap toneMap = ToneMap::Reinhard;
    LightingMode lighting = LightingMode::Ibl;
    friend bool operator==(const View&, const View&) = default;
};

struct Document {
    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<Light> lights;
    Environment environment;
    View view;
    std::vector<BakeArtifactPtr> bakes; // at most one of each BakeKind
    Id nextId = 1;

    [[nodiscard]] Id takeId() { return nextId++; }
    [[nodiscard]] const Material* material(Id id) const;
    [[nodiscard]] Material* material(Id id);
    [[nodiscard]] const Light* light(Id id) const;
    [[nodiscard]] Light* light(Id id);
    [[nodiscard]] const MeshInstance* mesh(Id id) const;
    [[nodiscard]] MeshInstance* mesh(Id id);
    [[nodiscard]] Bounds bounds() const;             // of the visible meshes, in the world
    [[nodiscard]] std::size_t triangleCount() const; // visible
    friend bool operator==(const Document&, const Document&) = default;
};

} // namespace patina
