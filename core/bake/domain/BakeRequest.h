// A bake as it is asked for: what, and with which settings. bake() of core/bake/Bake.h runs any.
#pragma once

#include "core/bake/domain/BakeArtifact.h"

#include <cstdint>

namespace patina {

struct AoSettings {
    int samples = 256;        // rays per element, rounded up to a power of two
    float maxDistance = 0.0f; // metres; 0: unlimited
    int size = 1024;          // texel bake: side of the square texture
    std::uint32_t seed = 0;
};

enum class SampleMethod {
    Qmc,        // Owen-scrambled Sobol'
    Stratified, // jittered N × N, the classical way; samples are rounded up to a square
    Random      // independent: only to compare with
};

struct PrtSettings {
    int order = 3;      // SH bands 1…8
    int samples = 1024; // rays per element, rounded up to a power of two
    std::uint32_t seed = 0;
    TransferKind transfer = TransferKind::Shadowed;
    int bounces = 3;         // Interreflected: 1…64
    int bounceSamples = 256; // Interreflected: cached rays per vertex, rounded up to a power of two
    SampleMethod method = SampleMethod::Qmc;
    float tolerance = 0.0f; // RMS error of the coefficients at which to end early; 0: never
    bool fitted = true;     // vertex: least squares over points of the surface (VertexSamples.h)
    int size = 512;         // texel bake: side of the square texture
    // Interreflected: bytes that hits may take, 8 for each ray that meets something; where they
    // could take more they are traced anew for every bounce. 0: always.
    std::uint64_t hitBudget = std::uint64_t{1} << 30;
};

// Of a texture of many slices on the GPU: OpenGL 4.5 promises as much.
inline constexpr int kMaxLightMapSize = 2048;

// Numbers that a light map holds for each texel (core/bake/lightmap/LightMap.h).
inline constexpr int kLightMapNumbers = 43;

struct LightMapSettings {
    int samples = 16; // paths per texel of each lobe, rounded up to a power of two
    int size = 512;   // side of the square texture
    std::uint32_t seed = 0;
    bool smooth = true; // takes noise out, as far as texels of a surface differ by no more
};

struct BakeRequest {
    BakeKind kind = BakeKind::PrtVertex;
    AoSettings ao;   // for the kinds of ambient occlusion
    PrtSettings prt; // for transfer
    LightMapSettings lightMap = {};
};

// Of the settings of the request's kind: rays or paths per element, side of the square texture.
[[nodiscard]] constexpr int samplesOf(const BakeRequest& request) {
    return request.kind == BakeKind::LightMap ? request.lightMap.samples
           : holdsTransfer(request.kind)      ? request.prt.samples
                                              : request.ao.samples;
}
[[nodiscard]] constexpr int textureSizeOf(const BakeRequest& request) {
    return request.kind == BakeKind::LightMap ? request.lightMap.size
           : holdsTransfer(request.kind)      ? request.prt.size
                                              : request.ao.size;
}

} // namespace patina
