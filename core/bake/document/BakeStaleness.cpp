#include "core/bake/document/BakeStaleness.h"

#include "core/bake/Bake.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/base/ById.h"
#include "core/document/Document.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

// What a hash that differs can be told to mean; per-texel bakes do not know their meshes.
std::vector<std::string> geometryReasons(const BakeArtifact& artifact, const Document& document) {
    std::vector<std::string> reasons;
    const ById meshes(document.meshes);
    const ById baked(artifact.vertices, &VertexBake::mesh);
    for (const VertexBake& bake : artifact.vertices) {
        const MeshInstance* mesh = meshes.find(bake.mesh);
        if (mesh == nullptr)
            reasons.emplace_back("a mesh was removed");
        else if (!mesh->visible)
            reasons.push_back(fmt::format("“{}” was hidden", mesh->name));
        else if (mesh->mesh && bake.stride > 0 &&
                 bake.values.size() !=
                     mesh->mesh->vertexCount() * static_cast<std::size_t>(bake.stride))
            reasons.push_back(fmt::format("“{}” has other vertices", mesh->name));
    }
    if (!artifact.vertices.empty())
        for (const MeshInstance& mesh : document.meshes)
            if (mesh.visible && mesh.mesh && !baked.contains(mesh.id))
                reasons.push_back(fmt::format("“{}” was added or shown", mesh.name));
    if (reasons.empty())
        reasons.emplace_back("something was moved, reshaped, or lets light through elsewhere");
    return reasons;
}

// The same meshes take part, whatever has become of them; of per-texel bakes nobody knows.
bool sameMeshes(const BakeArtifact& artifact, const Document& document) {
    const ById meshes(document.meshes);
    const auto visible = [&](const VertexBake& bake) {
        const MeshInstance* mesh = meshes.find(bake.mesh);
        return mesh != nullptr && mesh->visible;
    };
    const auto count = std::ranges::count_if(
        document.meshes, [](const MeshInstance& mesh) { return mesh.visible && mesh.mesh; });
    return std::ssize(artifact.vertices) == count &&
           std::ranges::all_of(artifact.vertices, visible);
}

} // namespace

BakeStaleness bakeStaleness(const BakeArtifact& artifact, const Document& document,
                            const Hash& inputs, const Hash& albedo, const Hash& light) {
    BakeStaleness result;
    if (artifact.inputs != inputs) {
        result.geometry = true;
        result.reasons = geometryReasons(artifact, document);
    }
    // Where meshes come and go, so do their albedos: no reason of its own.
    if (artifact.albedo != Hash{} && artifact.albedo != albedo &&
        (!result.geometry || sameMeshes(artifact, document))) {
        result.albedo = true;
        result.reasons.emplace_back("the albedo has changed, and light bounces off it");
    }
    if (artifact.kind == BakeKind::LightMap && artifact.light != light) {
        result.light = true;
        result.reasons.emplace_back("the lights, the environment or the materials have changed");
    }
    return result;
}

std::vector<SettingDifference> settingDifferences(const BakeArtifact& artifact,
                                                  const BakeRequest& wanted) {
    std::vector<SettingDifference> result;
    const auto asked = settingsText(normalized(wanted));
    for (const BakeOption& option : bakeOptions()) {
        const auto now = asked.find(option.name);
        const auto then = artifact.settings.find(option.name);
        if (now != asked.end() && then != artifact.settings.end() && now->second != then->second)
            result.push_back({option.label, then->second, now->second});
    }
    return result;
}

std::optional<StoppedBake> stoppedEarly(const BakeArtifact& artifact) {
    const BakeRequest request = requestOf(artifact);
    const int asked = samplesOf(request);
    if (!artifact.settings.contains("samples") || artifact.samplesDone >= asked)
        return std::nullopt;
    // Bakes to a tolerance end before their last ray by themselves.
    const bool toTolerance = holdsTransfer(artifact.kind) && request.prt.tolerance > 0.0f;
    if (toTolerance && !artifact.stopped)
        return std::nullopt;
    return StoppedBake{artifact.samplesDone, asked};
}

} // namespace patina
