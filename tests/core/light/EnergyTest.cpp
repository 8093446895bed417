// What returns of a white furnace, against published formulas and independent quadratures.
#include "core/light/Energy.h"

#include "core/light/DfgTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>

namespace patina {
namespace {

SurfacePoint metal(float f0, float perceptualRoughness) {
    return {glm::vec3(f0), 1.0f, perceptualRoughness, 0.0f};
}

ShadingModel modelOf(Visibility visibility, bool multiScatter = false) {
    ShadingModel model;
    model.visibility = visibility;
    model.multiScatter = multiScatter;
    return model;
}

constexpr float kNoV[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

// 1 - E of GGX by tanh-sinh quadrature over half vectors with the exact boundary N·L > 0; at
// roughness 1 and N·V = 1 it is ln 2 in closed form. E: ∫ D V cos dl for F0 = F90 = 1.
struct LossRow {
    Visibility visibility;
    float r;
    double loss[5];
};
constexpr LossRow kLosses[] = {
    {Visibility::SmithCorrelated, 0.1f, {0.005876, 0.000908, 0.000258, 0.000142, 0.000101}},
    {Visibility::SmithCorrelated, 0.25f, {0.103230, 0.038433, 0.011676, 0.006189, 0.004312}},
    {Visibility::SmithCorrelated, 0.5f, {0.108378, 0.159918, 0.142737, 0.108467, 0.084188}},
    {Visibility::SmithCorrelated, 0.75f, {0.151644, 0.255544, 0.336824, 0.367115, 0.373114}},
    {Visibility::SmithCorrelated, 1.0f, {0.239790, 0.402359, 0.549306, 0.635473, 0.693147}},
    {Visibility::SchlickIbl, 0.1f, {0.085632, 0.029642, 0.010071, 0.003446, 0.000113}},
    {Visibility::SchlickIbl, 0.25f, {0.317642, 0.169315, 0.067180, 0.026821, 0.005666}},
    {Visibility::SchlickIbl, 0.5f, {0.311456, 0.329704, 0.252919, 0.170080, 0.104934}},
    {Visibility::SchlickIbl, 0.75f, {0.323859, 0.385907, 0.420018, 0.416495, 0.396387}},
    {Visibility::SchlickIbl, 1.0f, {0.442086, 0.509035, 0.590863, 0.649311, 0.693147}},
};

TEST(Energy, AWhiteMetalLosesWhatIsTabulated) {
    for (const LossRow& row : kLosses)
        for (int i = 0; i < 5; ++i) {
            const SurfacePoint white = metal(1.0f, row.r);
            const Returned single =
                returnedFromEnvironment(modelOf(row.visibility), white, kNoV[i]);
            const Returned whole =
                returnedFromEnvironment(modelOf(row.visibility, true), white, kNoV[i]);
            const std::string where =
                "r " + std::to_string(row.r) + ", N·V " + std::to_string(kNoV[i]);
            EXPECT_NEAR(1.0 - single.total().y, row.loss[i], 5e-4) << where;
            EXPECT_NEAR(specularLoss(single, whole).x, row.loss[i], 5e-4) << where;
            EXPECT_NEAR(whole.total().z, 1.0, 1e-5) << where;
            const EnergyBalance balance = energyBalance(single, whole, false);
            EXPECT_NEAR(balance.lost.y, row.loss[i], 5e-4) << where;
            EXPECT_NEAR(balance.absorbed.y, 0.0, 1e-5) << where;
            EXPECT_NEAR(energyBalance(single, whole, true).lost.y, 0.0, 1e-9) << where;
            // Lights lose the same; the integral shares no code with the table's.
            EXPECT_NEAR(1.0 - returnedFromLights(modelOf(row.visibility), white, kNoV[i]).total().y,
                        row.loss[i], 5e-4)
                << where;
            EXPECT_NEAR(returnedFromLights(modelOf(row.visibility, true), white, kNoV[i]).total().y,
                        1.0, 1e-3)
                << where;
        }
}

// The exact entries behind the estimates.
TEST(Energy, TheTabulatedLossesAreExactToSixDigits) {
    for (const LossRow& row : kLosses)
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 dfg = integrateDfg(kNoV[i], row.r, Distribution::GGX, row.visibility);
            EXPECT_NEAR(1.0 - dfg.x - dfg.y, row.loss[i], 1e-6) << row.r << " " << kNoV[i];
            const glm::dvec2 estimate =
                estimateDfg(kNoV[i], row.r, Distribution::GGX, row.visibility);
            for (int c = 0; c < 2; ++c)
                EXPECT_NEAR(estimate[c], dfg[c], 5e-4) << c << " " << row.r << " " << kNoV[i];
        }
}

// Eavg = 2 ∫ E(mu) mu dmu, as in Kulla & Conty 2017; Blender's table_ggx_Eavg ends with 0.409137.
TEST(Energy, AveragesAreThoseOfKullaAndConty) {
    const struct {
        Visibility visibility;
        float r;
        double average;
    } rows[] = {{Visibility::SmithCorrelated, 0.1f, 0.9994905457},
                {Visibility::SmithCorrelated, 0.25f, 0.9872502767},
                {Visibility::SmithCorrelated, 0.5f, 0.8823233826},
                {Visibility::SmithCorrelated, 0.75f, 0.6562014213},
                {Visibility::SmithCorrelated, 1.0f, 0.4091370926},
                {Visibility::SmithSeparable, 0.5f, 0.8794556695},
                {Visibility::SmithSeparable, 1.0f, 0.3766346112},
                {Visibility::SchlickIbl, 0.25f, 0.9453994702},
                {Visibility::SchlickIbl, 0.75f, 0.5918498014},
                {Visibility::SchlickIbl, 1.0f, 0.3766346112}};
    for (const auto& row : rows) {
        const ShadingModel model = modelOf(row.visibility);
        const SurfacePoint white = metal(1.0f, row.r);
        const Returned even =
            averageReturned([&](float NoV) { return returnedFromEnvironment(model, white, NoV); });
        EXPECT_NEAR(even.total().y, row.average, 3e-4) << int(row.visibility) << " " << row.r;
        EXPECT_EQ(even.diffuse, glm::dvec3(0.0));
        const Returned lights =
            averageReturned([&](float NoV) { return returnedFromLights(model, white, NoV); });
        EXPECT_NEAR(lights.total().y, row.average, 5e-4) << int(row.visibility) << " " << row.r;
    }
}

// Single scatter F0 A + B, and Turquin 2019, equation 16, at r = 0.5, N·V = 0.5 and at r = 1,
// N·V = 1; quadratures of the formulas.
TEST(Energy, ColouredMetalsLoseLessAndGetItBackTinted) {
    const struct {
        float r, NoV, f0;
        double single, compensated;
    } rows[] = {{0.5f, 0.5f, 0.9f, 0.773771821652, 0.889723318233},
                {0.5f, 0.5f, 0.5f, 0.439805365935, 0.4764197276},
                {0.5f, 0.5f, 0.2f, 0.189330524147, 0.195635327882},
                {1.0f, 1.0f, 0.9f, 0.276170898926, 0.837626948973},
                {1.0f, 1.0f, 0.5f, 0.153443216868, 0.326748994768},
                {1.0f, 0.25f, 0.5f, 0.304258388452, 0.406678858537}};
    for (const auto& row : rows) {
        const ShadingModel off = modelOf(Visibility::SmithCorrelated);
        const ShadingModel on = withCompensation(off, true);
        const SurfacePoint point = metal(row.f0, row.r);
        for (const auto returned : {returnedFromEnvironment, returnedFromLights}) {
            EXPECT_NEAR(returned(off, point, row.NoV).total().y, row.single, 6e-4) << row.f0;
            EXPECT_NEAR(returned(on, point, row.NoV).total().y, row.compensated, 1.2e-3) << row.f0;
        }
    }
}

TEST(Energy, EachChannelHasItsOwnBalance) {
    const SurfacePoint gold{{1.0f, 0.77f, 0.34f}, 1.0f, 0.9f, 0.0f};
    const ShadingModel off = modelOf(Visibility::SmithCorrelated);
    const Returned single = returnedFromEnvironment(off, gold, 0.7f);
    const Returned whole = returnedFromEnvironment(withCompensation(off, true), gold, 0.7f);
    const glm::dvec3 loss = specularLoss(single, whole);
    EXPECT_GT(loss.x, loss.y);
    EXPECT_GT(loss.y, loss.z);
    const glm::dvec3 dfg = integrateDfg(0.7f, 0.9f);
    const double E = dfg.x + dfg.y;
    EXPECT_NEAR(loss.z, 1.0 - 1.0 / (1.0 + 0.34 * (1.0 - E) / E), 1e-3);
    for (const bool on : {false, true}) {
        const EnergyBalance balance = energyBalance(single, whole, on);
        const glm::dvec3 sum = balance.specular + balance.diffuse + balance.absorbed + balance.lost;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], 1.0, 1e-12);
        EXPECT_GT(balance.absorbed.z, balance.absorbed.x + 0.3);
    }
}

