#include "core/codec/model/GltfPrimitive.h"

namespace patina::codec {

GltfPrimitive::GltfPrimitive(const nlohmann::json& source, const GltfBuffers& buffers)
    : m_source(source)
    , m_buffers(buffers) {
    const auto extensions = source.find("extensions");
    if (extensions == source.end() || !extensions->contains("KHR_draco_mesh_compression"))
        return;
    const nlohmann::json& draco = (*extensions)["KHR_draco_mesh_compression"];
    m_dracoIds = draco.at("attributes");
    m_draco.emplace(buffers.view(draco.at("bufferView").get<std::size_t>()));
}

bool GltfPrimitive::has(const std::string& attribute) const {
    return m_source.at("attributes").contains(attribute);
}

std::vector<std::uint32_t> GltfPrimitive::indices() const {
    if (m_draco)
        return m_draco->indices();
    const auto it = m_source.find("indices");
    return it == m_source.end() ? std::vector<std::uint32_t>()
                                : m_buffers.indices(it->get<std::size_t>());
}

} // namespace patina::codec
