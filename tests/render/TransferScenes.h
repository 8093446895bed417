// Small scenes under radiance transfer, and the transfer of open surfaces in closed form.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
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

// From -1 to 1 in X and Z, facing up, in `cells` × `cells` squares.
[[nodiscard]] inline MeshPtr gridPlane(int cells) {
    Mesh mesh;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x) {
            const glm::vec2 uv(float(x) / float(cells), float(z) / float(cells));
            mesh.positions.push_back({2.0f * uv.x - 1.0f, 0.0f, 2.0f * uv.y - 1.0f});
            mesh.uvs.push_back(uv);
        }
    mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
    mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, 1});
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t z = 0; z + 1 < row; ++z)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t i = z * row + x;
            mesh.indices.insert(mesh.indices.end(),
                                {i, i + row, i + 1, i + 1, i + row, i + row + 1});
        }
    return std::make_shared<const Mesh>(std::move(mesh));
}

// A scene that only its own lights light: the environment is black.
class LocalLightsTest : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        if (!IsSkipped())
            sceneRenderer().setIbl(blackEnvironment());
    }
    static IblMaps blackEnvironment() {
        IblMaps maps;
        maps.prefiltered.push_back({1, std::vector<glm::vec3>(6, glm::vec3(0.0f))});
        maps.irradianceSh.fill(glm::vec3(0.0f));
        maps.radianceSh.fill(glm::vec3(0.0f));
        return maps;
    }
};

} // namespace patina::render
