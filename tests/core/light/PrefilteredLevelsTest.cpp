// What is found between prefiltered levels, at any roughness, against the exact sum.
#include "core/light/Ibl.h"
#include "tests/core/light/EnvironmentSum.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

using namespace reference;

glm::vec3 lookUp(const IblMaps& maps, const glm::vec3& d, float perceptualRoughness) {
    const LevelPair levels = levelsOf(maps, perceptualRoughness);
    return glm::mix(sampleCube(maps.prefiltered[levels.first], d),
                    sampleCube(maps.prefiltered[levels.second], d), levels.share);
}

TEST(PrefilteredLevels, AreCloseToTheExactSumAtFortyRoughnesses) {
    const std::vector<float> roughness = fortyRoughnesses();
    for (const NamedEnvironment& environment : lookupEnvironments()) {
        const auto maps = computeIbl(*environment.image, {}, {});
        ASSERT_TRUE(maps.ok());
        const EnvironmentSum truth(maps->prefiltered.front());
        const std::vector<glm::vec3> directions = lookupDirections(truth, lookupCount(24));
        const auto exact = exactSums(truth, directions, roughness);
        std::string table;
        for (std::size_t r = 0; r < roughness.size(); ++r) {
            std::vector<glm::vec3> seen;
            for (const glm::vec3& d : directions)
                seen.push_back(lookUp(*maps, d, roughness[r]));
            const LookupError error = lookupError(seen, exact[r]);
            const bool narrow = roughness[r] < 0.1f - 1e-6f;
            EXPECT_LE(error.rms, narrow ? 0.04 : 0.015) << environment.name << " " << roughness[r];
            if (!narrow) {
                EXPECT_LE(error.most, 0.1) << environment.name << " " << roughness[r];
            }
            table += fmt::format(" {:.3f}:{:.2f}/{:.1f}", roughness[r], 100.0 * error.rms,
                                 100.0 * error.most);
        }
        RecordProperty(environment.name, table); // roughness:rms/most, in percent
        if (std::getenv("PATINA_PREFILTER_HDR"))
            fmt::print("{}{}\n", environment.name, table);
    }
}

// The first picture of a new environment has fewer and smaller levels: no bound of the above, but
// no mirror image mixed with a blurred one.
TEST(PrefilteredLevels, OfTheQuickVersionAreWithinSomePercent) {
    const std::vector<float> roughness{0.2f, 0.3f, 0.4f, 0.55f, 0.7f, 0.85f, 1.0f};
    for (const NamedEnvironment& environment : lookupEnvironments()) {
        const auto maps = computeIbl(*environment.image, IblSettings::quick(), {});
        ASSERT_TRUE(maps.ok());
        const EnvironmentSum truth(maps->prefiltered.front());
        std::vector<glm::vec3> directions = lookupDirections(truth, 40);
        const auto exact = exactSums(truth, directions, roughness);
        for (std::size_t r = 0; r < roughness.size(); ++r) {
            std::vector<glm::vec3> seen;
            for (const glm::vec3& d : directions)
                seen.push_back(lookUp(*maps, d, roughness[r]));
            EXPECT_LE(lookupError(seen, exact[r]).rms, 0.06)
                << environment.name << " " << roughness[r];
        }
    }
}

TEST(PrefilteredLevels, OfEvenSpacingAreThoseOfFiles) {
    IblMaps maps;
    maps.spacing = LevelSpacing::Even;
    for (int i = 0; i < 5; ++i) {
        const int side = levelSide(LevelSpacing::Even, i, 64);
        EXPECT_EQ(side, 64 >> i);
        EXPECT_EQ(levelRoughness(LevelSpacing::Even, i, 5, 64), static_cast<float>(i) / 4.0f);
        maps.prefiltered.push_back({side, {}});
    }
    const LevelPair levels = levelsOf(maps, 0.625f);
    EXPECT_EQ(levels.first, 2u);
    EXPECT_EQ(levels.second, 3u);
    EXPECT_FLOAT_EQ(levels.share, 0.5f);
    EXPECT_EQ(levelsOf(maps, 1.0f).second, 4u);
}

} // namespace
} // namespace patina
