// A radiosity that is under way as a file: the checkpoint that it goes on from after a crash, or
// the part that one shard of it found. They hold values as they are in memory, so that a solution
// that was split or resumed ends in the very bytes of one that was not. docs/maths/radiosity.md has
// the layout.
#pragma once

#include "core/base/Hash.h"
#include "core/base/Result.h"
#include "core/base/StateFile.h"
#include "core/radiosity/SolveKeeper.h"
#include "core/trace/path/TraceHash.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace patina::radiosity {

// What a file belongs to. Two go together when settings, inputs and elements are equal; parts, when
// options are, too.
struct RadiosityManifest {
    StateSettings settings;        // how it is divided, lit and solved, by the options' names
    StateSettings options;         // how it is to be written, and where its light is
    TraceHash inputs;              // of the scene
    Hash elements;                 // hashElements()
    std::string scene;             // what was opened: absolute path or builtin:NAME
    std::vector<std::string> sets; // and the parameters that were set in it: NAME=VALUE
    ElementShard shard;
    bool complete = false; // light and rows of all of the shard's elements are there
    // How far it is.
    std::uint64_t elementCount = 0;     // of the whole
    std::uint64_t lit = 0, rows = 0;    // elements of the shard whose light, whose row is there
    std::uint64_t shares = 0;           // of these rows
    std::vector<std::uint64_t> divided; // elements that each round of a division divided
    bool divisionDone = false;          // it was the last round
    std::uint64_t steps = 0;            // that the solver has made
    std::uint64_t iterations = 0;       // shots or sweeps of them
    double residual = 0.0;              // after the last step
    bool ended = false;                 // it was the last step
    bool shootAgain = false;            // SolverState::shootAgain
    friend bool operator==(const RadiosityManifest&, const RadiosityManifest&) = default;
};

// What elements are; what form factors follow from, on this machine.
[[nodiscard]] Hash hashElements(const ElementMesh& elements);
// And how light is sampled on them; what direct light follows from, too.
[[nodiscard]] Hash hashElements(const TraceScene& scene, const ElementMesh& elements);

// What makes the two differ, for the user: "resolution (64 there, 128 here)"; nothing when they may
// belong to one solution. Elements are compared where both are known.
[[nodiscard]] std::optional<std::string> whyDifferent(const RadiosityManifest& there,
                                                      const RadiosityManifest& here);

// Writes the elements of manifest.shard in one step, rows from where they are in memory; other
// threads may find more meanwhile. What the manifest says of how far it is follows from the rest.
// Errors: those of writeFileAtomically().
Result<void> writeRadiosity(const std::filesystem::path& file, RadiosityManifest manifest,
                            const SolveState& state, const SolverView& solver, StateFileName name);

// Whether a file begins as these do.
[[nodiscard]] bool looksLikeRadiosity(const std::filesystem::path& file);

// The description alone. Errors: InputMissing; InputBroken for a file that is none, of another
// version, cut or edited.
Result<RadiosityManifest> readRadiosityManifest(const std::filesystem::path& file);

// The divisions alone, which may be wrong until readRadiosity() has read the rest. Errors: as
// above.
Result<std::vector<std::vector<std::uint32_t>>> readDivisions(const std::filesystem::path& file);

// Puts the file's elements into `state`, which is of as many: those that are there already stay.
// Rows are left out where they would take more than maxRowBytes with the ones that are there (0: no
// limit). Errors: as above.
Result<void> readRadiosity(const std::filesystem::path& file, std::size_t maxRowBytes,
                           SolveState& state);

} // namespace patina::radiosity
