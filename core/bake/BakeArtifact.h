// The result of a bake as a value: what was computed, from which inputs, with which settings.
#pragma once

#include "core/base/Hash.h"
#include "core/image/Image.h"
#include "core/material/Material.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

enum class BakeKind { AoTexel, AoVertex, PrtVertex };

// Numbers per vertex of one mesh instance: `stride` floats per vertex.
//  AoVertex:  1: ambient visibility 0…1 (1 = open).
//  PrtVertex: order² transfer coefficients T_i = ∫ V(ω) max(0, n·ω) Y_i(ω) dω / π, world space,
//  real SH
//             with Condon-Shortley phase (shaders/shared/sh.glsl), index l(l+1)+m, albedo not
//             included: exit radiance = albedo · Σ L_i T_i.
struct VertexBake {
    Id mesh = 0; // MeshInstance::id
    int stride = 1;
    std::vector<float> values;
    friend bool operator==(const VertexBake&, const VertexBake&) = default;
};

// One texture per material (meshes that share a material share its UV space): F32 Data, 1 channel,
// ambient visibility 0…1, gutters filled.
struct TexelBake {
    Id material = 0;
    ImagePtr image;
    friend bool operator==(const TexelBake&, const TexelBake&) = default;
};

struct BakeArtifact {
    BakeKind kind = BakeKind::AoTexel;
    Hash inputs;                                 // hashBakeInputs() of what it was made from
    std::map<std::string, std::string> settings; // as text: "samples" → "256" …
    int order = 0;                               // PrtVertex: SH bands
    int samplesDone = 0;                         // rays per element that the values rest on
    std::vector<VertexBake> vertices;
    std::vector<TexelBake> texels;
    friend bool operator==(const BakeArtifact&, const BakeArtifact&) = default;
};

using BakeArtifactPtr = std::shared_ptr<const BakeArtifact>;

} // namespace patina
