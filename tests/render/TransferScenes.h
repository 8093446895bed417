// Small scenes under radiance transfer, and the transfer of open surfaces in closed form.
#pragma once

#include "core/bake/BakeArtifact.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/render/RenderTest.h"

#include <utility>
#include <vector>

namespace patina::render {

// A_l / pi Y_lm(n) for each vertex.
[[nodiscard]] inline std::vector<float> openTransfer(const Mesh& mesh, int order) {
    constexpr double kOneOverPi = 0.31830988618379067;
    const auto stride = static_cast<std::size_t>(shCount(order));
    std::vector<float> values(mesh.vertexCount() * stride);
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const std::span<float> own(values.data() + v * stride, stride);
        evaluateSh(order, mesh.normals[v], own);
        for (int l = 0; l < order; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                own[static_cast<std::size_t>(i)] *=
                    static_cast<float>(cosineConvolution(l) * kOneOverPi);
    }
    return values;
}

// Of the mesh with id 1.
[[nodiscard]] inline BakeArtifactPtr vertexBake(int order, std::vector<float> values,
                                                std::vector<float> bounced = {}) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = order;
    bake->vertices.push_back({1, shCount(order), std::move(values), std::move(bounced)});
    return bake;
}

// Every mesh as if nothing hid anything; `bounced`: so much of it again, from other surfaces.
[[nodiscard]] inline BakeArtifactPtr openBake(const Document& document, int order,
                                              float bounced = 0.0f) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = order;
    bake->transfer = bounced > 0.0f ? TransferKind::Interreflected : TransferKind::Shadowed;
    for (const MeshInstance& mesh : document.meshes) {
        const std::vector<float> open = openTransfer(*mesh.mesh, order);
        std::vector<float> again;
        for (const float value : open)
            if (bounced > 0.0f)
                again.insert(again.end(), {bounced * value, 0.5f * bounced * value, 0.0f});
        bake->vertices.push_back({mesh.id, shCount(order), open, again});
    }
    return bake;
}

} // namespace patina::render
