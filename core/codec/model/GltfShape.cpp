#include "core/codec/model/GltfShape.h"

#include "core/codec/Codec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace patina::codec {

namespace {

using nlohmann::json;

template <class T>
std::span<float> asFloats(std::vector<T>& vectors) {
    return {reinterpret_cast<float*>(vectors.data()), vectors.size() * (sizeof(T) / sizeof(float))};
}

// Transforms as the inverse of the transpose does, up to a factor, and where there is no inverse.
glm::mat3 normalMatrix(const glm::mat3& m, float determinant) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                              glm::cross(m[0], m[1]));
    return determinant < 0.0f ? -cofactors : cofactors;
}

} // namespace

void GltfShaper::note(const std::string& mesh, const char* what) {
    m_notes.insert(fmt::format("Mesh \"{}\": {}.", mesh, what));
}

GltfShape GltfShaper::shapeOf(const json& node) {
    GltfShape shape;
    shape.mesh = node.at("mesh").get<std::size_t>();
    if (const auto skin = node.find("skin"); skin != node.end())
        shape.skin = skin->get<std::size_t>();
    const json& mesh = element(m_root, "meshes", shape.mesh);
    const json& owner = node.contains("weights") ? node : mesh;
    if (const auto weights = owner.find("weights"); weights != owner.end())
        for (const json& weight : *weights)
            shape.weights.push_back(weight.get<float>());
    for (float& weight : shape.weights)
        if (!std::isfinite(weight)) {
            weight = 0.0f;
            note(mesh.value("name", fmt::format("mesh {}", shape.mesh + 1)),
                 "a morph target whose weight is not finite was left out");
        }
    while (!shape.weights.empty() && shape.weights.back() == 0.0f)
        shape.weights.pop_back();
    return shape;
}

void GltfShaper::morph(Mesh& mesh, const GltfPrimitive& primitive, const GltfShape& shape) {
    const json targets = primitive.source().value("targets", json::array());
    if (shape.weights.size() > targets.size())
        note(mesh.name, "it has more weights than morph targets; the others were left out");
    for (std::size_t i = 0; i < std::min(shape.weights.size(), targets.size()); ++i) {
        const float weight = shape.weights[i];
        if (weight == 0.0f)
            continue;
        const auto add = [&]<class T>(std::vector<T>& vectors, const char* attribute) {
            const auto accessor = targets[i].find(attribute);
            if (accessor == targets[i].end() || vectors.empty())
                return;
            const auto index = accessor->template get<std::size_t>();
            if (m_buffers.count(index) != vectors.size()) {
                note(mesh.name, "a morph target that does not have one value for each vertex was "
                                "left out");
                return;
            }
            // A tangent's displacement has no fourth component.
            const std::vector<float> values = m_buffers.displacements(index);
            const std::span<float> sums = asFloats(vectors);
            constexpr std::size_t kStep = sizeof(T) / sizeof(float);
            for (std::size_t v = 0; v < vectors.size(); ++v)
                for (std::size_t c = 0; c < 3; ++c)
                    sums[v * kStep + c] += weight * values[v * 3 + c];
        };
        add(mesh.positions, "POSITION");
        add(mesh.normals, "NORMAL");
        add(mesh.tangents, "TANGENT");
    }
}

const std::vector<glm::mat4>& GltfShaper::jointMatrices(std::size_t index) {
    if (const auto known = m_joints.find(index); known != m_joints.end())
        return known->second;
    const json& skin = element(m_root, "skins", index);
    const json& joints = skin.at("joints");
    std::vector<float> inverse;
    if (const auto accessor = skin.find("inverseBindMatrices"); accessor != skin.end()) {
        inverse = m_buffers.matrices(accessor->get<std::size_t>());
        if (inverse.size() / 16 < joints.size())
            throw Refusal("the file is damaged; export it again",
                          "a skin has fewer matrices than joints");
    }
    std::vector<glm::mat4> matrices;
    for (std::size_t k = 0; k < joints.size(); ++k) {
        glm::mat4 bind(1.0f);
        for (int i = 0; i < 16 && !inverse.empty(); ++i)
            bind[i / 4][i % 4] = inverse[16 * k + static_cast<std::size_t>(i)];
        matrices.push_back(m_nodes.world(joints[k].get<std::size_t>()) * bind);
    }
    return m_joints[index] = std::move(matrices);
}

