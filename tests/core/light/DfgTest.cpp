// The DFG table against integrals of the height-correlated GGX lobe: tanh-sinh quadrature over half
// vectors, error below 3e-15, the same to 12 digits by Gauss-Legendre over the light's hemisphere.
#include "core/job/Parallel.h"
#include "core/light/Ibl.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

constexpr float kNoV[7] = {0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 1.0f};

struct Row {
    float perceptualRoughness;
    double scaleBias[7][2];
};

constexpr Row kSmithCorrelated[] = {{0.05f,
                                     {{0.227890879178, 0.77074695472},
                                      {0.410127780815, 0.589543560434},
                                      {0.762725240864, 0.237220831676},
                                      {0.968719210062, 0.031265053369},
                                      {0.999012377888, 0.000978901298},
                                      {0.999982849725, 1.014052e-05},
                                      {0.999993722975, 5.598e-09}}},
                                    {0.1f,
                                     {{0.242547844964, 0.733659745088},
                                      {0.415769750041, 0.578354202728},
                                      {0.762929532305, 0.236162422796},
                                      {0.968338849927, 0.031403272672},
                                      {0.99885439166, 0.001003954061},
                                      {0.999874538224, 1.1920145e-05},
                                      {0.999898468855, 8.7551e-08}}},
                                    {0.25f,
                                     {{0.449257885045, 0.444847045067},
                                      {0.505147281554, 0.391622353755},
                                      {0.758031213634, 0.203535735462},
                                      {0.955686670842, 0.032637329395},
                                      {0.992308937045, 0.00150218763},
                                      {0.995063874025, 6.3060369e-05},
                                      {0.995685110677, 2.950018e-06}}},
                                    {0.5f,
                                     {{0.76881920452, 0.16431253809},
                                      {0.751929900793, 0.139692451016},
                                      {0.759254351402, 0.080827547751},
                                      {0.834916139293, 0.022347296288},
                                      {0.888814161591, 0.002718728294},
                                      {0.907036340046, 0.000346750587},
                                      {0.915785059323, 2.7370926e-05}}},
                                    {0.75f,
                                     {{0.839806768144, 0.065118686402},
                                      {0.795772940345, 0.05258289558},
                                      {0.716508008647, 0.027948334294},
                                      {0.654692835146, 0.008483010132},
                                      {0.631244002459, 0.001641360163},
                                      {0.626985429742, 0.00034867598},
                                      {0.626838017659, 4.7639065e-05}}},
                                    {1.0f,
                                     {{0.815684267899, 0.032089610214},
                                      {0.736343577907, 0.023866894813},
                                      {0.58676426688, 0.010876255012},
                                      {0.447705120411, 0.002988735255},
                                      {0.363893530585, 0.000633074125},
                                      {0.327341030881, 0.000166007472},
                                      {0.306819205145, 3.3614295e-05}}}};

TEST(Dfg, MatchesTheExactIntegrals) {
    for (const Row& row : kSmithCorrelated)
        for (int i = 0; i < 7; ++i) {
            const glm::vec2 dfg = integrateDfg(kNoV[i], row.perceptualRoughness);
            EXPECT_NEAR(dfg.x, row.scaleBias[i][0], 5e-4) << row.perceptualRoughness << " " << i;
            EXPECT_NEAR(dfg.y, row.scaleBias[i][1], 5e-4) << row.perceptualRoughness << " " << i;
        }
}

TEST(Dfg, WhiteFurnaceLosses) {
    // 1 - E; Schlick's k would lose up to three times as much.
    EXPECT_NEAR(1.0 - integrateDfg(0.1f, 0.25f).x - integrateDfg(0.1f, 0.25f).y, 0.103230364691,
                5e-4);
    EXPECT_NEAR(1.0 - integrateDfg(0.5f, 0.5f).x - integrateDfg(0.5f, 0.5f).y, 0.142736564419,
                5e-4);
    // r = 1, N·V = 1: exactly ln 2.
    EXPECT_NEAR(1.0 - integrateDfg(1.0f, 1.0f).x - integrateDfg(1.0f, 1.0f).y, std::log(2.0), 5e-4);
}

TEST(Dfg, AMirrorIsSchlick) {
    // r -> 0: scale 1 - (1 - N·V)^5, bias (1 - N·V)^5.
    for (const float NoV : kNoV) {
        const double fresnel = std::pow(1.0 - NoV, 5.0);
        for (const float r : {0.0f, 0.004f}) {
            EXPECT_NEAR(integrateDfg(NoV, r).x, 1.0 - fresnel, 5e-4) << NoV;
            EXPECT_NEAR(integrateDfg(NoV, r).y, fresnel, 5e-4) << NoV;
        }
    }
}

TEST(Dfg, TableHoldsTheIntegralsAtItsTexelCentres) {
    const Image table = computeDfgTable(32);
    ASSERT_EQ(table.width(), 32);
    ASSERT_EQ(table.channels(), 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const glm::vec2 exact = integrateDfg((x + 0.5f) / 32.0f, (y + 0.5f) / 32.0f);
            const float* texel = &table.f32()[(y * 32 + x) * 3];
            ASSERT_EQ(texel[0], exact.x) << x << " " << y;
            ASSERT_EQ(texel[1], exact.y);
            ASSERT_EQ(texel[2], 0.0f);
            ASSERT_GE(texel[0], 0.0f);
            ASSERT_GE(texel[1], 0.0f);
            ASSERT_LE(texel[0] + texel[1], 1.0f + 1e-3f);
        }
    const ThreadLimit one(1);
    EXPECT_EQ(computeDfgTable(32), table);
}

} // namespace
} // namespace patina
