// The classical ways to the same numbers: Karis' 1024-sample integrator, built from the shared
// sampling and masking terms, and the compensation lobe of Kulla & Conty.
#include "core/light/DfgTable.h"
#include "core/math/Quadrature.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>

namespace patina {
namespace {

constexpr float kRoughness[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
constexpr float kNoV[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

double radicalInverse(std::uint32_t i) {
    double result = 0.0, digit = 0.5;
    for (; i != 0; i >>= 1, digit *= 0.5)
        result += digit * (i & 1);
    return result;
}

// Karis 2013, "Real Shading in Unreal Engine 4", IntegrateBRDF: Hammersley's points i / N and the
// radical inverse, half vectors of GGX; G = 4 NoV NoL V.
template <class Visibility>
glm::dvec2 integrateAsKaris(float NoV, float perceptualRoughness, const Visibility& visibility) {
    constexpr std::uint32_t kSamples = 1024;
    const float alpha = perceptualRoughness * perceptualRoughness;
    const shading::vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
    glm::dvec2 sum(0.0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        // The polar angle follows the radical inverse, the azimuth i / N.
        const shading::vec2 u(static_cast<float>(radicalInverse(i)),
                              static_cast<float>(i) / kSamples);
        const shading::vec3 h = shading::sampleHalfVectorGGX(u, alpha);
        const float VoH = std::max(shading::dot(v, h), 0.0f);
        const float NoL = 2.0f * VoH * h.z - v.z;
        if (NoL <= 0.0f)
            continue;
        const double G = 4.0 * NoV * NoL * visibility(NoL, alpha);
        const double weight = G * VoH / (h.z * NoV);
        const double Fc = shading::schlickWeight(VoH);
        sum += glm::dvec2((1.0 - Fc) * weight, Fc * weight);
    }
    return sum / static_cast<double>(kSamples);
}

// What 1024 samples give in double precision: not the integrals, whose error is up to 0.009.
constexpr double kSchlick[5][5][2] = {
    {{0.382656929, 0.531699144},
     {0.741272591, 0.229488667},
     {0.959083495, 0.031113602},
     {0.995752662, 0.000997287},
     {0.999993312, 0}},
    {{0.389985065, 0.290913537},
     {0.657386336, 0.173331751},
     {0.902565822, 0.030413351},
     {0.972003321, 0.001429811},
     {0.994661012, 2.349e-06}},
    {{0.594840944, 0.09856282},
     {0.605714013, 0.061123701},
     {0.727151202, 0.018536793},
     {0.828804596, 0.002397052},
     {0.895530546, 2.417e-05}},
    {{0.637549102, 0.035280517},
     {0.593036971, 0.020666213},
     {0.573536444, 0.00695106},
     {0.582412242, 0.001448473},
     {0.604056458, 4.4537e-05}},
    {{0.54295886, 0.013543156},
     {0.482982274, 0.007499017},
     {0.406452038, 0.002449309},
     {0.350296031, 0.000579479},
     {0.307307249, 3.3614e-05}},
};
constexpr double kSmith[5][5][2] = {
    {{0.415469866, 0.578680674},
     {0.763145532, 0.236347197},
     {0.968589132, 0.031428473},
     {0.999047066, 0.001000678},
     {0.999999931, 0}},
    {{0.502975795, 0.391356814},
     {0.757818608, 0.203509346},
     {0.955760187, 0.032564929},
     {0.992747563, 0.001482043},
     {0.995967348, 2.58e-06}},
    {{0.760670575, 0.139954192},
     {0.754469504, 0.081169261},
     {0.833190736, 0.02233494},
     {0.890208578, 0.002734049},
     {0.91627375, 2.7372e-05}},
    {{0.791655737, 0.052655788},
     {0.715844162, 0.028011662},
     {0.655353231, 0.008458016},
     {0.631630146, 0.001637937},
     {0.627326039, 4.7638e-05}},
    {{0.731237971, 0.023845545},
     {0.585625258, 0.010902637},
     {0.447346999, 0.002976338},
     {0.364074934, 0.000630561},
     {0.307307249, 3.3614e-05}},
};

TEST(KarisIntegrator, SharedTermsGiveItsNumbers) {
    for (int r = 0; r < 5; ++r)
        for (int i = 0; i < 5; ++i) {
            const float NoV = kNoV[i];
            const glm::dvec2 schlick =
                integrateAsKaris(NoV, kRoughness[r], [NoV](float NoL, float alpha) {
                    return shading::V_SchlickGGX(NoV, NoL, 0.5f * alpha);
                });
            const glm::dvec2 smith =
                integrateAsKaris(NoV, kRoughness[r], [NoV](float NoL, float alpha) {
                    return shading::V_SmithGGXCorrelated(NoV, NoL, alpha);
                });
            for (int c = 0; c < 2; ++c) {
                EXPECT_NEAR(schlick[c], kSchlick[r][i][c], 1e-4) << kRoughness[r] << ' ' << NoV;
                EXPECT_NEAR(smith[c], kSmith[r][i][c], 1e-4) << kRoughness[r] << ' ' << NoV;
            }
        }
}

// Our quadrature is the integral: the sampled numbers lie around it as far as 1024 samples do.
TEST(KarisIntegrator, SamplesAreAroundTheQuadrature) {
    for (int r = 0; r < 5; ++r)
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 exact = integrateDfg(kNoV[i], kRoughness[r]);
            EXPECT_NEAR(kSmith[r][i][0], exact.x, 0.01);
            EXPECT_NEAR(kSmith[r][i][1], exact.y, 0.01);
        }
}

// Kulla & Conty 2017: the lobe (1 - E(o)) (1 - E(i)) / (pi (1 - Eavg)) returns what is missing. Its
// scale for height-correlated Smith at r = 0.1, 0.25, 0.5, 0.75, 1.
TEST(KullaConty, TheLobeReturnsWhatIsMissing) {
    constexpr double kScale[5] = {624.805573697, 24.966023081, 2.70495441844, 0.925861553551,
                                  0.538720373537};
    const GaussLegendre rule(48);
    for (int r = 0; r < 5; ++r) {
        const auto albedo = [r](double mu) {
            const glm::dvec3 entry = integrateDfg(static_cast<float>(mu), kRoughness[r]);
            return entry.x + entry.y;
        };
        double average = 0.0;
        for (int i = 0; i < rule.size(); ++i)
            average += rule.weight01(i) * 2.0 * rule.node01(i) * albedo(rule.node01(i));
        const double scale = 1.0 / (std::numbers::pi * (1.0 - average));
        EXPECT_NEAR(scale / kScale[r], 1.0, 1e-3) << kRoughness[r];
        const double missing = 1.0 - albedo(0.5);
        double returned = 0.0;
        for (int i = 0; i < rule.size(); ++i)
            returned += rule.weight01(i) * 2.0 * std::numbers::pi * rule.node01(i) * missing *
                        (1.0 - albedo(rule.node01(i))) * scale;
        EXPECT_NEAR(returned, missing, 1e-9);
    }
}

} // namespace
} // namespace patina
