// A look of the document that was kept under a name, to compare with and to return to.
#pragma once

#include "core/document/MeshInstance.h"
#include "core/document/View.h"
#include "core/image/Image.h"
#include "core/light/Environment.h"
#include "core/material/ShadingModel.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct Document;
struct Light;
struct Material;

// Of a look: which material a mesh has, and whether it is seen. Its geometry and its place are no
// part of it.
struct MeshLook {
    Id id = 0;
    std::string name; // as it was called then
    Id material = 0;
    bool visible = true;
    friend bool operator==(const MeshLook&, const MeshLook&) = default;
};

// Everything that decides what the scene looks like from wherever it is looked at: materials with
// their maps, lights, environments with their mix, shading model, exposure, tone curve, lighting
// mode, background, and which material each mesh has. Not the geometry, not the bakes.
//
// Elements are immutable and shared between looks, so that a look costs a pointer for each element
// that is as it was in another one. Images are those of the files; what is derived from the rest (a
// generated environment, the picture of a mix) is left out.
struct Look {
    std::vector<std::shared_ptr<const Material>> materials;
    std::vector<std::shared_ptr<const Light>> lights;
    std::vector<std::shared_ptr<const Environment>> environments;
    std::vector<MeshLook> meshes;
    EnvironmentMix mix;
    ShadingModel model;
    View view; // its camera is only where the look was kept from: it is no part of the look
};
[[nodiscard]] bool operator==(const Look& a, const Look& b); // by value

using LookPtr = std::shared_ptr<const Look>;

// Of the document as it is. Elements that `like` has alike are shared with it.
[[nodiscard]] LookPtr lookOf(const Document& document, const Look* like = nullptr);

// The look's elements as a document without geometry, for the parameter table.
[[nodiscard]] Document elementsOf(const Look& look);

inline constexpr std::size_t kMaxSnapshots = 256; // more are neither kept nor read
inline constexpr int kMaxSnapshotPicture = 256;   // pixels a side

struct Snapshot {
    Id id = 0;
    std::string name;
    LookPtr look; // never null
    // What the scene looked like: U8, RGB, sRGB, at most kMaxSnapshotPicture a side; null: none.
    ImagePtr picture;
};
[[nodiscard]] bool operator==(const Snapshot& a, const Snapshot& b); // by value

} // namespace patina
