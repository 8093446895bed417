// A lobe as a surface in space: around a point, as far out in each direction as light is reflected
// that way. The BRDF lens turns it about, the viewport draws it where the point is.
#pragma once

#include "core/light/BrdfLens.h"

#include <cstdint>
#include <vector>

namespace patina {

// What a plot of the lobe shows of f_r.
struct LobeScale {
    LensLobe lobe = LensLobe::Both;
    bool cosine = false;      // times the cosine of the direction that varies
    bool logarithmic = false; // the radius: kLobeDecades below the peak are the middle
    int channel = -1;         // 0…2: R, G, B; otherwise luminance
    friend bool operator==(const LobeScale&, const LobeScale&) = default;
};

inline constexpr float kLobeDecades = 4.0f;

// The number a plot shows for `f_r`, seen or lit from `cosine` above the surface.
[[nodiscard]] float lobeValue(const glm::vec3& f, float cosine, const LobeScale& scale);
// Where on a radius of 1 a value lies; `peak` > 0 lies at 1.
[[nodiscard]] float lobeRadius(float value, float peak, const LobeScale& scale);

struct LobeMesh {
    std::vector<glm::vec3> positions; // the peak is 1 from the origin
    std::vector<glm::vec3> normals;   // outwards
    std::vector<glm::vec3> colors;    // of the light that is reflected there, the largest 1
    std::vector<std::uint32_t> triangles;
};

enum class LobeEnd { Light, Viewer };

// All directions above the surface, crowded around the mirror direction of `fixed`, which is the
// light (the lobe is what viewers see) or the viewer (the lobe is which light he sees). `peak`: the
// value that lies 1 away.
[[nodiscard]] LobeMesh makeLobeMesh(const BrdfLens& lens, const glm::vec3& fixed, LobeEnd end,
                                    const LobeScale& scale, float peak, int rings = 48,
                                    int segments = 72);
// The largest value in the plane of incidence, where every lobe here has its peak.
[[nodiscard]] float lobePeak(const BrdfLens& lens, const glm::vec3& fixed, LobeEnd end,
                             const LobeScale& scale);

} // namespace patina
