#include "core/bake/transfer/TexelTransfer.h"

#include "core/bake/domain/GutterFill.h"
#include "core/material/Material.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace patina {
namespace {

constexpr int kMaxSide = 8192;
constexpr std::size_t kTexelsPerRange = 64;

// Appends the mean over the points of texel `t`; `values` begin with the material's point `first`.
void appendTexel(const TexelPoints& texels, std::size_t t, std::size_t stride,
                 std::span<const float> values, std::size_t first, std::vector<float>& result) {
    const std::size_t begin = texels.firstPoint[t], end = texels.firstPoint[t + 1];
    for (std::size_t i = 0; i < stride; ++i) {
        float sum = 0.0f;
        for (std::size_t p = begin; p < end; ++p)
            sum += values[(p - first) * stride + i];
        result.push_back(sum / static_cast<float>(end - begin));
    }
}

} // namespace

std::string TexelLayout::note() const {
    std::size_t texels = 0, shared = 0, skipped = 0;
    for (const MaterialTexels& part : parts) {
        texels += part.texels.texels.size();
        shared += part.texels.sharedTexels;
        skipped += part.texels.skippedTriangles;
    }
    std::string note;
    if (shared * 1000 > texels) // a few texels on seams are normal
        note = fmt::format(
            "UVs overlap or repeat on {:.0f} % of the baked texels, which hold the "
            "mean of the places that share them. Unwrap the mesh for one value per "
            "place.",
            std::max(1.0, 100.0 * static_cast<double>(shared) / static_cast<double>(texels)));
    if (skipped > 0)
        note +=
            fmt::format("{}{} triangles repeat the texture more than 8 times and were left out.",
                        note.empty() ? "" : " ", skipped);
    return note;
}

const MaterialTexels& TexelLayout::partOf(std::size_t point) const {
    return *(std::upper_bound(
                 parts.begin(), parts.end(), point,
                 [](std::size_t p, const MaterialTexels& part) { return p < part.firstPoint; }) -
             1);
}

std::vector<Id> materialsInOrder(const BakeGeometry& geometry) {
    std::vector<Id> materials;
    std::set<Id> seen;
    for (const BakeGeometryMesh& mesh : geometry.meshes)
        if (seen.insert(mesh.material).second)
            materials.push_back(mesh.material);
    return materials;
}

Result<TexelLayout> texelLayout(const BakeGeometry& geometry, int size, const JobContext& job) {
    return texelLayout(geometry, materialsInOrder(geometry), size, job);
}

Result<TexelLayout> texelLayout(const BakeGeometry& geometry, std::span<const Id> materials,
                                int size, const JobContext& job,
                                std::vector<SurfacePlace>* places) {
    if (size < 1 || size > kMaxSide)
        return Error{
            ErrorKind::Usage,
            fmt::format("The side of a baked texture is 1 to {} texels, not {}.", kMaxSide, size),
            {},
            {}};
    for (const BakeGeometryMesh& mesh : geometry.meshes)
        if (mesh.mesh->uvs.size() != mesh.mesh->positions.size())
            return Error{
                ErrorKind::InputBroken,
                fmt::format("The mesh \"{}\" has no texture coordinates; unwrap it or bake "
                            "per vertex.",
                            mesh.name),
                {},
                {}};
    TexelLayout layout;
    layout.size = size;
    for (const Id material : materials) {
        MaterialTexels part{material, texelPoints(geometry, material, size, job, places),
                            layout.points.size()};
        if (job.cancelled())
            return bakeCancelled();
        const std::vector<std::uint32_t>& firstPoint = part.texels.firstPoint;
        for (std::size_t t = 0; t < part.texels.texels.size(); t += kTexelsPerRange) {
            const std::size_t end = std::min(t + kTexelsPerRange, part.texels.texels.size());
            layout.ranges.push_back(
                {part.firstPoint + firstPoint[t], firstPoint[end] - firstPoint[t]});
        }
        layout.points.insert(layout.points.end(), part.texels.points.begin(),
                             part.texels.points.end());
        std::vector<BakePoint>().swap(part.texels.points);
        layout.parts.push_back(std::move(part));
    }
    return layout;
}

