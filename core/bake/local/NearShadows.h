// The shadows of a document's local lights under radiance transfer: for each light, and each vertex
// or texel that a bake lights, how much of it arrives. The editor traces them in the background,
// the command line before it draws.
#pragma once

#include "core/bake/local/NearVisibility.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patina {

// What has a share for each light: the vertices of a mesh, or the texels of a material.
struct NearPart {
    Id id = 0;    // of the mesh, or of the material
    int side = 0; // of the material's texture; 0: vertices
    friend bool operator==(const NearPart&, const NearPart&) = default;
};

struct NearLight {
    Id id = 0;
    NearEmitter emitter;
    friend bool operator==(const NearLight&, const NearLight&) = default;
};

// What shadows are traced for. Nothing to do without parts or without lights.
struct NearShadowRequest {
    BakeInputs inputs;
    std::vector<NearPart> parts;   // what transfer lights, in the order of the meshes
    std::vector<NearLight> lights; // those that are on, in the document's order
    [[nodiscard]] bool empty() const { return parts.empty() || lights.empty(); }
};

// The document's local lights that are on.
[[nodiscard]] std::vector<NearLight> nearLights(const Document& document);
// Of its bakes and lights, however it is lit.
[[nodiscard]] NearShadowRequest nearShadowRequest(const Document& document);
// The same rays from the same elements.
[[nodiscard]] bool sameScene(const NearShadowRequest& a, const NearShadowRequest& b);
[[nodiscard]] bool operator==(const NearShadowRequest& a, const NearShadowRequest& b);

// For each vertex of the mesh, or texel (rows from the top, gutters filled), 0…1. Negative: the
// element has none, and harmonics stand in; that is so for texels that several places share which
// face different ways.
using NearShares = std::shared_ptr<const std::vector<float>>;

class NearScene; // geometry, hierarchy and starting points of rays

struct NearShadows {
    NearShadowRequest request;
    std::shared_ptr<const NearScene> scene;
    // shares[l][p]: of request.lights[l] at request.parts[p].
    std::vector<std::vector<NearShares>> shares;
    std::string note; // for the user, where harmonics stand in for many texels; else empty
};
using NearShadowsPtr = std::shared_ptr<const NearShadows>;

// Memory that shadows of such a request take, with the scene that they are traced in, in bytes.
[[nodiscard]] std::uint64_t nearShadowBytes(const NearShadowRequest& request);

// Traces what `before` (null: nothing) does not hold. `maxBytes`: memory that may be taken, 0: no
// limit. Errors: Usage when it is not enough; those of BakeScene::build(); Cancelled. The messages
// end in what the user can do.
Result<NearShadowsPtr> traceNearShadows(const NearShadowRequest& request,
                                        const NearShadowsPtr& before, std::uint64_t maxBytes,
                                        const JobContext& job);

} // namespace patina
