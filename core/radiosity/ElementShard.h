// Which elements of a scene one process works on, where several share them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patina::radiosity {

inline constexpr std::uint32_t kElementGroup = 16;

// Elements are counted off in groups of neighbours, so that every part has some of each surface. A
// part is of elements and not of rays: sums of sums would end in other bits than those of the
// whole.
struct ElementShard {
    int index = 0, count = 1;
    [[nodiscard]] bool holds(std::uint32_t element) const {
        return element / kElementGroup % static_cast<std::uint32_t>(count) ==
               static_cast<std::uint32_t>(index);
    }
    // How many of so many elements.
    [[nodiscard]] std::size_t held(std::size_t elements) const {
        std::size_t result = 0;
        for (std::size_t first = std::size_t{kElementGroup} * static_cast<std::size_t>(index);
             first < elements;
             first += std::size_t{kElementGroup} * static_cast<std::size_t>(count))
            result += elements - first < kElementGroup ? elements - first : kElementGroup;
        return result;
    }
    friend bool operator==(const ElementShard&, const ElementShard&) = default;
};

} // namespace patina::radiosity