void forEachTexelRun(
    const TexelLayout& layout, const PointRange& range, int stride, std::span<const float> values,
    const std::function<void(int x, int y, int width, std::span<const float>)>& row) {
    const MaterialTexels& part = layout.partOf(range.first);
    const TexelPoints& texels = part.texels;
    const std::size_t first = range.first - part.firstPoint;
    const auto at = [&](std::size_t point) {
        return static_cast<std::size_t>(
            std::lower_bound(texels.firstPoint.begin(), texels.firstPoint.end(), point) -
            texels.firstPoint.begin());
    };
    const std::size_t begin = at(first), end = at(first + range.count);
    const auto side = static_cast<std::uint32_t>(layout.size);
    std::vector<float> run;
    for (std::size_t t = begin; t < end; ++t) {
        appendTexel(texels, t, static_cast<std::size_t>(stride), values, first, run);
        const std::uint32_t texel = texels.texels[t];
        const bool continues =
            t + 1 < end && texels.texels[t + 1] == texel + 1 && (texel + 1) % side != 0;
        if (continues)
            continue;
        const int width = static_cast<int>(run.size()) / stride;
        row(static_cast<int>(texel % side) + 1 - width, static_cast<int>(texel / side), width, run);
        run.clear();
    }
}

std::vector<float> texelTexture(const TexelLayout& layout, const MaterialTexels& part,
                                std::span<const float> values, std::span<const float> fallback) {
    const auto side = static_cast<std::size_t>(layout.size);
    const std::size_t stride = fallback.size();
    std::vector<float> texture(side * side * stride);
    std::vector<std::uint8_t> known(side * side, 0);
    std::vector<float> texel;
    for (std::size_t t = 0; t < part.texels.texels.size(); ++t) {
        texel.clear();
        appendTexel(part.texels, t, stride, values.subspan(part.firstPoint * stride), 0, texel);
        const std::size_t at = part.texels.texels[t];
        std::copy(texel.begin(), texel.end(),
                  texture.begin() + static_cast<std::ptrdiff_t>(at * stride));
        known[at] = 1;
    }
    fillGutters(texture, std::move(known), layout.size, fallback);
    return texture;
}

ImagePtr occlusionTexture(const TexelLayout& layout, const MaterialTexels& part,
                          std::span<const float> values) {
    constexpr float kOpen[] = {1.0f};
    const std::vector<float> texels = texelTexture(layout, part, values, kOpen);
    auto image =
        std::make_shared<Image>(layout.size, layout.size, 1, PixelType::F32, ColorEncoding::Data);
    std::transform(texels.begin(), texels.end(), image->f32().begin(),
                   [](float v) { return std::clamp(v, 0.0f, 1.0f); }); // means of ones may round up
    return image;
}

std::vector<TexelBake> finishTexelTransfer(const TexelLayout& layout, const PassSettings& settings,
                                           const PassState& state) {
    const std::vector<float> dark(static_cast<std::size_t>(settings.stride()), 0.0f);
    constexpr float kOpen[] = {1.0f}, kCertain[] = {0.0f};
    std::vector<float> sky(layout.points.size());
    for (std::size_t p = 0; p < sky.size(); ++p)
        sky[p] = skyShare(state.hiddenSky[p], layout.points[p].normal);
    std::vector<TexelBake> bakes;
    for (const MaterialTexels& part : layout.parts) {
        TexelBake& bake = bakes.emplace_back();
        bake.material = part.material;
        bake.side = layout.size;
        bake.stride = settings.stride();
        bake.values = texelTexture(layout, part, state.values, dark);
        bake.sky = texelTexture(layout, part, sky, kOpen);
        if (settings.method != SampleMethod::Stratified) // whose one pass cannot tell
            bake.error = texelTexture(layout, part, state.error, kCertain);
    }
    return bakes;
}

} // namespace patina
