// From the UV layouts of all materials to the points of a bake per texel, and from what those
// points saw back to textures.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakePoints.h"
#include "core/bake/transfer/Passes.h"
#include "core/base/Result.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace patina {

// One material's texels and where their points are among the points of all.
struct MaterialTexels {
    Id material = 0;
    TexelPoints texels; // without its points, which are in TexelLayout
    std::size_t firstPoint = 0;
};

struct TexelLayout {
    int size = 0;                           // side of each texture
    std::vector<MaterialTexels> parts;      // in the order of the meshes
    std::vector<BakePoint> points;          // of all materials, so that each pass covers them all
    std::vector<PointRange> ranges;         // never split a texel, never span two materials
    [[nodiscard]] std::string note() const; // what the user should know of the UVs, or empty
    // The part that holds a point.
    [[nodiscard]] const MaterialTexels& partOf(std::size_t point) const;
};

// Errors: Usage unless 1 <= size <= 8192; InputBroken for a mesh without texture coordinates;
// Cancelled.
Result<TexelLayout> texelLayout(const BakeGeometry& geometry, int size, const JobContext& job);
// The same of some materials alone. `places`: filled with those of the points.
Result<TexelLayout> texelLayout(const BakeGeometry& geometry, std::span<const Id> materials,
                                int size, const JobContext& job,
                                std::vector<SurfacePlace>* places = nullptr);
[[nodiscard]] std::vector<Id> materialsInOrder(const BakeGeometry& geometry); // of the meshes
// A texture of ambient visibility with gutters filled: 1 channel, F32 Data.
[[nodiscard]] ImagePtr occlusionTexture(const TexelLayout& layout, const MaterialTexels& part,
                                        std::span<const float> values);

// What the texels of a range show: `values` are those of its points, `stride` floats each. Calls
// row(x, y, width, values) for runs of neighbours in one row.
void forEachTexelRun(
    const TexelLayout& layout, const PointRange& range, int stride, std::span<const float> values,
    const std::function<void(int x, int y, int width, std::span<const float>)>& row);

// A part's texture with gutters filled: size² texels of fallback.size() floats, `values` those of
// all points.
[[nodiscard]] std::vector<float> texelTexture(const TexelLayout& layout, const MaterialTexels& part,
                                              std::span<const float> values,
                                              std::span<const float> fallback);

// The textures of a transfer bake from what its points saw.
[[nodiscard]] std::vector<TexelBake> finishTexelTransfer(const TexelLayout& layout,
                                                         const PassSettings& settings,
                                                         const PassState& state);

} // namespace patina
