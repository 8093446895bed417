// Radiosity that has been solved before, kept in a folder: one file per source of light, and one
// per adaptive division, each named by the hash of what it follows from
// (core/radiosity/document/KeptRadiosity.h). Values lie in them as in memory, so that what is found
// is, byte for byte, what was solved. Several processes may share the folder.
#pragma once

#include "core/base/CacheFolder.h"
#include "core/radiosity/ElementMesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina::radiosity {

// The light of one source. Vectors: one for each element.
struct KeptSolution {
    std::vector<glm::dvec3> direct, bounced; // irradiance, W/m²: straight, and by way of others
    double residual = 0.0;                   // as SolveReport has it
    int sweeps = 0;                          // or shots
    friend bool operator==(const KeptSolution&, const KeptSolution&) = default;
};

// How elements were divided further than evenly.
struct KeptDivision {
    std::vector<std::vector<std::uint32_t>> rounds; // elements that each has divided, ascending
    Hash elements;                                  // hashElements() of what they came to
    friend bool operator==(const KeptDivision&, const KeptDivision&) = default;
};

class SolutionCache {
  public:
    static constexpr std::uint64_t kDefaultBytes = std::uint64_t{512} << 20;

    // The folder is made when something is stored. `maxBytes`: what its files may hold together,
    // 48 for each element and source.
    explicit SolutionCache(std::filesystem::path folder, std::uint64_t maxBytes = kDefaultBytes);

    // Nothing when there is none. A file that is damaged, or of another number of elements, is
    // removed with a line in the log. What is found counts as used now.
    [[nodiscard]] std::optional<KeptSolution> find(const Hash& key, std::size_t elements) const;
    // Of a division that does not fit the elements whoever asks calls drop().
    [[nodiscard]] std::optional<KeptDivision> findDivision(const Hash& key) const;

    [[nodiscard]] bool has(const Hash& key) const; // without a look inside
    void drop(const Hash& key) const { m_files.drop(key); }

    // Errors: CannotCreate, Io; what was solved is still good.
    Result<void> store(const Hash& key, const KeptSolution& solution) const;
    Result<void> store(const Hash& key, const KeptDivision& division) const;

    [[nodiscard]] std::filesystem::path file(const Hash& key) const { return m_files.file(key); }

  private:
    CacheFolder m_files;
};

// Divides elements as they were divided before; false, and only in part, where `division` is of
// others.
[[nodiscard]] bool divideAgain(const KeptDivision& division, ElementMesh& elements);

} // namespace patina::radiosity
