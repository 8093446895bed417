// What differs between two documents, one bit for each thing that pictures are derived from. Who
// shows a document keeps the one it shows, compares, and renews what its bits say: what an edit was
// called does not matter, so that no way of editing can be forgotten.
#pragma once

#include "core/document/Document.h"

#include <vector>

namespace patina {

// The camera, names, sources of meshes and environments that light nothing are left out: a scene is
// the same whatever they are.
struct Dirty {
    bool model = false;       // of shading
    bool lights = false;      // any of them
    bool environment = false; // what lights the scene: the pictures of the mix, or their share
    bool view = false;        // exposure, tone mapping, lighting mode, background
    bool bakes = false;       // others are attached
    bool instances = false;   // meshes, where they stand, in which material, whether they are seen
    bool casters = false;     // what shadow maps show: shapes, and the holes cut into them
    bool places = false;      // where texels of bakes lie on the surfaces
    bool materialSet = false; // materials were added or removed
    // Those that are new or have other values, in the order of the later document.
    std::vector<Id> materials;

    [[nodiscard]] bool any() const;
};

// To get from `before` to `after`. Takes some nanoseconds for each mesh instance, light and
// material: pictures are compared by identity, not by content.
[[nodiscard]] Dirty dirtyBetween(const Document& before, const Document& after);

} // namespace patina
