#include "render/scene/TransferValues.h"

#include "core/base/Check.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace patina::render {

namespace {

constexpr float kOneOverY00 = 3.5449077018f; // 2 sqrt(pi)

// Vectors of four for each element and channel; `channels` interleaved in `values`, one after
// another in the result.
std::vector<glm::vec4> inVectors(std::span<const float> values, int stride, int channels) {
    const auto count = values.size() / static_cast<std::size_t>(stride * channels);
    const auto vectors = static_cast<std::size_t>((stride + 3) / 4);
    std::vector<glm::vec4> result(count * vectors * static_cast<std::size_t>(channels),
                                  glm::vec4(0.0f));
    const float* from = values.data();
    glm::vec4* to = result.data();
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < stride; ++k)
            for (int c = 0; c < channels; ++c)
                to[static_cast<std::size_t>(c) * vectors + static_cast<std::size_t>(k / 4)][k % 4] =
                    *from++;
        to += vectors * static_cast<std::size_t>(channels);
    }
    return result;
}

// Band 1 is the mean of sqrt(3 / 4 pi) (-y, z, -x) over the light of a uniform environment.
std::vector<glm::vec4> cones(std::span<const float> values, int stride) {
    const auto step = static_cast<std::size_t>(stride);
    std::vector<glm::vec4> result(values.size() / step);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float* t = values.data() + i * step;
        const glm::vec3 bent = stride >= 4 ? glm::vec3(-t[3], -t[1], t[2]) : glm::vec3(0.0f);
        result[i] = glm::vec4(bent, t[0] * kOneOverY00);
    }
    return result;
}

gl::Texture texels(gl::Context& context, const char* label, gl::PixelFormat format, int channels,
                   int side, const void* data) {
    gl::Texture texture(context, label, {.format = format, .width = side, .height = side});
    texture.upload(0, channels, gl::SampleType::F32, data);
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
    return texture;
}

} // namespace

std::size_t LitElements::stageIndex(LightingMode mode) {
    return static_cast<std::size_t>(mode) - static_cast<std::size_t>(LightingMode::Unshadowed);
}

int Transfer::order() const {
    int order = 1;
    while ((order + 1) * (order + 1) <= stride)
        ++order;
    return order;
}

Transfer TransferValues::upload(int stride, std::span<const float> values,
                                std::span<const float> bounced, std::span<const float> sky,
                                std::span<const float> error, int side) {
    CHECK(stride > 0 && !values.empty());
    Transfer transfer;
    transfer.stride = stride;
    transfer.side = side;
    transfer.count = values.size() / static_cast<std::size_t>(stride);
    transfer.revision = ++m_revision;
    transfer.direct =
        gl::Buffer::of<glm::vec4>(m_context, "transfer", inVectors(values, stride, 1));
    if (bounced.size() == 3 * values.size())
        transfer.bounced =
            gl::Buffer::of<glm::vec4>(m_context, "bounced transfer", inVectors(bounced, stride, 3));
    std::vector<glm::vec2> numbers;
    if (sky.size() == transfer.count || error.size() == transfer.count) {
        numbers.resize(transfer.count, glm::vec2(0.0f));
        for (std::size_t i = 0; i < transfer.count; ++i)
            numbers[i] = {error.empty() ? 0.0f : error[i], sky.empty() ? 0.0f : sky[i]};
    }
    const std::vector<glm::vec4> cone = cones(values, stride);
    if (side == 0) {
        transfer.cone = gl::Buffer::of<glm::vec4>(m_context, "visible cones", cone);
        if (!numbers.empty())
            transfer.numbers = gl::Buffer::of<glm::vec2>(m_context, "bake numbers", numbers);
        return transfer;
    }
    transfer.coneTexels =
        texels(m_context, "visible cones", gl::PixelFormat::Rgba16f, 4, side, cone.data());
    if (!numbers.empty())
        transfer.numberTexels =
            texels(m_context, "bake numbers", gl::PixelFormat::Rg32f, 2, side, numbers.data());
    return transfer;
}

bool TransferValues::update(const Document& document) {
    BakeArtifactPtr vertices = findBake(document, BakeKind::PrtVertex);
    BakeArtifactPtr texels = findBake(document, BakeKind::PrtTexel);
    const bool changed = vertices != m_vertexBake || texels != m_texelBake;
    if (vertices != m_vertexBake) {
        m_vertexBake = std::move(vertices);
        m_attached.clear();
        if (m_vertexBake)
            for (const VertexBake& b : m_vertexBake->vertices)
                if (!b.values.empty())
                    m_attached[b.mesh] = upload(b.stride, b.values, b.bounced, b.sky, b.error, 0);
    }
    if (texels != m_texelBake) {
        m_texelBake = std::move(texels);
        m_attachedTexels.clear();
        if (m_texelBake)
            for (const TexelBake& b : m_texelBake->texels)
                if (!b.values.empty())
                    m_attachedTexels[b.material] =
                        upload(b.stride, b.values, b.bounced, b.sky, b.error, b.side);
    }
    return changed;
}

void TransferValues::preview(Id mesh, int stride, std::span<const float> values) {
    if (!values.empty())
        m_previews[mesh] = upload(stride, values, {}, {}, {}, 0);
}

const Transfer* TransferValues::ofMesh(Id mesh, std::size_t vertexCount) const {
    for (const auto* all : {&m_previews, &m_attached})
        if (const auto found = all->find(mesh); found != all->end())
            return found->second.count == vertexCount ? &found->second : nullptr;
    return nullptr;
}

const Transfer* TransferValues::ofMaterial(Id material) const {
    const auto found = m_attachedTexels.find(material);
    return found == m_attachedTexels.end() ? nullptr : &found->second;
}

} // namespace patina::render
