// The form factors of all elements, kept.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ElementShard.h"
#include "core/radiosity/FormFactors.h"
#include "core/radiosity/FoundFlags.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace patina::radiosity {

// Rows of a sparse matrix F, of which some may not be there yet. Each is in memory once, as long as
// it needs to be. One for each element; or for each patch, with shares of all elements.
class FactorMatrix {
  public:
    FactorMatrix() = default;                  // of no element
    explicit FactorMatrix(std::size_t senders) // none of whose rows is there
        : m_rows(senders)
        , m_found(senders) {}

    // Asks for every row, on all cores. Errors: Cancelled; Usage where the shares would
    // take more than maxBytes (0: no limit).
    static Result<FactorMatrix> compute(const FormFactors& factors, std::size_t senders,
                                        std::size_t maxBytes, const JobContext& job);
    static FactorMatrix fromRows(std::span<const FactorRow> rows);

    // Asks for those rows of a shard that are not there. `between`: called after each, from any
    // thread. Errors: as compute(); what was found by then is there.
    Result<void> complete(const FormFactors& factors, const ElementShard& shard,
                          std::size_t maxBytes, const JobContext& job,
                          const std::function<void()>& between = {});
    // Of a row that is not there. From any thread; its size in memory becomes what it needs.
    void set(std::uint32_t element, const FactorRow& row) {
        m_rows[element] = row;
        m_found.set(element);
    }

    [[nodiscard]] std::size_t size() const { return m_rows.size(); }
    // May be asked while other threads find rows.
    [[nodiscard]] bool has(std::uint32_t element) const { return m_found.has(element); }
    // Empty where it is not there.
    [[nodiscard]] const FactorRow& whole(std::uint32_t element) const { return m_rows[element]; }
    [[nodiscard]] std::span<const FactorRow::Share> row(std::uint32_t element) const {
        return m_rows[element].shares;
    }
    [[nodiscard]] float absorbed(std::uint32_t element) const { return m_rows[element].absorbed; }
    [[nodiscard]] float escaped(std::uint32_t element) const { return m_rows[element].escaped; }
    // FactorRow::rays.
    [[nodiscard]] std::uint32_t rays(std::uint32_t element) const { return m_rows[element].rays; }

    // The factors the other way round by reciprocity, A_i F_ij = A_j F_ji: row i gets F_ji A_j/A_i.
    // A matrix whose rows say where light arrives becomes one whose rows say where it comes from,
    // and back. What is lost is not known of the result (0). Not of patches.
    [[nodiscard]] FactorMatrix reversed(std::span<const double> areas) const;
    // Of patches: a row's shares of the elements of one patch as one share. Square.
    [[nodiscard]] FactorMatrix betweenPatches(const Patches& patches) const;

    [[nodiscard]] std::size_t rowCount() const; // that are there
    [[nodiscard]] std::size_t shareCount() const;
    [[nodiscard]] std::size_t memoryBytes() const;

  private:
    std::vector<FactorRow> m_rows;
    FoundFlags m_found;
};

// How far factors keep what they should.
struct FactorQuality {
    double closure = 0.0;     // largest |Σ_j F_ij + absorbed + escaped - 1|
    double reciprocity = 0.0; // Σ |A_i F_ij - A_j F_ji| / Σ A_i F_ij, over all pairs
    double escaped = 0.0;     // mean share that leaves the scene, by area
    double absorbed = 0.0;    // mean share that meets backs, by area
};
// Of a square one.
[[nodiscard]] FactorQuality qualityOf(const FactorMatrix& factors, std::span<const double> areas);

} // namespace patina::radiosity
