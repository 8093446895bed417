// Takes noise out of a light map: texels take part of what their neighbours on the same smooth
// surface have, as far as both differ by no more than their noise. Formulas:
// docs/maths/light-map.md.
#pragma once

#include "core/bake/lightmap/LightMap.h"
#include "core/job/JobContext.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace patina {

// A texture while it is made.
struct LightMapTexture {
    struct Texel {
        // As LightMap.h has them; of the specular lobe the moments that fitHemisphere() takes.
        std::array<glm::vec4, kLightMapVectors> values{};
        glm::vec3 position{0.0f}; // scene units
        glm::vec3 normal{0.0f};   // unit; zero: nothing is known of the texel
        // Of the mean: variance of the irradiance's luminance, of the light of surfaces in the
        // specular lobe (its constant term) and of the hidden share.
        glm::vec3 variance{0.0f};
    };
    int side = 0;
    std::vector<Texel> texels; // side × side, rows from the top

    [[nodiscard]] Texel& at(int x, int y) {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const Texel& at(int x, int y) const {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(x)];
    }
};

// Meaningless after a cancel. The same for any number of threads.
void filterLightMap(LightMapTexture& texture, const JobContext& job);

} // namespace patina
