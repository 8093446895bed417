#include "core/codec/model/GltfShape.h"

#include "core/codec/Codec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <span>

namespace patina::codec {

namespace {

using nlohmann::json;

template <class T>
std::span<float> asFloats(std::vector<T>& vectors) {
    return {reinterpret_cast<float*>(vectors.data()), vectors.size() * (sizeof(T) / sizeof(float))};
}

} // namespace

void GltfShaper::note(const std::string& mesh, const char* what) {
    m_notes.insert(fmt::format("Mesh \"{}\": {}.", mesh, what));
}

GltfShape GltfShaper::shapeOf(const json& node) {
    GltfShape shape;
    shape.mesh = node.at("mesh").get<std::size_t>();
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

} // namespace patina::codec
