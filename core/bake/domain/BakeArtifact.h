// The result of a bake as a value: what was computed, from which inputs, with which settings.
#pragma once

#include "core/base/Hash.h"
#include "core/base/Id.h"
#include "core/image/Image.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

enum class BakeKind { AoTexel, AoVertex, PrtVertex, PrtTexel, LightMap };

[[nodiscard]] constexpr bool holdsTransfer(BakeKind kind) {
    return kind == BakeKind::PrtVertex || kind == BakeKind::PrtTexel;
}
[[nodiscard]] constexpr bool isPerTexel(BakeKind kind) {
    return kind == BakeKind::AoTexel || kind == BakeKind::PrtTexel || kind == BakeKind::LightMap;
}

// Which transport a transfer bake holds; each includes the ones before it.
enum class TransferKind {
    Unshadowed,    // the clamped cosine alone, in closed form
    Shadowed,      // and what the scene hides of the environment
    Interreflected // and what arrives by way of other surfaces
};

// Numbers per vertex of one mesh instance. Vectors are empty when the bake does not hold them.
//
// Transfer: with order² coefficients of the environment's radiance L_i per colour channel c, a
// surface of albedo ρ shows the radiance
//     ρ_c Σ_i L_ic (values_i + bounced_ic).
// Real SH with Condon-Shortley phase (shaders/shared/sh.glsl), index l(l+1)+m, world space. The
// element's own albedo is not included; that of the surfaces by way of which light came is in
// `bounced`.
struct VertexBake {
    Id mesh = 0;                     // MeshInstance::id
    int stride = 1;                  // of `values`: 1, or order² for transfer
    std::vector<float> values;       // AoVertex: ambient visibility 0…1 (1 = open);
                                     // transfer: T_i = ∫ V(ω) max(0, n·ω) Y_i(ω) dω / π
    std::vector<float> bounced = {}; // 3 · stride each: red, green, blue of coefficient 0, of 1 …
    std::vector<float> sky = {}; // 1 each, 0…1: share of the light of a uniform upper half (+Y) of
                                 // the environment that arrives, against an open surface of the
                                 // same normal; 1 where such a surface sees none of it
    std::vector<float> error =
        {}; // 1 each: estimated error of a coefficient (RMS over them), of rays and of the fit
    friend bool operator==(const VertexBake&, const VertexBake&) = default;
};

// One texture per material (meshes that share a material share its UV space), gutters filled.
struct TexelBake {
    Id material = 0;
    ImagePtr image; // AoTexel: F32 Data, 1 channel, ambient visibility 0…1
    // PrtTexel: side × side elements in rows from the top, as those of VertexBake. LightMap: the
    // same with the values of core/bake/lightmap/LightMap.h alone.
    int side = 0, stride = 0;
    std::vector<float> values = {}, bounced = {}, sky = {}, error = {};
    friend bool operator==(const TexelBake&, const TexelBake&) = default;
};

struct BakeArtifact {
    BakeKind kind = BakeKind::AoTexel;
    Hash inputs; // hashBakeInputs() of what it was made from
    Hash albedo; // of the albedo that bounces rest on, or zero
    Hash light;  // LightMap: of the lights, environments and materials that it rests on
    // What it was asked for with, as its file states it: "samples" → "256" … (requestOf() of
    // BakeOptions.h reads it). An older file states less.
    std::map<std::string, std::string> settings;
    std::string note;        // what the user should know of it; or empty
    bool stopped = false;    // by the user, before its last ray
    std::string missingFile; // core/document/AbsentBake.h; else empty
    int order = 0;           // transfer: SH bands
    TransferKind transfer = TransferKind::Shadowed;
    int bounces = 0;     // Interreflected: how often light may bounce
    int samplesDone = 0; // rays per element that the values rest on
    std::vector<VertexBake> vertices;
    std::vector<TexelBake> texels;
    friend bool operator==(const BakeArtifact&, const BakeArtifact&) = default;
};

// Transfer of open surfaces is known in closed form.
[[nodiscard]] inline bool restsOnRays(const BakeArtifact& bake) {
    return !holdsTransfer(bake.kind) || bake.transfer != TransferKind::Unshadowed;
}

using BakeArtifactPtr = std::shared_ptr<const BakeArtifact>;

// What its numbers take in memory.
[[nodiscard]] std::size_t artifactBytes(const BakeArtifact& bake);

} // namespace patina
