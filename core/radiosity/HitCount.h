// Adds up what rays from one element have met, into a row of form factors.
#pragma once

#include "core/radiosity/FormFactors.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace patina::radiosity {

class HitCount {
  public:
    // `weight`: of the light that leaves.
    void add(const ElementMesh& elements, const ClosestRay& ray, double weight);
    void add(std::uint32_t element, double weight) { m_hits.emplace_back(element, weight); }
    void addAbsorbed(double weight) { m_absorbed += weight; } // met a back that only absorbs
    void addEscaped(double weight) { m_escaped += weight; }   // met nothing
    // All that was added so far, which is forgotten. Weights that are not 1 in all are scaled so.
    void finish(FactorRow& row);

  private:
    std::vector<std::pair<std::uint32_t, double>> m_hits;
    double m_absorbed = 0.0, m_escaped = 0.0;
};

} // namespace patina::radiosity
