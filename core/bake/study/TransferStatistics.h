// What a transfer bake holds over all of its vertices or texels, without its scene: what
// `patina info` states of a file.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace patina {

struct TransferStatistics {
    std::size_t elements = 0; // vertices or texels
    // Of them, those without any transfer: nothing arrives there, or no surface covers the texel.
    // What follows is of the others.
    std::size_t dark = 0;
    // Share of the light of a uniform environment that arrives directly, 0…1 (the Transfer dock's
    // sky visibility). All 0 where there are no others.
    float lowestVisibility = 0.0f, highestVisibility = 0.0f;
    double meanVisibility = 0.0;
    // For each band l its share of all squares, 0…1: Σ_m c_lm² / Σ c_i², c_i = T_i and the mean of
    // B_i over the colours. What few bands leave out decays from band to band.
    std::vector<double> bandShares;
};

// `values`, `bounced` (empty: none) and order as of VertexBake: order² and 3 order² numbers for
// each element.
[[nodiscard]] TransferStatistics transferStatistics(std::span<const float> values,
                                                    std::span<const float> bounced, int order);

} // namespace patina
