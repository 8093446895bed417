#include "render/scene/VertexValues.h"

#include "core/base/Check.h"

#include <algorithm>

namespace patina::render {

namespace {

VertexValues::Values upload(gl::Context& context, int stride, std::span<const float> values) {
    CHECK(stride > 0 && !values.empty());
    return {gl::Buffer::of<float>(context, "vertex bake", values), stride,
            values.size() / static_cast<std::size_t>(stride)};
}

} // namespace

void VertexValues::update(const Document& document) {
    const auto found = std::find_if(document.bakes.begin(), document.bakes.end(),
                                    [&](const auto& bake) { return bake->kind == m_kind; });
    BakeArtifactPtr artifact = found == document.bakes.end() ? nullptr : *found;
    if (artifact == m_artifact)
        return;
    m_artifact = std::move(artifact);
    m_attached.clear();
    if (!m_artifact)
        return;
    for (const VertexBake& bake : m_artifact->vertices)
        if (!bake.values.empty())
            m_attached[bake.mesh] = upload(m_context, bake.stride, bake.values);
}

void VertexValues::preview(Id mesh, int stride, std::span<const float> values) {
    if (values.empty())
        return;
    Values& shown = m_previews[mesh];
    if (shown.stride == stride && shown.buffer.size() == values.size_bytes())
        shown.buffer.write(0, std::as_bytes(values));
    else
        shown = upload(m_context, stride, values);
}

const VertexValues::Values* VertexValues::find(Id mesh, std::size_t vertexCount) const {
    for (const auto* all : {&m_previews, &m_attached}) {
        const auto found = all->find(mesh);
        if (found != all->end())
            return found->second.count == vertexCount ? &found->second : nullptr;
    }
    return nullptr;
}

} // namespace patina::render
