#include "app/editor/job/LivePreview.h"

#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace patina::editor {
namespace {

// Transfer under an open sky: the clamped cosine about the normal, A_l / pi Y_lm(n)
// (docs/prt-format.md).
std::vector<float> openSkyTransfer(const BakeMesh& mesh, int order) {
    const glm::mat3 toWorld = glm::transpose(glm::inverse(glm::mat3(mesh.transform)));
    std::vector<float> result;
    result.reserve(mesh.mesh->vertexCount() * static_cast<std::size_t>(order * order));
    std::vector<float> basis(static_cast<std::size_t>(order * order));
    for (const glm::vec3& normal : mesh.mesh->normals) {
        evaluateSh(order, glm::normalize(toWorld * normal), basis);
        for (int l = 0; l < order; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                result.push_back(basis[static_cast<std::size_t>(i)] * shading::shCosineFactor(l) /
                                 shading::kPi);
    }
    return result;
}

} // namespace

void LivePreview::begin(const BakeInputs& inputs, int prtOrder, int textureSize) {
    std::map<Id, Surface> vertices, texels;
    for (const BakeMesh& mesh : inputs.meshes) {
        if (m_kind == BakeKind::PrtTexel) // not shown before it is complete
            continue;
        if (m_kind == BakeKind::AoTexel) {
            Surface& surface = texels[mesh.material];
            surface.values.assign(static_cast<std::size_t>(textureSize) *
                                      static_cast<std::size_t>(textureSize),
                                  1.0f);
            continue;
        }
        Surface& surface = vertices[mesh.id];
        if (m_kind == BakeKind::AoVertex) {
            surface.values.assign(mesh.mesh->vertexCount(), 1.0f);
            continue;
        }
        surface.stride = prtOrder * prtOrder;
        surface.values = openSkyTransfer(mesh, prtOrder);
    }
    const std::lock_guard lock(m_mutex);
    m_vertices = std::move(vertices);
    m_texels = std::move(texels);
    m_textureSize = textureSize;
}

void LivePreview::vertices(Id mesh, std::size_t first, int stride, std::span<const float> values) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_vertices.find(mesh);
    if (found == m_vertices.end() || found->second.stride != stride)
        return;
    const std::size_t offset = first * static_cast<std::size_t>(stride);
    if (offset + values.size() > found->second.values.size())
        return;
    std::copy(values.begin(), values.end(),
              found->second.values.begin() + static_cast<std::ptrdiff_t>(offset));
    found->second.changed = true;
}

void LivePreview::texels(Id material, int imageSize, int stride, int x, int y, int width,
                         std::span<const float> values) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_texels.find(material);
    if (found == m_texels.end() || imageSize != m_textureSize || stride != 1 || width <= 0)
        return;
    const int rows = static_cast<int>(values.size()) / width;
    if (x < 0 || y < 0 || x + width > imageSize || y + rows > imageSize)
        return;
    for (int row = 0; row < rows; ++row)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(row) * width, width,
                    found->second.values.begin() +
                        static_cast<std::ptrdiff_t>(y + row) * imageSize + x);
    found->second.changed = true;
}

void LivePreview::passDone(int samples) {
    const std::lock_guard lock(m_mutex);
    m_samplesDone = samples;
}

void LivePreview::hits(const std::shared_ptr<const HitSource>& hits) {
    const std::lock_guard lock(m_mutex);
    m_hits = hits;
}

std::shared_ptr<const HitSource> LivePreview::bounceHits() const {
    const std::lock_guard lock(m_mutex);
    return m_hits;
}

int LivePreview::samplesDone() const {
    const std::lock_guard lock(m_mutex);
    return m_samplesDone;
}

std::optional<BakeView> LivePreview::view() {
    const std::lock_guard lock(m_mutex);
    return m_view;
}

void LivePreview::setView(const BakeView& view) {
    const std::lock_guard lock(m_mutex);
    m_view = view;
}

bool LivePreview::changed() const {
    const std::lock_guard lock(m_mutex);
    const auto isChanged = [](const auto& surface) { return surface.second.changed; };
    return std::any_of(m_vertices.begin(), m_vertices.end(), isChanged) ||
           std::any_of(m_texels.begin(), m_texels.end(), isChanged);
}

bool LivePreview::collect(const VertexSink& vertices, const TexelSink& texels) {
    const std::lock_guard lock(m_mutex);
    bool any = false;
    for (auto& [mesh, surface] : m_vertices)
        if (surface.changed) {
            vertices(mesh, surface.stride, surface.values);
            surface.changed = false;
            any = true;
        }
    for (auto& [material, surface] : m_texels)
        if (surface.changed) {
            texels(material, m_textureSize, surface.values);
            surface.changed = false;
            any = true;
        }
    return any;
}

void LivePreview::setShown(bool shown) {
    if (shown && !m_shown)
        markAllChanged();
    m_shown = shown;
}

void LivePreview::markAllChanged() {
    const std::lock_guard lock(m_mutex);
    for (auto& [mesh, surface] : m_vertices)
        surface.changed = true;
    for (auto& [material, surface] : m_texels)
        surface.changed = true;
}

} // namespace patina::editor