// The specular layer's loss goes to the body below: all of it comes back from white, part of it
// from grey.
TEST(Energy, ANonMetalPassesItsLossOnToTheBody) {
    const ShadingModel off = modelOf(Visibility::SmithCorrelated);
    for (const float rho : {1.0f, 0.4f}) {
        const SurfacePoint point{glm::vec3(rho), 0.0f, 0.8f, 0.0f};
        const Returned single = returnedFromEnvironment(off, point, 0.5f);
        const Returned whole = returnedFromEnvironment(withCompensation(off, true), point, 0.5f);
        const double moved = whole.specular.y - single.specular.y;
        EXPECT_GT(moved, 1e-4);
        EXPECT_NEAR(single.diffuse.y - whole.diffuse.y, moved * rho, 1e-6);
        EXPECT_NEAR(energyBalance(single, whole, false).lost.y, moved * (1.0 - rho), 1e-6);
    }
}

// Every diffuse lobe has its closed-form albedo under lights, too.
TEST(Energy, LightsAndEnvironmentAgreeOnTheBody) {
    for (const Diffuse diffuse :
         {Diffuse::Lambert, Diffuse::Burley, Diffuse::OrenNayar, Diffuse::Eon})
        for (const float r : {0.1f, 0.9f})
            for (const float NoV : {0.1f, 0.5f, 1.0f}) {
                ShadingModel model;
                model.diffuse = diffuse;
                const SurfacePoint point{{0.9f, 0.5f, 0.1f}, 0.3f, r, r};
                const Returned even = returnedFromEnvironment(model, point, NoV);
                const Returned lights = returnedFromLights(model, point, NoV);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(lights.diffuse[c], even.diffuse[c], 1e-3)
                        << int(diffuse) << " " << r << " " << NoV;
                    EXPECT_NEAR(lights.specular[c], even.specular[c], 1e-3)
                        << int(diffuse) << " " << r << " " << NoV;
                }
            }
}

} // namespace
} // namespace patina