// The matrix of each vertex: the mean of its joints' by their weights, over all sets of four.
std::vector<glm::mat4> GltfShaper::vertexMatrices(const Mesh& mesh, const GltfPrimitive& primitive,
                                                  const std::vector<glm::mat4>& joints) {
    constexpr const char* kNoJoint = "what follows joints that do not exist was left out";
    const std::size_t count = mesh.positions.size();
    std::vector<glm::mat4> sums;
    std::vector<float> first; // joint of each vertex
    const auto has = [&](float joint) {
        return joint >= 0.0f && joint < static_cast<float>(joints.size());
    };
    for (int set = 0;; ++set) {
        const auto indices = primitive.vectors<glm::vec4>(fmt::format("JOINTS_{}", set));
        const auto weights = primitive.vectors<glm::vec4>(fmt::format("WEIGHTS_{}", set));
        if (indices.empty() || weights.empty())
            break;
        if (indices.size() != count || weights.size() != count)
            throw Refusal("the file is damaged; export it again",
                          "joints, weights and POSITION differ in length");
        sums.resize(count, glm::mat4(0.0f));
        for (std::size_t v = 0; v < count; ++v)
            for (int k = 0; k < 4; ++k) {
                const float weight = weights[v][k];
                if (!(weight >= 0.0f) || !std::isfinite(weight)) {
                    note(mesh.name, "joint weights that are negative or not finite were left out");
                } else if (weight > 0.0f && has(indices[v][k])) {
                    sums[v] += weight * joints[static_cast<std::size_t>(indices[v][k])];
                } else if (weight > 0.0f) {
                    note(mesh.name, kNoJoint);
                    sums[v] += glm::mat4(std::numeric_limits<float>::quiet_NaN());
                }
            }
        if (set == 0)
            for (const glm::vec4& joint : indices)
                first.push_back(joint.x);
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        // The weights should add up to 1, which those of few bits cannot.
        if (const float total = sums[v][3][3]; total != 0.0f) {
            sums[v] /= total;
            continue;
        }
        note(mesh.name, "vertices without joint weights follow their first joint");
        sums[v] = has(first[v]) ? joints[static_cast<std::size_t>(first[v])]
                                : glm::mat4(std::numeric_limits<float>::quiet_NaN());
    }
    return sums;
}

bool GltfShaper::skin(Mesh& mesh, const GltfPrimitive& primitive, const GltfShape& shape) {
    if (shape.skin == GltfShape::kNoSkin)
        return false;
    const std::vector<glm::mat4>& joints = jointMatrices(shape.skin);
    for (const glm::mat4& joint : joints)
        if (!isFinite(joint))
            note(mesh.name, "a joint's transform is not finite; what follows it was left out");
    const std::vector<glm::mat4> matrices = vertexMatrices(mesh, primitive, joints);
    if (matrices.empty())
        return false;

    std::vector<bool> mirrored(matrices.size());
    for (std::size_t v = 0; v < matrices.size(); ++v) {
        const glm::mat3 linear(matrices[v]);
        const float determinant = glm::determinant(linear);
        mirrored[v] = determinant < 0.0f;
        mesh.positions[v] = glm::vec3(matrices[v] * glm::vec4(mesh.positions[v], 1.0f));
        if (!mesh.normals.empty())
            mesh.normals[v] = normalMatrix(linear, determinant) * mesh.normals[v];
        if (!mesh.tangents.empty())
            mesh.tangents[v] = glm::vec4(linear * glm::vec3(mesh.tangents[v]),
                                         mirrored[v] ? -mesh.tangents[v].w : mesh.tangents[v].w);
    }
    // Joints that mirror turn the winding, as nodes do.
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        int turned = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            turned += mesh.indices[k] < mirrored.size() && mirrored[mesh.indices[k]] ? 1 : 0;
        if (turned > 1)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    return true;
}

} // namespace patina::codec
