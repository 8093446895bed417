// Substructuring: surfaces are divided into patches, and these into elements. Patches shoot the
// mean of their elements' light, elements receive it: the light is as fine as the elements, and
// there is one row of form factors for each patch. Cohen, Greenberg, Immel & Brock 1986, "An
// Efficient Radiosity Approach for Realistic Image Synthesis".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patina::radiosity {

// Which elements shoot together.
struct Patches {
    // Where the elements of each patch begin in `elements`, and the end; empty: there are none, and
    // each element shoots alone.
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> elements; // of one patch after another, ascending in each
    std::vector<std::uint32_t> of;       // of each element, its patch

    [[nodiscard]] bool empty() const { return first.empty(); }
    [[nodiscard]] std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> elementsOf(std::uint32_t patch) const {
        return std::span(elements).subspan(first[patch], first[patch + 1] - first[patch]);
    }
    [[nodiscard]] std::size_t memoryBytes() const {
        return (first.capacity() + elements.capacity() + of.capacity()) * sizeof(std::uint32_t);
    }
};

} // namespace patina::radiosity
