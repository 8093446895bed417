// Light from spheres and rectangles against published form factors and against quadrature of the
// very lobes that linearly transformed cosines stand for.
#include "core/light/DfgTable.h"
#include "core/light/LobeTable.h"
#include "core/math/Quadrature.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

using glm::vec3;
using shading::quadFormFactor;
using shading::sphereFormFactor;

TEST(FormFactor, OfASphereFollowsHowell) {
    // Howell, B-43…B-45: element to a sphere of radius r at distance d, beta from the normal; the
    // last ones are cut by the horizon.
    const struct {
        double r, d, beta, value;
    } known[] = {{1, 2, 0.0, 0.25},
                 {1, 2, 0.5, 0.219395640473},
                 {1, 2, 1.570796, 0.0288344428112},
                 {1, 2, 1.2, 0.0921456385604},
                 {1, 2, 1.9, 0.00279031116174},
                 {1, 1.5, 1.3, 0.14499050018},
                 {0.5, 3, 1.0, 0.0150083973852}};
    for (const auto& k : known)
        EXPECT_NEAR(sphereFormFactor(static_cast<float>(std::cos(k.beta)),
                                     static_cast<float>(k.r * k.r / (k.d * k.d))),
                    k.value, 1e-6)
            << k.d << ' ' << k.beta;
    EXPECT_EQ(sphereFormFactor(-0.6f, 0.25f), 0.0f);         // below the horizon
    EXPECT_NEAR(sphereFormFactor(0.3f, 1.0f), 0.65f, 1e-6f); // touching: half the sky, tilted
}

TEST(FormFactor, OfARectangleFollowsHowell) {
    // B-3: element below the corner of a parallel a × b rectangle at distance c.
    const float parallel[][4] = {{1, 1, 1, 0.138531605995f},
                                 {2, 1, 1, 0.167375009914f},
                                 {0.5f, 0.5f, 1, 0.0598641176152f},
                                 {1, 1, 2, 0.0598641176152f}};
    for (const auto& [a, b, c, value] : parallel)
        EXPECT_NEAR(quadFormFactor({0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}), value, 1e-6f);
    // B-4: a rectangle perpendicular to the element's plane, height a, width b, at distance c.
    const float upright[][4] = {{1, 1, 1, 0.0557341970026f},
                                {2, 1, 1, 0.0950679411924f},
                                {0.5f, 0.5f, 1, 0.01392769121f},
                                {1, 1, 2, 0.01392769121f}};
    for (const auto& [a, b, c, value] : upright)
        EXPECT_NEAR(quadFormFactor({c, 0, 0}, {c, b, 0}, {c, b, a}, {c, 0, a}), value, 1e-6f);
}

TEST(FormFactor, OfPolygonsIsClippedAtTheHorizon) {
    // Lambert's formula, checked by area quadrature of the part above the horizon.
    EXPECT_NEAR(quadFormFactor({1, 0, 1}, {0, 1.5f, 2}, {-0.5f, -0.5f, 1.2f}, {-0.5f, -0.5f, 1.2f}),
                0.173508388477f, 1e-6f); // a triangle
    const vec3 a(1, -1, -0.5f), b(1, 1, -0.5f), c(1, 1, 1), d(1, -1, 1);
    EXPECT_NEAR(quadFormFactor(a, b, c, d), 0.111468394005f, 1e-6f);
    // Every corner may be the first.
    EXPECT_NEAR(quadFormFactor(b, c, d, a), 0.111468394005f, 1e-6f);
    EXPECT_NEAR(quadFormFactor(c, d, a, b), 0.111468394005f, 1e-6f);
    EXPECT_NEAR(quadFormFactor(d, a, b, c), 0.111468394005f, 1e-6f);
    // One corner, and three corners, below.
    const vec3 across(1, 1, -1), along(-1, 1, -1);
    for (const float height : {1.5f, 0.5f}) {
        const vec3 p(0, 1, height);
        // The same area as many slivers, most of which are not cut at these corners.
        float sum = 0.0f;
        constexpr int kSlivers = 1000;
        for (int i = 0; i < kSlivers; ++i) {
            const float s = static_cast<float>(i) / kSlivers;
            const float t = static_cast<float>(i + 1) / kSlivers;
            sum += quadFormFactor(p + s * across, p + t * across, p + t * across + along,
                                  p + s * across + along);
        }
        EXPECT_NEAR(quadFormFactor(p, p + across, p + across + along, p + along), sum, 1e-4f);
        EXPECT_GT(sum, 0.005f) << height;
    }
    // Only the lit side emits, and nothing comes from below.
    EXPECT_EQ(quadFormFactor(d, c, b, a), 0.0f);
    EXPECT_EQ(quadFormFactor({0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}), 0.0f);
}

