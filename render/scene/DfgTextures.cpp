#include "render/scene/DfgTextures.h"

#include "core/light/DfgTable.h"
#include "core/math/Shading.h"

namespace patina::render {
namespace {

gl::Texture makeDfg(gl::Context& context, Distribution distribution, Visibility visibility) {
    const Image table = computeDfgTable(static_cast<int>(shading::kDfgTableSize), distribution,
                                        visibility, DfgTexels::ToTheEnds);
    gl::Texture texture(
        context, "DFG table",
        {.format = gl::PixelFormat::Rgba16f, .width = table.width(), .height = table.height()});
    texture.upload(0, table.channels(), gl::SampleType::F32, table.f32().data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

} // namespace

const gl::Texture& DfgTextures::of(const ShadingModel& model) {
    const std::pair terms(model.distribution, iblVisibility(model.visibility));
    auto known = m_tables.find(terms);
    if (known == m_tables.end())
        known = m_tables.emplace(terms, makeDfg(m_context, terms.first, terms.second)).first;
    return known->second;
}

std::size_t DfgTextures::memoryBytes() const {
    std::size_t bytes = 0;
    for (const auto& [terms, table] : m_tables)
        bytes += table.memoryBytes();
    return bytes;
}

} // namespace patina::render
