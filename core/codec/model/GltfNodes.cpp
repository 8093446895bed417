#include "core/codec/model/GltfNodes.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace patina::codec {

namespace {

using nlohmann::json;

constexpr std::size_t kNoParent = ~std::size_t{0};
constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

glm::mat4 composed(const glm::vec3& translation, const glm::quat& rotation,
                   const glm::vec3& scale) {
    return glm::translate(glm::mat4(1.0f), translation) * glm::mat4_cast(glm::normalize(rotation)) *
           glm::scale(glm::mat4(1.0f), scale);
}

} // namespace

glm::mat4 gltfTransform(const json& node) {
    if (const auto it = node.find("matrix"); it != node.end()) {
        glm::mat4 matrix(1.0f);
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = it->at(static_cast<std::size_t>(i)).get<float>();
        return matrix;
    }
    const auto numbers = [&](const char* key, std::array<float, 4> values, std::size_t count) {
        if (const auto it = node.find(key); it != node.end())
            for (std::size_t i = 0; i < count; ++i)
                values[i] = it->at(i).get<float>();
        return values;
    };
    const auto t = numbers("translation", {0, 0, 0, 0}, 3);
    const auto r = numbers("rotation", {0, 0, 0, 1}, 4);
    const auto s = numbers("scale", {1, 1, 1, 0}, 3);
    return composed({t[0], t[1], t[2]}, glm::quat(r[3], r[0], r[1], r[2]), {s[0], s[1], s[2]});
}

bool isFinite(const glm::mat4& matrix) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(matrix[i / 4][i % 4]))
            return false;
    return true;
}

std::optional<std::vector<glm::mat4>> gltfCopies(const json& node, const GltfBuffers& buffers) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end() || !extensions->contains(kInstancing))
        return std::nullopt;
    // All attributes, those of applications included, have one length: the number of copies.
    const json& attributes = (*extensions)[kInstancing].at("attributes");
    std::optional<std::size_t> copies;
    for (const json& accessor : attributes) {
        const std::size_t count = buffers.count(accessor.get<std::size_t>());
        if (copies.value_or(count) != count)
            throw Refusal("the file is damaged; export it again",
                          fmt::format("{}: attributes differ in length", kInstancing));
        copies = count;
    }
    if (!copies)
        return std::nullopt;
    // Before memory is taken: a few bytes may stand for any number of copies.
    if (*copies > limits::kMaxInstances)
        throw Refusal(fmt::format("the model has {} copies of one object, more than the supported "
                                  "{} objects; export it with fewer",
                                  *copies, limits::kMaxInstances));
    const auto floats = [&](const char* name, int components) {
        const auto it = attributes.find(name);
        return it == attributes.end() ? std::vector<float>()
                                      : buffers.floats(it->get<std::size_t>(), components);
    };
    const std::vector<float> t = floats("TRANSLATION", 3), r = floats("ROTATION", 4),
                             s = floats("SCALE", 3);
    const auto vectorOf = [](const std::vector<float>& values, std::size_t i, float absent) {
        return values.empty() ? glm::vec3(absent)
                              : glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    std::vector<glm::mat4> result;
    result.reserve(*copies);
    for (std::size_t i = 0; i < *copies; ++i)
        result.push_back(
            composed(vectorOf(t, i, 0.0f),
                     r.empty() ? glm::quat(1, 0, 0, 0)
                               : glm::quat(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]),
                     vectorOf(s, i, 1.0f)));
    return result;
}

GltfNodes::GltfNodes(const json& root)
    : m_root(root) {
    const auto nodes = root.find("nodes");
    const std::size_t count = nodes == root.end() ? 0 : nodes->size();
    m_parents.assign(count, kNoParent);
    m_worlds.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        for (const json& child : (*nodes)[i].value("children", json::array()))
            if (const auto c = child.get<std::size_t>(); c < count && m_parents[c] == kNoParent)
                m_parents[c] = i;
}

const glm::mat4& GltfNodes::world(std::size_t node) {
    (void)element(m_root, "nodes", node);
    // From the node up to one whose transform is known, and down again.
    std::vector<std::size_t> chain;
    for (std::size_t i = node; i != kNoParent && !m_worlds[i]; i = m_parents[i]) {
        chain.push_back(i);
        if (chain.size() > m_worlds.size())
            throw Refusal("the file is damaged: a node contains itself; export it again");
    }
    for (; !chain.empty(); chain.pop_back()) {
        const std::size_t i = chain.back();
        const glm::mat4 own = gltfTransform(m_root["nodes"][i]);
        m_worlds[i] = m_parents[i] == kNoParent ? own : *m_worlds[m_parents[i]] * own;
    }
    return *m_worlds[node];
}

} // namespace patina::codec
