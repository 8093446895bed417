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
    const glm::vec2 size = shading::cubeAtlasSize(static_cast<float>(atlas.side));
    atlas.width = static_cast<int>(size.x);
    atlas.height = static_cast<int>(size.y);
    atlas.texels.resize(static_cast<std::size_t>(atlas.width) *
                        static_cast<std::size_t>(atlas.height));

    int top = 0; // row of the level's border
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const CubeLevel& level = levels[k];
        CHECK_EQ(static_cast<float>(level.size),
                 shading::cubeLevelSide(static_cast<float>(k), static_cast<float>(atlas.side)));
        for (int face = 0; face < 6; ++face)
            for (int y = -1; y <= level.size; ++y) {
                glm::vec3* row =
                    atlas.texels.data() +
                    static_cast<std::size_t>(top + 1 + y) * static_cast<std::size_t>(atlas.width) +
                    face * (level.size + 2);
                row[0] = cubeTexel(level, face, -1, y);
                row[level.size + 1] = cubeTexel(level, face, level.size, y);
                if (y < 0 || y == level.size) {
                    for (int x = 0; x < level.size; ++x)
                        row[x + 1] = cubeTexel(level, face, x, y);
                    continue;
                }
                const auto first =
                    level.texels.begin() +
                    (static_cast<std::ptrdiff_t>(face) * level.size + y) * level.size;
                std::copy(first, first + level.size, row + 1);
            }
        top += level.size + 2;
    }
    CHECK(top <= atlas.height);
    return atlas;
}

} // namespace patina
