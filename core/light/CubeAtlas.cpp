#include "core/light/CubeAtlas.h"

#include "core/base/Check.h"
#include "core/light/CubeSampling.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <bit>
#include <numbers>

namespace patina {

namespace {

// A level with its borders, the corner of the first of them at (left, top); each texel times
// `scale`.
void place(const CubeLevel& level, int left, int top, float scale, CubeAtlas& atlas) {
    CHECK(left + 6 * (level.size + 2) <= atlas.width);
    CHECK(top + level.size + 2 <= atlas.height);
    for (int face = 0; face < 6; ++face)
        for (int y = -1; y <= level.size; ++y) {
            glm::vec3* row =
                atlas.texels.data() +
                static_cast<std::size_t>(top + 1 + y) * static_cast<std::size_t>(atlas.width) +
                left + face * (level.size + 2);
            for (const int x : {-1, level.size})
                row[x + 1] = scale * cubeTexel(level, face, x, y);
            if (y < 0 || y == level.size) {
                for (int x = 0; x < level.size; ++x)
                    row[x + 1] = scale * cubeTexel(level, face, x, y);
                continue;
            }
            const auto source = level.texels.begin() +
                                (static_cast<std::ptrdiff_t>(face) * level.size + y) * level.size;
            std::transform(source, source + level.size, row + 1,
                           [scale](const glm::vec3& texel) { return scale * texel; });
        }
}

} // namespace

CubeAtlas makeCubeAtlas(const std::vector<CubeLevel>& levels, const CubeLevel& irradiance) {
    CHECK(!levels.empty() && levels[0].size > 0);
    CHECK(std::has_single_bit(static_cast<unsigned>(levels[0].size)));
    CubeAtlas atlas;
    atlas.side = levels[0].size;
    atlas.levels = static_cast<int>(levels.size());
    const bool own = irradiance.size > 0;
    atlas.irradianceSide = own ? irradiance.size : levels.back().size;
    const glm::vec2 size = shading::cubeAtlasSize(static_cast<float>(atlas.side), atlas.levels);
    atlas.irradianceTop = static_cast<int>(size.y);
    atlas.width = std::max(static_cast<int>(size.x), 6 * (atlas.irradianceSide + 2));
    atlas.height = atlas.irradianceTop + atlas.irradianceSide + 2;
    atlas.texels.resize(static_cast<std::size_t>(atlas.width) *
                        static_cast<std::size_t>(atlas.height));

    for (int k = 0; k < atlas.levels; ++k) {
        const CubeLevel& level = levels[static_cast<std::size_t>(k)];
        const auto side = static_cast<float>(atlas.side);
        CHECK_EQ(static_cast<float>(level.size), shading::cubeLevelSide(k, side));
        // Where the middle of the first texel of +X lies, less half a texel and the border
        const glm::vec2 first =
            shading::cubeAtlasTexel(glm::vec3(0.0f), k, side) - glm::vec2(1.0f) + 0.5f;
        place(level, static_cast<int>(first.x), static_cast<int>(first.y), 1.0f, atlas);
    }
    if (own)
        place(irradiance, 0, atlas.irradianceTop, std::numbers::inv_pi_v<float>, atlas);
    else
        place(levels.back(), 0, atlas.irradianceTop, 1.0f, atlas);
    return atlas;
}

} // namespace patina
