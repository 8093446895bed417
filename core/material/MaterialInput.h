// The inputs of a material that a map can vary; core/material/MaterialInputs.h describes them.
#pragma once

#include <array>
#include <cstddef>

namespace patina {

enum class MaterialInput {
    BaseColor,
    Metallic,
    PerceptualRoughness,
    Normal,
    Occlusion,
    Emissive,
    Transmission
};
inline constexpr std::size_t kMaterialInputCount =
    static_cast<std::size_t>(MaterialInput::Transmission) + 1; // the last one

// One value for each input.
template <class T>
struct PerInput {
    std::array<T, kMaterialInputCount> values{};
    [[nodiscard]] constexpr T& operator[](MaterialInput input) {
        return values[static_cast<std::size_t>(input)];
    }
    [[nodiscard]] constexpr const T& operator[](MaterialInput input) const {
        return values[static_cast<std::size_t>(input)];
    }
    friend auto operator<=>(const PerInput&, const PerInput&) = default;
};

// The numbers of a material that nobody has edited; 0 for inputs that have none.
[[nodiscard]] PerInput<float> defaultNumbers();

} // namespace patina
