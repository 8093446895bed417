// The parts that the shards of a bake computed, joined to the state of the whole.
#pragma once

#include "core/bake/transfer/BakeCheckpoint.h"
#include "core/bake/transfer/BakeTracer.h"

#include <filesystem>
#include <span>
#include <vector>

namespace patina {

struct BakePart {
    std::filesystem::path file;
    BakeManifest manifest;
};

// The parts in the order of their shards. Errors: those of readBakeManifest(); InputBroken, naming
// the file, for parts of different bakes, the same part twice, an unfinished one; and when one is
// missing.
Result<std::vector<BakePart>> readBakeParts(std::span<const std::filesystem::path> files);

// Takes what the points saw from the parts, in the order of their shards, without a ray. Errors:
// those of readBakeState(); InputBroken when the parts belong to another scene.
class JoiningTracer : public BakeTracer {
  public:
    // `here`: the manifest of the bake to be made; its shard, points and ranges do not matter.
    JoiningTracer(std::span<const BakePart> parts, BakeManifest here)
        : m_parts(parts)
        , m_here(std::move(here)) {}
    Result<std::optional<PassState>> trace(const PassWork& work) override;

  private:
    std::span<const BakePart> m_parts;
    BakeManifest m_here;
};

} // namespace patina