// --- The specular lobe ---

// f cos / albedo of GGX with height-correlated Smith masking, Fresnel left out, at l; n = +z.
double lobeAt(const vec3& v, const vec3& l, float alpha, double albedo) {
    if (l.z <= 0.0f)
        return 0.0;
    const vec3 h = glm::normalize(v + l);
    return shading::D_GGX_Sin2(h.z, h.x * h.x + h.y * h.y, alpha) *
           shading::V_SmithGGXCorrelated(v.z, l.z, alpha) * l.z / albedo;
}

double albedoOf(float NoV, float perceptualRoughness) {
    const glm::vec2 dfg(integrateDfg(NoV, perceptualRoughness));
    return dfg.x + dfg.y;
}

// Its share that comes from a cone, by quadrature.
double shareOfCone(const vec3& v, const vec3& axis, double sin2, float perceptualRoughness) {
    const float alpha = shading::alphaFromPerceptualRoughness(perceptualRoughness);
    const double albedo = albedoOf(v.z, std::max(perceptualRoughness, 0.045f));
    vec3 x, y;
    shading::orthonormalBasis(axis, x, y);
    static const GaussLegendre nodes(64);
    const double cosMax = std::sqrt(1.0 - sin2);
    double sum = 0.0;
    constexpr int kTurns = 128;
    for (int i = 0; i < nodes.size(); ++i) {
        const double c = 1.0 - nodes.node01(i) * (1.0 - cosMax), s = std::sqrt(1.0 - c * c);
        for (int k = 0; k < kTurns; ++k) {
            const double phi = glm::two_pi<double>() * (k + 0.5) / kTurns;
            const vec3 l = static_cast<float>(s * std::cos(phi)) * x +
                           static_cast<float>(s * std::sin(phi)) * y + static_cast<float>(c) * axis;
            sum += nodes.weight01(i) * lobeAt(v, l, alpha, albedo);
        }
    }
    return sum * glm::two_pi<double>() * (1.0 - cosMax) / kTurns;
}

// The same of the rectangle center ± x ± y.
double shareOfRectangle(const vec3& v, const vec3& center, const vec3& x, const vec3& y,
                        float perceptualRoughness) {
    const float alpha = shading::alphaFromPerceptualRoughness(perceptualRoughness);
    const double albedo = albedoOf(v.z, std::max(perceptualRoughness, 0.045f));
    const vec3 normal = glm::cross(y, x); // towards the lit side, length: a quarter of the area
    double sum = 0.0;
    constexpr int kSteps = 96;
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const vec3 p = center + (2.0f * (static_cast<float>(i) + 0.5f) / kSteps - 1.0f) * x +
                           (2.0f * (static_cast<float>(k) + 0.5f) / kSteps - 1.0f) * y;
            const double distance2 = glm::dot(p, p);
            const double facing = -glm::dot(p, normal) / std::sqrt(distance2);
            if (facing > 0.0)
                sum += facing / distance2 * lobeAt(v, glm::normalize(p), alpha, albedo);
        }
    return sum * 4.0 / (kSteps * kSteps);
}

vec3 viewer(float NoV) {
    return {std::sqrt(1.0f - NoV * NoV), 0.0f, NoV};
}

