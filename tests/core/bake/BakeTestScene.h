// Scenes and recorders for bake tests.
#pragma once

#include "core/bake/Bake.h"
#include "tests/core/mesh/Shapes.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <mutex>
#include <set>
#include <vector>

namespace patina::test {

// Meshes get the ids 1, 2, … and material 1 unless they say otherwise.
inline BakeInputs sceneOf(std::vector<Mesh> meshes, const glm::mat4& transform = glm::mat4(1.0f)) {
    BakeInputs inputs;
    for (Mesh& mesh : meshes) {
        BakeMesh& added = inputs.meshes.emplace_back();
        added.id = static_cast<Id>(inputs.meshes.size());
        added.material = 1;
        added.mesh = std::make_shared<const Mesh>(sanitized(std::move(mesh)));
        added.transform = transform;
    }
    return inputs;
}

// The index of the vertex closest to `point`.
inline std::size_t vertexAt(const Mesh& mesh, const glm::vec3& point) {
    const auto nearest = std::min_element(
        mesh.positions.begin(), mesh.positions.end(), [&](const glm::vec3& a, const glm::vec3& b) {
            return glm::distance(a, point) < glm::distance(b, point);
        });
    return static_cast<std::size_t>(nearest - mesh.positions.begin());
}

// A flat disc at `height` over the origin, parallel to the floor.
inline Mesh discMesh(double radius, double height) {
    return gridMesh(256, 1, [=](double u, double v) {
        const double a = 2 * kPi * wrapped(u);
        return glm::dvec3(radius * v * std::sin(a), height, radius * v * std::cos(a));
    });
}

// The inside of the lower half of a sphere of radius 1: faces and normals point to the centre.
inline Mesh bowlMesh(int columns, int rows) {
    Mesh mesh = gridMesh(columns, rows, [](double u, double v) {
        const double phi = 2 * kPi * wrapped(u), theta = 0.5 * kPi * v;
        return glm::dvec3(std::sin(theta) * std::sin(phi), -std::cos(theta),
                          std::sin(theta) * std::cos(phi));
    });
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        if (glm::dot(
                glm::cross(mesh.positions[mesh.indices[i + 1]] - mesh.positions[mesh.indices[i]],
                           mesh.positions[mesh.indices[i + 2]] - mesh.positions[mesh.indices[i]]),
                mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] +
                    mesh.positions[mesh.indices[i + 2]]) > 0.0f)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (const glm::vec3& position : mesh.positions) // exact, also at the rim
        mesh.normals.push_back(-glm::normalize(position));
    return mesh;
}

// Keeps what a bake sends.
class Recorder : public TileSink {
  public:
    void vertices(Id mesh, std::size_t first, int stride, std::span<const float> values) override {
        const std::lock_guard lock(m_mutex);
        std::vector<float>& all = m_vertices[mesh];
        const std::size_t begin = first * static_cast<std::size_t>(stride);
        all.resize(std::max(all.size(), begin + values.size()));
        std::copy(values.begin(), values.end(), all.begin() + static_cast<std::ptrdiff_t>(begin));
        ++m_calls;
        if (onTile)
            onTile(m_passes.size());
    }
    void texels(Id material, int imageSize, int stride, int x, int y, int width,
                std::span<const float> values) override {
        const std::lock_guard lock(m_mutex);
        std::map<int, float>& all = m_texels[material]; // the first float of each texel
        for (int i = 0; i < width; ++i)
            all[y * imageSize + x + i] = values[static_cast<std::size_t>(i * stride)];
        if (onTile)
            onTile(m_passes.size());
    }
    void passDone(int samples) override {
        const std::lock_guard lock(m_mutex);
        m_passes.push_back(samples);
        if (onPass)
            onPass(samples);
    }

    std::function<void(std::size_t passesDone)> onTile;
    std::function<void(int samples)> onPass;
    std::map<Id, std::vector<float>> m_vertices;
    std::map<Id, std::map<int, float>> m_texels;
    std::vector<int> m_passes;
    int m_calls = 0;

  private:
    std::mutex m_mutex;
};

inline BakeArtifact aoOf(const BakeInputs& inputs, int samples, float maxDistance = 0.0f) {
    TileSink sink;
    AoSettings settings;
    settings.samples = samples;
    settings.maxDistance = maxDistance;
    Result<BakeArtifact> artifact = bakeAoVertex(inputs, settings, sink, {});
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

// Of the first mesh.
inline std::vector<float> aoValues(const BakeInputs& inputs, int samples) {
    return aoOf(inputs, samples).vertices.at(0).values;
}

// At the very vertices, unless `fitted`.
inline BakeArtifact prtOf(const BakeInputs& inputs, int order, int samples, bool fitted = false) {
    TileSink sink;
    PrtSettings settings;
    settings.fitted = fitted;
    settings.order = order;
    settings.samples = samples;
    Result<BakeArtifact> artifact = bakePrtVertex(inputs, settings, sink, {});
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

// The value of the vertex of mesh `m` next to `point` (mesh space).
inline float valueAt(const BakeArtifact& artifact, const BakeInputs& inputs, std::size_t m,
                     const glm::vec3& point) {
    return artifact.vertices.at(m).values.at(vertexAt(*inputs.meshes.at(m).mesh, point));
}

} // namespace patina::test
