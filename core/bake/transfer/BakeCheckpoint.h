// A bake that is under way as a file: the checkpoint that it goes on from after a crash, or the
// part that one shard of it computed. docs/prt-format.md does not describe these files: they are
// read by the program that wrote them.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/bake/transfer/Passes.h"
#include "core/base/Result.h"
#include "core/base/StateFile.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

// What a checkpoint belongs to. Two files go together when kind, settings, hashes, storage, points
// and ranges are equal.
struct BakeManifest {
    BakeKind kind = BakeKind::PrtVertex;
    std::map<std::string, std::string> settings; // as text (core/bake/domain/BakeOptions.h)
    Hash inputs;                                 // hashBakeInputs()
    Hash albedo;                                 // hashBakeAlbedo() when light bounces, or zero
    Hash light;                                  // hashLightMapLight() of a light map, or zero
    std::string scene;             // what to open to go on: absolute path or builtin:NAME
    std::vector<std::string> sets; // and the parameters to set in it: NAME=VALUE
    // Of a light map: what lights the scene in place of its own environment, an absolute path or
    // builtin:NAME, and that image's layout by name. Empty: the scene's own; guessed.
    std::string environment, environmentLayout;
    BakeFileOptions storage; // how the bake is to be written at last
    PassShard shard;
    std::uint64_t points = 0, ranges = 0; // of the whole bake
    bool complete = false;                // every point of the shard is done
    int samplesDone = 0;
    double done = 0.0; // share of the shard's rays that are cast, 0…1; to a tolerance of those that
                       // it would take at most
    friend bool operator==(const BakeManifest&, const BakeManifest&) = default;
};

// What makes the two differ, for the user: "samples (64 there, 128 here)"; nothing when they may
// belong to one bake.
[[nodiscard]] std::optional<std::string> whyDifferent(const BakeManifest& there,
                                                      const BakeManifest& here);

// Writes the points of manifest.shard in one step, without a copy of them. Errors: those of
// writeFileAtomically().
Result<void> writeBakeCheckpoint(const std::filesystem::path& file, const BakeManifest& manifest,
                                 const PassState& state, std::span<const PointRange> ranges,
                                 StateFileName name = StateFileName::Own);

// Whether a file begins as checkpoints and parts do.
[[nodiscard]] bool looksLikeCheckpoint(const std::filesystem::path& file);

// The manifest alone. Errors: InputMissing; InputBroken for a file that is none, of another
// version, truncated or edited.
Result<BakeManifest> readBakeManifest(const std::filesystem::path& file);

// Puts the points of the file's shard into `state`, which has room for all of them or is empty;
// state.samplesDone becomes the file's. Errors: as above, and InputBroken when `ranges` and
// `stride` (values per point) are not those of the file.
Result<void> readBakeState(const std::filesystem::path& file, std::span<const PointRange> ranges,
                           int stride, PassState& state);

// Keeps the checkpoint of a running bake. A checkpoint that cannot be written (disk full) is a
// warning; the bake goes on and tries again at the next one.
class Checkpointer {
  public:
    using Warn = std::function<void(const Error&)>; // from the thread that calls write(), once
    Checkpointer(std::filesystem::path file, BakeManifest manifest,
                 std::span<const PointRange> ranges, Warn warn);

    // `done`: as in the manifest. False when it could not be written.
    bool write(const PassState& state, bool complete, double done);

  private:
    std::filesystem::path m_file;
    BakeManifest m_manifest;
    std::span<const PointRange> m_ranges;
    Warn m_warn;
    bool m_warned = false;
};

} // namespace patina
