// The only file that sees Draco.
#include "core/codec/model/DracoMesh.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"

#include <draco/compression/decode.h>

namespace patina::codec {

struct DracoMesh::Impl {
    std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh(std::span<const std::byte> data)
    : m_impl(std::make_unique<Impl>()) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw Refusal("the file's compressed geometry is damaged; export or download it again",
                      "draco: " + decoded.status().error_msg_string());
    auto mesh = std::move(decoded).value();
    if (mesh->num_faces() > limits::kMaxTriangles || mesh->num_points() > 3 * limits::kMaxTriangles)
        throw Refusal("the model is larger than the supported 50 million triangles");
    m_impl->mesh = std::move(mesh);
}

DracoMesh::~DracoMesh() = default;

std::size_t DracoMesh::vertexCount() const {
    return m_impl->mesh->num_points();
}

std::vector<std::uint32_t> DracoMesh::indices() const {
    const draco::Mesh& mesh = *m_impl->mesh;
    std::vector<std::uint32_t> result;
    result.reserve(std::size_t{3} * mesh.num_faces());
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face))
            result.push_back(point.value());
    return result;
}

std::vector<float> DracoMesh::floats(std::uint32_t id, int components) const {
    const draco::PointAttribute* attribute = m_impl->mesh->GetAttributeByUniqueId(id);
    if (attribute == nullptr)
        throw Refusal("the file's compressed geometry is damaged; export it again",
                      "draco: an attribute is missing");
    const auto step = static_cast<std::size_t>(components);
    std::vector<float> result(vertexCount() * step, 0.0f);
    for (draco::PointIndex point(0); point < m_impl->mesh->num_points(); ++point) {
        const draco::AttributeValueIndex value = attribute->mapped_index(point);
        if (value.value() >= attribute->size() ||
            !attribute->ConvertValue<float>(value, static_cast<std::int8_t>(components),
                                            result.data() + point.value() * step))
            throw Refusal("the file's compressed geometry is damaged; export it again",
                          "draco: a value is out of range");
    }
    return result;
}

} // namespace patina::codec
