// Ambient occlusion per texel, one texture per material.

#include "core/bake/AoSettingsCheck.h"
#include "core/bake/Bake.h"
#include "core/bake/BakePoints.h"
#include "core/bake/GutterFill.h"
#include "core/bake/Passes.h"
#include "core/bake/RayScene.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr int kMaxSide = 8192;
constexpr std::size_t kTexelsPerRange = 64;

// The points of one material and where they are among the points of all.
struct MaterialTexels {
    Id material = 0;
    TexelPoints texels;
    std::size_t firstPoint = 0;
};

std::vector<Id> materialsInOrder(const BakeGeometry& geometry) {
    std::vector<Id> materials;
    for (const BakeGeometryMesh& mesh : geometry.meshes)
        if (std::find(materials.begin(), materials.end(), mesh.material) == materials.end())
            materials.push_back(mesh.material);
    return materials;
}

// The mean over the points of texel `t`; `values` begin with the material's point `first`.
float texelValue(const TexelPoints& texels, std::size_t t, std::span<const float> values,
                 std::size_t first) {
    float sum = 0.0f;
    for (std::size_t p = texels.firstPoint[t]; p < texels.firstPoint[t + 1]; ++p)
        sum += values[p - first];
    return sum / static_cast<float>(texels.firstPoint[t + 1] - texels.firstPoint[t]);
}

// Sends the texels of a range as runs of neighbours in one row.
void sendTexels(TileSink& sink, const MaterialTexels& part, int size, const PointRange& range,
                std::span<const float> values) {
    const TexelPoints& texels = part.texels;
    const std::size_t first = range.first - part.firstPoint;
    const auto at = [&](std::size_t point) {
        return static_cast<std::size_t>(
            std::lower_bound(texels.firstPoint.begin(), texels.firstPoint.end(), point) -
            texels.firstPoint.begin());
    };
    const std::size_t begin = at(first), end = at(first + range.count);
    const auto side = static_cast<std::uint32_t>(size);
    std::vector<float> run;
    for (std::size_t t = begin; t < end; ++t) {
        run.push_back(texelValue(texels, t, values, first));
        const std::uint32_t texel = texels.texels[t];
        const bool continues =
            t + 1 < end && texels.texels[t + 1] == texel + 1 && (texel + 1) % side != 0;
        if (continues)
            continue;
        const auto x = static_cast<int>(texel % side + 1 - run.size());
        sink.texels(part.material, size, x, static_cast<int>(texel / side),
                    static_cast<int>(run.size()), run);
        run.clear();
    }
}

ImagePtr texelImage(const MaterialTexels& part, int size, std::span<const float> values) {
    auto image = std::make_shared<Image>(size, size, 1, PixelType::F32, ColorEncoding::Data);
    const std::span<float> pixels = image->f32();
    std::vector<std::uint8_t> known(pixels.size(), 0);
    for (std::size_t t = 0; t < part.texels.texels.size(); ++t) {
        pixels[part.texels.texels[t]] =
            texelValue(part.texels, t, values.subspan(part.firstPoint), 0);
        known[part.texels.texels[t]] = 1;
    }
    fillGutters(pixels, std::move(known), size, 1.0f);
    for (float& pixel : pixels) // means of ones may round to a little more
        pixel = std::clamp(pixel, 0.0f, 1.0f);
    return image;
}

// What the user should know about the UVs; empty when all is well.
std::string uvNote(const std::vector<MaterialTexels>& parts) {
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

} // namespace

Result<BakeArtifact> bakeAoTexel(const BakeInputs& inputs, const AoSettings& settings,
                                 TileSink& sink, const JobContext& job) {
    Result<PassSettings> passSettings = aoPassSettings(settings);
    if (!passSettings)
        return passSettings.error();
    if (settings.size < 1 || settings.size > kMaxSide)
        return Error{ErrorKind::Usage,
                     fmt::format("The side of a baked texture is 1 to {} texels, not {}.", kMaxSide,
                                 settings.size),
                     {},
                     {}};
    job.setActivity("preparing the scene");
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    for (const BakeGeometryMesh& mesh : geometry->meshes)
        if (mesh.mesh->uvs.size() != mesh.mesh->positions.size())
            return Error{
                ErrorKind::InputBroken,
                fmt::format("The mesh \"{}\" has no texture coordinates; unwrap it or bake "
                            "per vertex.",
                            mesh.mesh->name),
                {},
                {}};
    const Result<RayScene> scene = RayScene::build(*geometry, job);
    if (!scene)
        return scene.error();
    passSettings->maxDistance *= static_cast<float>(geometry->unitsPerMetre);

    // All materials in one list, so that each pass covers them all.
    std::vector<MaterialTexels> parts;
    std::vector<BakePoint> points;
    std::vector<PointRange> ranges;
    for (const Id material : materialsInOrder(*geometry)) {
        MaterialTexels part{material, texelPoints(*geometry, material, settings.size, job),
                            points.size()};
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "The bake was cancelled.", {}, {}};
        const std::vector<std::uint32_t>& firstPoint = part.texels.firstPoint;
        for (std::size_t t = 0; t < part.texels.texels.size(); t += kTexelsPerRange) {
            const std::size_t end = std::min(t + kTexelsPerRange, part.texels.texels.size());
            ranges.push_back({part.firstPoint + firstPoint[t], firstPoint[end] - firstPoint[t]});
        }
        points.insert(points.end(), part.texels.points.begin(), part.texels.points.end());
        std::vector<BakePoint>().swap(part.texels.points);
        parts.push_back(std::move(part));
    }

    PassCallbacks callbacks;
    callbacks.range = [&](const PointRange& range, std::span<const float> values) {
        const auto next = std::upper_bound(
            parts.begin(), parts.end(), range.first,
            [](std::size_t first, const MaterialTexels& part) { return first < part.firstPoint; });
        sendTexels(sink, *(next - 1), settings.size, range, values);
    };
    callbacks.passDone = [&](int samples) { sink.passDone(samples); };
    const Result<PassState> passes =
        runPasses(*scene, points, ranges, *passSettings, callbacks, job);
    if (!passes)
        return passes.error();

    BakeArtifact artifact;
    artifact.kind = BakeKind::AoTexel;
    artifact.inputs = hashBakeInputs(inputs);
    artifact.settings = aoSettingsText(settings, passSettings->samples);
    artifact.settings["size"] = std::to_string(settings.size);
    if (const std::string note = uvNote(parts); !note.empty())
        artifact.settings["note"] = note;
    artifact.samplesDone = passes->samplesDone;
    for (const MaterialTexels& part : parts)
        artifact.texels.push_back({part.material, texelImage(part, settings.size, passes->values)});
    job.setProgress(1.0);
    return artifact;
}

} // namespace patina
