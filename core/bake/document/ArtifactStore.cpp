#include "core/bake/document/ArtifactStore.h"

#include "core/base/Check.h"

#include <algorithm>

namespace patina {

void ArtifactStore::keep(const BakeArtifactPtr& bake) {
    CHECK(bake != nullptr);
    const std::size_t size = artifactBytes(*bake);
    if (size > m_maxBytes)
        return;
    m_bakes.remove_if([&](const BakeArtifactPtr& known) {
        const bool replaced = known->kind == bake->kind && known->inputs == bake->inputs;
        m_bytes -= replaced ? artifactBytes(*known) : 0;
        return replaced;
    });
    m_bakes.push_back(bake);
    m_bytes += size;
    free(m_maxBytes);
}

void ArtifactStore::free(std::size_t most) {
    while (m_bytes > most) {
        m_bytes -= artifactBytes(*m_bakes.front());
        m_bakes.pop_front();
    }
}

BakeArtifactPtr ArtifactStore::find(BakeKind kind, const Hash& inputs) const {
    const auto found = std::ranges::find_if(m_bakes, [&](const BakeArtifactPtr& bake) {
        return bake->kind == kind && bake->inputs == inputs;
    });
    return found != m_bakes.end() ? *found : nullptr;
}

void ArtifactStore::clear() {
    m_bakes.clear();
    m_bytes = 0;
}

} // namespace patina