struct Errors {
    double worst = 0.0, sum = 0.0, signedSum = 0.0;
    int count = 0;
    void add(double found, double exact) {
        worst = std::max(worst, std::abs(found - exact));
        sum += std::abs(found - exact);
        signedSum += found - exact;
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double bias() const { return signedSum / count; }
};

// Random viewers, roughnesses and lights in the reach of the lobe.
template <class Compare>
Errors sweep(float low, float high, const Compare& compare) {
    std::mt19937 random(5);
    const auto uniform = [&](float a, float b) {
        return a + (b - a) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    Errors errors;
    for (int i = 0; i < 300; ++i)
        compare(errors, viewer(uniform(0.1f, 1.0f)), uniform(low, high), uniform);
    return errors;
}

void compareSphere(Errors& errors, const vec3& v, float r,
                   const std::function<float(float, float)>& uniform) {
    const float spread = 0.2f + 0.8f * r * r;
    vec3 d = glm::normalize(vec3(-v.x, 0, v.z) +
                            spread * vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    const float sin2 = uniform(0.02f, 0.6f);
    errors.add(shading::lobeOfSphere(lobeFit(r, v.z), d, sin2), shareOfCone(v, d, sin2, r));
}

void compareRectangle(Errors& errors, const vec3& v, float r,
                      const std::function<float(float, float)>& uniform) {
    const float spread = 0.2f + 0.8f * r * r;
    const vec3 center = glm::normalize(
        vec3(-v.x, 0, v.z) + spread * vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    vec3 x, y;
    shading::orthonormalBasis(center, x, y);
    x *= uniform(0.15f, 0.8f);
    y = 0.9f * y + 0.3f * center; // tilted
    y *= uniform(0.15f, 0.8f);
    if (glm::dot(glm::cross(y, x), center) > 0.0f)
        x = -x;
    errors.add(shading::lobeOfQuad(lobeFit(r, v.z), center - x - y, center + x - y, center + x + y,
                                   center - x + y),
               shareOfRectangle(v, center, x, y, r));
}

TEST(AreaLight, SpecularShareOfSpheresAgreesWithQuadrature) {
    for (const auto& [low, high] : {std::pair{0.2f, 0.5f}, {0.5f, 0.8f}, {0.8f, 1.0f}}) {
        const Errors errors = sweep(low, high, compareSphere);
        RecordProperty("worst", std::to_string(errors.worst));
        EXPECT_LT(errors.worst, 0.07) << low;
        EXPECT_LT(errors.mean(), 0.01) << low;
        EXPECT_LT(std::abs(errors.bias()), 0.006) << low;
    }
}

TEST(AreaLight, SpecularShareOfRectanglesAgreesWithQuadrature) {
    for (const auto& [low, high] : {std::pair{0.25f, 0.5f}, {0.5f, 0.8f}, {0.8f, 1.0f}}) {
        const Errors errors = sweep(low, high, compareRectangle);
        RecordProperty("worst", std::to_string(errors.worst));
        EXPECT_LT(errors.worst, 0.07) << low;
        EXPECT_LT(errors.mean(), 0.01) << low;
        EXPECT_LT(std::abs(errors.bias()), 0.006) << low;
    }
}

// What has no size sends nothing, however bright; a wall of light sends all of the lobe.
TEST(AreaLight, SizesFromNothingToEverything) {
    const glm::vec4 fit = lobeFit(0.5f, 0.6f);
    const vec3 d = glm::normalize(vec3(-0.7f, 0.1f, 0.6f));
    EXPECT_EQ(shading::lobeOfSphere(fit, d, 0.0f), 0.0f);
    EXPECT_EQ(shading::lobeOfSphere(fit, d, 1.0f), 1.0f);
    EXPECT_EQ(shading::lobeOfQuad(fit, d, d, d, d), 0.0f);
    const float far = 1e4f; // a ceiling
    const vec3 a(-far, -far, 1), b(far, -far, 1), c(far, far, 1), e(-far, far, 1);
    EXPECT_NEAR(quadFormFactor(a, b, c, e), 1.0f, 1e-3f);
    EXPECT_NEAR(shading::lobeOfQuad(fit, a, b, c, e), 1.0f, 0.06f);
    // Small ones grow with their solid angle: the lobe's density times it.
    const double density = lobeAt(viewer(0.6f), d, 0.25f, albedoOf(0.6f, 0.5f));
    for (const float sin2 : {1e-4f, 1e-6f})
        EXPECT_NEAR(shading::lobeOfSphere(fit, d, sin2) / (glm::pi<float>() * sin2), density,
                    0.1 * density)
            << sin2;
}

TEST(AreaLight, SphereAndDiscLikePolygonsAgree) {
    // A sphere far away and a square of the same solid angle are the same light.
    for (const float r : {0.3f, 0.6f, 1.0f})
        for (const float NoV : {0.2f, 0.6f, 0.95f}) {
            const glm::vec4 fit = lobeFit(r, NoV);
            const vec3 d = glm::normalize(vec3(-viewer(NoV).x, 0.1f, NoV));
            vec3 x, y;
            shading::orthonormalBasis(d, x, y);
            const float sin2 = 4e-4f, half = 0.5f * std::sqrt(glm::pi<float>() * sin2);
            const vec3 hx = half * x, hy = half * y;
            const float square = std::max(
                shading::lobeOfQuad(fit, d - hx - hy, d + hx - hy, d + hx + hy, d - hx + hy),
                shading::lobeOfQuad(fit, d - hx + hy, d + hx + hy, d + hx - hy, d - hx - hy));
            EXPECT_NEAR(shading::lobeOfSphere(fit, d, sin2), square, 0.02f * square) << r << NoV;
            EXPECT_GT(square, 1e-6f);
        }
}

// Any surface, any light, also where it makes no sense: finite, not negative, and no more than a
// white surface can reflect of the light's radiance.
TEST(AreaLight, NothingMakesNaN) {
    const vec3 n(0, 0, 1);
    const float places[] = {-3.0f, -1.0f, -1e-6f, 0.0f, 1e-4f, 1.0f, 1e3f};
    int count = 0;
    for (const float r : {0.0f, 0.3f, 1.0f})
        for (const float NoV : {-0.2f, 0.0f, 1e-4f, 0.5f, 1.0f}) {
            const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
            const float cosine = std::max(NoV, shading::kMinNoV);
            const auto s =
                shading::makeSurface(shading::defaultBrdfModel(), {vec3(1.0f), r, r, 0.0f}, n, v,
                                     glm::vec2(integrateDfg(cosine, r)));
            const glm::vec4 fit = lobeFit(r, cosine);
            for (const float x : places)
                for (const float z : places)
                    for (const float size : {0.0f, 1e-5f, 1.0f, 1e4f}) {
                        const vec3 to(x, 0.0f, z);
                        const auto sphere = shading::shadeSphere(s, fit, to, size, vec3(1.0f));
                        const auto quad =
                            shading::shadeRectangle(s, fit, to, vec3(size, 0, 0),
                                                    vec3(0, 0.6f * size, 0.8f * size), vec3(1.0f));
                        for (const auto& light : {sphere, quad})
                            for (int c = 0; c < 3; ++c) {
                                EXPECT_GE(light.diffuse[c], 0.0f); // false for NaN
                                EXPECT_LE(light.diffuse[c], 1.001f);
                                EXPECT_GE(light.specular[c], 0.0f);
                                EXPECT_LE(light.specular[c], 1.001f);
                                ++count;
                            }
                        if (testing::Test::HasFailure()) {
                            FAIL() << r << ' ' << NoV << ' ' << x << ' ' << z << ' ' << size;
                        }
                    }
        }
    EXPECT_GT(count, 15'000);
}

// The table is what tools/FitLobes.cpp makes: a mirror-like lobe at one end, a wide one at the
// other.
TEST(LobeTable, HoldsLobesOfEveryRoughness) {
    ASSERT_EQ(lobeTable().size(), std::size_t{kLobeTableSize} * kLobeTableSize);
    for (const glm::vec4& fit : lobeTable())
        EXPECT_GT(fit.x * fit.w - fit.y * fit.z, 0.0f); // keeps the orientation of polygons
    EXPECT_NEAR(lobeFit(0.0f, 1.0f).w, 2.0f * 0.045f * 0.045f, 1e-4f);
    EXPECT_GT(lobeFit(1.0f, 1.0f).w, 1.0f);
    EXPECT_EQ(lobeFit(-1.0f, 2.0f), lobeTable().front());
    EXPECT_EQ(lobeFit(2.0f, -1.0f), lobeTable().back());
}

} // namespace
} // namespace patina
