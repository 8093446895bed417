// Bakes are functions: they copy what they need, hold no document, write no files and touch no
// threads but the pool's. Results do not depend on the number of threads.
#pragma once

#include "core/bake/BakeArtifact.h"
#include "core/bake/BakeSurface.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/mesh/Mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina {

class BakeTracer;
struct Document;
class HitSource; // core/bake/HitCache.h

struct BakeMesh {
    Id id = 0;
    Id material = 0;
    MeshPtr mesh;
    glm::mat4 transform{1.0f};
    bool doubleSided = false; // else what hits the back is absorbed
    BakeSurface surface = {};
};

struct BakeInputs {
    std::vector<BakeMesh> meshes; // visible ones
};

[[nodiscard]] BakeInputs bakeInputs(const Document& document);
// What AO and direct transfer depend on: geometry, and where masked or blended surfaces let rays
// through. A bake whose hash differs is stale.
[[nodiscard]] Hash hashBakeInputs(const BakeInputs& inputs);
// What bounces depend on besides: albedo, its maps, and which surfaces have two sides. Reads every
// texel of the maps: some milliseconds for a large one.
[[nodiscard]] Hash hashBakeAlbedo(const BakeInputs& inputs);

// From where the results are looked at: world space, OpenGL's clip space.
struct BakeView {
    glm::vec3 eye{0.0f};
    glm::mat4 worldToClip{1.0f};
};

// Receives results while a bake runs, from the pool's threads, so that a preview can show them.
class TileSink {
  public:
    virtual ~TileSink() = default;
    // `values`: stride floats for each vertex first, first+1, … of mesh `mesh`, final for the pass.
    virtual void vertices(Id /*mesh*/, std::size_t /*first*/, int /*stride*/,
                          std::span<const float> /*values*/) {}
    // A rectangle of a material's texture: `width` texels of `stride` floats per row, rows from the
    // top.
    virtual void texels(Id /*material*/, int /*imageSize*/, int /*stride*/, int /*x*/, int /*y*/,
                        int /*width*/, std::span<const float> /*values*/) {}
    // A whole pass over all elements is complete with `samples` rays per element.
    virtual void passDone(int /*samples*/) {}
    // An interreflected bake: where its rays ended, for bounces to be followed again with other
    // albedo (core/bake/BounceSolver.h). Only when `hitBudget` allows to keep them.
    virtual void hits(const std::shared_ptr<const HitSource>& /*hits*/) {}
    // Asked before each pass: what is seen comes first. Changes the order of work alone.
    virtual std::optional<BakeView> view() { return std::nullopt; }
};

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

// Passes of 32, 64, … rays over all elements. stop() keeps what there is, every element with
// samplesDone rays or more; cancel() returns ErrorKind::Cancelled within 0.5 s.
// Errors: InputBroken for a scene without triangles; Internal when Embree refuses memory.
// `tracer`: how points are traced when not here and now (core/bake/BakeTracer.h).
Result<BakeArtifact> bakeAoTexel(const BakeInputs& inputs, const AoSettings& settings,
                                 TileSink& sink, const JobContext& job,
                                 BakeTracer* tracer = nullptr);
Result<BakeArtifact> bakeAoVertex(const BakeInputs& inputs, const AoSettings& settings,
                                  TileSink& sink, const JobContext& job,
                                  BakeTracer* tracer = nullptr);
Result<BakeArtifact> bakePrtVertex(const BakeInputs& inputs, const PrtSettings& settings,
                                   TileSink& sink, const JobContext& job,
                                   BakeTracer* tracer = nullptr);
// The transfer of every texel of every material's UV layout; also an error (InputBroken) for meshes
// without texture coordinates.
Result<BakeArtifact> bakePrtTexel(const BakeInputs& inputs, const PrtSettings& settings,
                                  TileSink& sink, const JobContext& job,
                                  BakeTracer* tracer = nullptr);

} // namespace patina
