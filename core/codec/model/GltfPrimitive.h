// The arrays of a primitive of glTF, from accessors or from a Draco stream.
#pragma once

#include "core/codec/model/DracoMesh.h"
#include "core/codec/model/GltfBuffers.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina::codec {

template <class T>
std::vector<T> regrouped(std::span<const float> values) {
    const auto* const first = reinterpret_cast<const T*>(values.data());
    return {first, first + values.size() / static_cast<std::size_t>(T::length())};
}

class GltfPrimitive {
  public:
    // Keeps references to both.
    GltfPrimitive(const nlohmann::json& source, const GltfBuffers& buffers);

    [[nodiscard]] const nlohmann::json& source() const { return m_source; }
    // Draco always yields single triangles.
    [[nodiscard]] bool compressed() const { return m_draco.has_value(); }
    [[nodiscard]] bool has(const std::string& attribute) const;

    // Empty when the primitive has no such attribute.
    template <class T>
    [[nodiscard]] std::vector<T> vectors(const std::string& attribute) const {
        constexpr int kComponents = T::length();
        if (m_draco && m_dracoIds.contains(attribute))
            return regrouped<T>(
                m_draco->floats(m_dracoIds.at(attribute).get<std::uint32_t>(), kComponents));
        if (!has(attribute))
            return {};
        const auto accessor = m_source.at("attributes").at(attribute).get<std::size_t>();
        if (const auto inPlace = m_buffers.floatsInPlace(accessor, kComponents); !inPlace.empty())
            return regrouped<T>(inPlace);
        return regrouped<T>(m_buffers.floats(accessor, kComponents));
    }
    [[nodiscard]] std::vector<std::uint32_t> indices() const;

  private:
    const nlohmann::json& m_source;
    const GltfBuffers& m_buffers;
    nlohmann::json m_dracoIds;
    std::optional<DracoMesh> m_draco;
};

} // namespace patina::codec
