// Bakes that have been computed before, kept in a folder: one file per bake, named by the hash of
// its inputs, its settings and the version of the algorithm. Undo, or a scene opened again, then
// finds its bake without tracing a ray.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/base/CacheFolder.h"
#include "core/trace/BakeInputs.h"

#include <optional>

namespace patina {

class BakeCache {
  public:
    static constexpr std::uint64_t kDefaultBytes = std::uint64_t{2} << 30;

    // `maxBytes`: what its files may hold together. Files are as large as the bakes in memory.
    explicit BakeCache(std::filesystem::path folder, std::uint64_t maxBytes = kDefaultBytes);

    [[nodiscard]] static Hash key(const BakeRequest& request, const BakeInputs& inputs);

    // With the ids of `inputs`' meshes and materials, whatever they were when it was stored.
    [[nodiscard]] std::optional<BakeArtifact> find(const Hash& key, const BakeInputs& inputs) const;

    // A bake that is complete, of these inputs. Errors: CannotCreate, Io; the bake is still good.
    Result<void> store(const Hash& key, const BakeInputs& inputs,
                       const BakeArtifact& artifact) const;

    [[nodiscard]] std::filesystem::path file(const Hash& key) const { return m_files.file(key); }

  private:
    CacheFolder m_files;
};

} // namespace patina
