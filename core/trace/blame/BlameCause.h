// The shortcuts that a drawn picture takes, and what reduces the error that they make.
#pragma once

#include <array>
#include <cstddef>

namespace patina {

// In the order of the series in docs/maths/blame.md, but for the last one.
enum class BlameCause {
    Occlusion,  // what hides the environment: no occlusion, or one number of it
    Lights,     // shadow maps and none; lights with extent by a fitted lobe
    Irradiance, // of nine coefficients, and a diffuse lobe that light from all sides fills evenly
    Filtering,  // levels, texels and their interpolation
    LobeDirection, // one lobe that is symmetric about a direction for all views
    SplitSum,      // one Fresnel term for the whole lobe
    Transmission,  // what is seen through a surface: the environment alone, refracted once
    Bounces,       // light by way of other surfaces, glowing ones included
    Rest           // edges, emission and background
};
inline constexpr std::size_t kBlameCauses = 9;

enum class BlameRemedy { BakeTransfer, PathTracing, None };

struct BlameCauseInfo {
    BlameCause cause;
    const char* name;  // in files: "splitSum"
    const char* label; // "Split sum"
    BlameRemedy remedy;
};
[[nodiscard]] const std::array<BlameCauseInfo, kBlameCauses>& blameCauses();
[[nodiscard]] const BlameCauseInfo& infoOf(BlameCause cause);

struct BlameRemedyInfo {
    const char* name; // in files: "bakeTransfer"
    const char* text; // a sentence
};
[[nodiscard]] BlameRemedyInfo infoOf(BlameRemedy remedy);

} // namespace patina
