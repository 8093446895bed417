// The form factors of all elements, kept.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/FormFactors.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patina::radiosity {

// Rows of a sparse matrix F, one after another.
class FactorMatrix {
  public:
    FactorMatrix() = default; // of no element

    // Asks for every row, on all cores. Errors: Cancelled; Usage where the shares would
    // take more than maxBytes (0: no limit).
    static Result<FactorMatrix> compute(const FormFactors& factors, std::size_t elements,
                                        std::size_t maxBytes, const JobContext& job);
    static FactorMatrix fromRows(std::span<const FactorRow> rows);

    [[nodiscard]] std::size_t size() const { return m_first.empty() ? 0 : m_first.size() - 1; }
    [[nodiscard]] std::span<const FactorRow::Share> row(std::uint32_t element) const {
        return {m_shares.data() + m_first[element], m_first[element + 1] - m_first[element]};
    }
    [[nodiscard]] float absorbed(std::uint32_t element) const { return m_lost[element].absorbed; }
    [[nodiscard]] float escaped(std::uint32_t element) const { return m_lost[element].escaped; }
    // FactorRow::rays.
    [[nodiscard]] std::uint32_t rays(std::uint32_t element) const { return m_lost[element].rays; }

    // The factors the other way round by reciprocity, A_i F_ij = A_j F_ji: row i gets F_ji A_j/A_i.
    // A matrix whose rows say where light arrives becomes one whose rows say where it comes from,
    // and back. What is lost is not known of the result (0).
    [[nodiscard]] FactorMatrix reversed(std::span<const double> areas) const;

    [[nodiscard]] std::size_t shareCount() const { return m_shares.size(); }
    [[nodiscard]] std::size_t memoryBytes() const;

  private:
    struct Lost {
        float absorbed = 0.0f, escaped = 0.0f;
        std::uint32_t rays = 0;
    };
    std::vector<std::size_t> m_first{};
    std::vector<FactorRow::Share> m_shares;
    std::vector<Lost> m_lost;
};

// How far factors keep what they should.
struct FactorQuality {
    double closure = 0.0;     // largest |Σ_j F_ij + absorbed + escaped - 1|
    double reciprocity = 0.0; // Σ |A_i F_ij - A_j F_ji| / Σ A_i F_ij, over all pairs
    double escaped = 0.0;     // mean share that leaves the scene, by area
    double absorbed = 0.0;    // mean share that meets backs, by area
};
[[nodiscard]] FactorQuality qualityOf(const FactorMatrix& factors, std::span<const double> areas);

} // namespace patina::radiosity
