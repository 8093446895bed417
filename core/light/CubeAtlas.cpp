#include "core/light/CubeAtlas.h"

#include "core/base/Check.h"
#include "core/light/CubeSampling.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <bit>

namespace patina {

CubeAtlas makeCubeAtlas(const std::vector<CubeLevel>& levels) {
    CHECK(!levels.empty() && levels[0].size > 0);
    CHECK(std::has_single_bit(static_cast<unsigned>(levels[0].size)));
    CubeAtlas atlas;
    atlas.side = levels[0].size;
    atlas.levels = static_cast<int>(levels.size());
    const glm::vec2 size = shading::cubeAtlasSize(static_cast<float>(atlas.side), atlas.levels);
    atlas.width = static_cast<int>(size.x);
    atlas.height = static_cast<int>(size.y);
    atlas.texels.resize(static_cast<std::size_t>(atlas.width) *
                        static_cast<std::size_t>(atlas.height));

    for (int k = 0; k < atlas.levels; ++k) {
        const CubeLevel& level = levels[static_cast<std::size_t>(k)];
        const auto side = static_cast<float>(atlas.side);
        CHECK_EQ(static_cast<float>(level.size), shading::cubeLevelSide(k, side));
        // Where the middle of the first texel of +X lies, less half a texel and the border
        const glm::vec2 first =
            shading::cubeAtlasTexel(glm::vec3(0.0f), k, side) - glm::vec2(1.0f) + 0.5f;
        const int left = static_cast<int>(first.x), top = static_cast<int>(first.y);
        CHECK(left + 6 * (level.size + 2) <= atlas.width);
        CHECK(top + level.size + 2 <= atlas.height);
        for (int face = 0; face < 6; ++face)
            for (int y = -1; y <= level.size; ++y) {
                glm::vec3* row =
                    atlas.texels.data() +
                    static_cast<std::size_t>(top + 1 + y) * static_cast<std::size_t>(atlas.width) +
                    left + face * (level.size + 2);
                row[0] = cubeTexel(level, face, -1, y);
                row[level.size + 1] = cubeTexel(level, face, level.size, y);
                if (y < 0 || y == level.size) {
                    for (int x = 0; x < level.size; ++x)
                        row[x + 1] = cubeTexel(level, face, x, y);
                    continue;
                }
                const auto source =
                    level.texels.begin() +
                    (static_cast<std::ptrdiff_t>(face) * level.size + y) * level.size;
                std::copy(source, source + level.size, row + 1);
            }
    }
    return atlas;
}

} // namespace patina
