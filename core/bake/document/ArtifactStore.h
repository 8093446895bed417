// The bakes that a scene has had, in memory, by what they were made from: where undo leads back to
// the geometry of an earlier bake, that bake is there again, without a ray being traced.
#pragma once

#include "core/bake/domain/BakeArtifact.h"

#include <cstddef>
#include <list>

namespace patina {

class ArtifactStore {
  public:
    static constexpr std::size_t kDefaultBytes = std::size_t{512} << 20;

    // `maxBytes`: of all that is kept (artifactBytes()); those that were kept longest ago go first.
    explicit ArtifactStore(std::size_t maxBytes = kDefaultBytes)
        : m_maxBytes(maxBytes) {}

    // In place of one of the same kind and inputs. One that is larger than the store is not kept.
    void keep(const BakeArtifactPtr& bake); // not null
    // Null: none is kept. `inputs`: hashBakeInputs() of the scene.
    [[nodiscard]] BakeArtifactPtr find(BakeKind kind, const Hash& inputs) const;
    void clear();
    void free(std::size_t most); // those kept longest ago go until the others take so much
    [[nodiscard]] std::size_t bytes() const { return m_bytes; }

  private:
    const std::size_t m_maxBytes;
    std::list<BakeArtifactPtr> m_bakes; // the oldest first
    std::size_t m_bytes = 0;
};

} // namespace patina
