// The hits of the rays of the bake that ended last, until whoever follows its bounces takes them.
// They belong to a bake, not to a moment: it does not matter who hears first that it is attached.
#pragma once

#include "core/bake/bounce/HitCache.h"
#include "core/bake/domain/BakeArtifact.h"

#include <memory>
#include <utility>

namespace patina::editor {

class FinishedHits {
  public:
    // Null: it has none. Those of the bake before are dropped: hits are large.
    void keep(const BakeArtifactPtr& bake, std::shared_ptr<const HitSource> hits) {
        m_bake = bake;
        m_hits = std::move(hits);
    }
    // Once; null where there are none of this bake.
    [[nodiscard]] std::shared_ptr<const HitSource> take(const BakeArtifactPtr& bake) {
        return bake && m_bake.lock() == bake ? std::exchange(m_hits, nullptr) : nullptr;
    }

  private:
    std::weak_ptr<const BakeArtifact> m_bake;
    std::shared_ptr<const HitSource> m_hits;
};

} // namespace patina::editor
