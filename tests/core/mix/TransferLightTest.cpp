#include "core/mix/TransferLight.h"
#include "core/light/Light.h"

#include "core/light/Lights.h"
#include "core/light/NearRectangle.h"
#include "core/math/ShRotation.h"
#include "core/math/ShWindow.h"
#include "core/math/Shading.h"
#include "core/mix/EnvironmentBlend.h"
#include "tests/support/SecondEnvironment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

// On a surface with normal n, without shadows.
glm::vec3 irradiance(std::vector<glm::vec3> radiance, const glm::vec3& n) {
    convolveWithCosine(radiance);
    const int order = static_cast<int>(std::lround(std::sqrt(radiance.size())));
    std::vector<double> y(radiance.size());
    evaluateSh(order, glm::dvec3(n), y);
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < y.size(); ++i)
        sum += radiance[i] * static_cast<float>(y[i]);
    return sum;
}

std::vector<glm::vec3> turned(const glm::dvec3& axis, const ZonalHarmonics& zonal, int order) {
    std::vector<glm::vec3> c(static_cast<std::size_t>(shCount(order)), glm::vec3(0.0f));
    addZonal(zonal, axis, glm::dvec3(1.0), c);
    return c;
}

ImagePtr picture(int lampX) {
    Image image(32, 16, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>(3 * (y * 32 + x) + c)] =
                    0.1f * static_cast<float>(1 + c + y) + (x == lampX && y == 5 ? 30.0f : 0.0f);
    return std::make_shared<const Image>(std::move(image));
}

class TransferLight : public testing::Test {
  protected:
    std::span<const glm::vec3> projection(const EnvironmentPart& part) {
        if (!part.image || unknown == part.image)
            return {};
        auto& known = m_known[part.image];
        if (known.empty())
            known = projectLatLong(*part.image, kMaxShOrder);
        return known;
    }
    std::vector<glm::vec3> light(int order) {
        return transferLight(document, order,
                             [this](const EnvironmentPart& part) { return projection(part); });
    }
    Document document;
    ImagePtr unknown;

  private:
    std::map<ImagePtr, std::vector<glm::vec3>> m_known;
};

TEST_F(TransferLight, ASurfaceThatFacesADiscGetsAllOfItsLight) {
    for (int order = 2; order <= 8; ++order)
        for (const double diameter : {0.0, 0.53, 10.0, 45.0, 120.0}) {
            SCOPED_TRACE(order);
            SCOPED_TRACE(diameter);
            const ZonalHarmonics disc = discLight(diameter, order);
            const std::vector<glm::vec3> c = turned({0, 0, 1}, disc, order);
            EXPECT_NEAR(irradiance(c, {0, 0, 1}).x, 1.0f, 1e-5f);
            for (int i = 0; i <= 90; ++i) { // and none gets less than nothing
                const double t = kPi * i / 90.0;
                EXPECT_GT(irradiance(c, {std::sin(t), 0, std::cos(t)}).x, -1e-5f) << i;
            }
            for (int l = order; l < kMaxShOrder; ++l)
                EXPECT_EQ(disc[static_cast<std::size_t>(l)], 0.0);
        }
    // A larger disc is softer: less of it is in the upper bands.
    EXPECT_LT(discLight(90.0, 5)[4] / discLight(90.0, 5)[0],
              discLight(0.0, 5)[4] / discLight(0.0, 5)[0]);
}

// Three bands of a point are E(z) = .09375 + .5 z + .46875 z², at least -.0395833 (Ramamoorthi &
// Hanrahan 2001): with a factor a of the bands from 1 on 1/4 + a (E - 1/4), at least 0 for
// a = .25 / (.25 + .0395833).
TEST_F(TransferLight, DampingIsJustEnough) {
    EXPECT_NEAR(deringFactor(zonalDirectional(), 3), 0.25 / (0.25 + 0.0395833333333), 1e-4);
    double previous = 0.0;
    for (const int order : {2, 3, 5, 7}) { // the more bands the less there is to take away
        const double factor = deringFactor(zonalDirectional(), order);
        EXPECT_GT(factor, previous) << order;
        EXPECT_LT(factor, 1.0) << order;
        previous = factor;
        ZonalHarmonics damped = zonalDirectional();
        for (std::size_t l = 1; l < 8; ++l)
            damped[l] *= factor;
        EXPECT_NEAR(lowestIrradiance(turned({0, 0, 1}, damped, order)).value, 0.0, 1e-4) << order;
    }
    EXPECT_NEAR(deringFactor(zonalDirectional(), 2), 0.5, 1e-12);
    EXPECT_EQ(deringFactor(zonalCap(kPi), 5), 1.0); // light from everywhere rings nowhere
    EXPECT_EQ(deringFactor(zonalDirectional(), 1), 1.0);
    const std::array<float, 8> near = nearLightWindow(4);
    EXPECT_EQ(near[0], 1.0f);
    EXPECT_NEAR(near[1], 0.25 / (0.25 + 0.0395833333333), 1e-4);
    EXPECT_EQ(near[3], near[1]);
    for (std::size_t l = 4; l < 8; ++l)
        EXPECT_EQ(near[l], 0.0f);
}

// Directional lights that shine, with gain and tint; others are seen differently from each point.
TEST_F(TransferLight, HoldsTheDirectionalLightsOfTheMix) {
    Light sun;
    sun.intensity = 2.0f;
    sun.gainEv = 1.0f;
    sun.tint = {1.0f, 0.5f, 0.25f};
    sun.shadowSoftness = 5.0f;
    Light off = sun, point = sun;
    off.enabled = false;
    point.type = LightType::Point;
    document.lights = {sun, off, point};
    const glm::vec3 e = irradiance(light(5), sun.directionToLight());
    EXPECT_NEAR(e.x, 4.0f, 1e-4f);
    EXPECT_NEAR(e.y, 2.0f, 1e-4f);
    EXPECT_NEAR(e.z, 1.0f, 1e-4f);
    document.lights[2].solo = true;
    for (const glm::vec3& c : light(5))
        EXPECT_EQ(c, glm::vec3(0.0f));
}

TEST_F(TransferLight, EnvironmentsAreTurnedScaledAndFadedExactly) {
    Environment& other = test::addSecond(document, "/b.hdr", picture(20));
    other.rotationDeg = -120.0f;
    other.exposureEv = 2.0f;
    Environment& e = document.environment();
    e.image = picture(3);
    e.rotationDeg = 33.3f;
    e.tint = {1.0f, 0.5f, 0.25f};
    const std::vector<glm::vec3> first = light(6);
    // Rotating the environment rotates what arrives with them.
    const auto still = projectLatLong(*e.image, 6);
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, 0.5f, -0.8f));
    const float back = glm::radians(-33.3f);
    const glm::vec3 before = shading::rotateY(n, back);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(irradiance(first, n)[c], e.tint[c] * irradiance(still, before)[c], 1e-4f);

    document.mix.fade = 1.0f;
    const std::vector<glm::vec3> second = light(6);
    document.mix.fade = 0.3f;
    const std::vector<glm::vec3> both = light(6);
    for (std::size_t i = 0; i < both.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(both[i][c], 0.7f * first[i][c] + 0.3f * second[i][c],
                        1e-6f * std::abs(both[0][c]));

    // While the second's coefficients are not known, the picture that is shown has them.
    resolveBlend(document);
    unknown = other.image;
    const std::vector<glm::vec3> shown = light(6);
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_NEAR(shown[i].x, both[i].x, 5e-3f * both[0].x) << i;
    unknown = e.image;
    document.mix.blended = nullptr;
    for (const glm::vec3& c : light(6))
        EXPECT_EQ(c, glm::vec3(0.0f));
}

// Lights near by: the same light as the analytic ones', on a surface that faces them.
TEST_F(TransferLight, NearLightsAgreeWithAnalyticOnes) {
    const auto facing = [](std::span<const float> y, const glm::vec3& n, int order) {
        std::vector<double> basis(static_cast<std::size_t>(shCount(order)));
        evaluateSh(order, glm::dvec3(n), basis);
        double sum = 0.0;
        for (int l = 0; l < order; ++l)
            for (int m = -l; m <= l; ++m)
                sum += cosineConvolution(l) * basis[static_cast<std::size_t>(shIndex(l, m))] *
                       y[static_cast<std::size_t>(shIndex(l, m))];
        return sum;
    };
    std::array<float, 64> y{};
    for (int order = 2; order <= 8; ++order) {
        const std::array<float, 8> window = nearLightWindow(order);
        const glm::vec3 n = glm::normalize(glm::vec3(1, -2, 0.5f));
        shading::nearPointSh(n, order, window.data(), y.data());
        EXPECT_NEAR(facing(y, n, order), 1.0, 1e-5) << order;
        for (const float radius : {0.001f, 0.5f, 1.9f}) {
            Light sphere;
            sphere.type = LightType::Sphere;
            sphere.radius = radius;
            sphere.position = 2.0f * n;
            sphere.intensity = 3.0f;
            shading::nearSphereSh(sphere.position, radius, order, window.data(), y.data());
            const double expected = illuminanceAt(sphere, {});
            EXPECT_NEAR(3.0 * facing(y, n, order), expected, 1e-5 * expected) << order;
        }
        shading::nearSphereSh({0.1f, 0, 0}, 1.0f, order, window.data(), y.data()); // inside
        EXPECT_NEAR(facing(y, n, order), kPi, 1e-5);
        for (const float size : {0.01f, 0.4f, 2.0f}) {
            Light panel;
            panel.type = LightType::Rectangle;
            panel.width = panel.height = size;
            panel.intensity = 1.0f;
            setDirectionToLight(panel, n);
            panel.position = 2.0f * n;
            const RectangleAxes axes = rectangleAxes(panel);
            projectRectangle(
                nearRectangle(panel.position, 0.5f * size * axes.x, 0.5f * size * axes.y), {},
                order, window, y);
            const double expected = illuminanceAt(panel, {});
            // A square is not quite the cap of its solid angle.
            EXPECT_NEAR(facing(y, n, order), expected, 0.02 * expected) << order << ' ' << size;
        }
    }
}

// What a place sees of lights near by: each as its closed form says, added to what is there.
TEST_F(TransferLight, AddsTheNearLightsThatShineAsAPlaceSeesThem) {
    constexpr int kOrder = 5;
    const glm::vec3 place(0.5f, -1.0f, 0.25f), up(0, 1, 0);
    const auto seen = [&](const std::vector<Light>& lights) {
        document.lights = lights;
        std::vector<glm::vec3> sum(25, glm::vec3(0.0f));
        addNearLights(document, place, kOrder, sum);
        return sum;
    };
    const auto dark = [](const std::vector<glm::vec3>& sum) {
        return std::ranges::all_of(sum, [](const glm::vec3& c) { return c == glm::vec3(0.0f); });
    };
    Light bulb;
    bulb.type = LightType::Point;
    bulb.color = {1.0f, 0.5f, 0.25f};
    bulb.intensity = 8.0f;
    bulb.position = place + 2.0f * up;
    const std::vector<glm::vec3> one = seen({bulb});
    for (int c = 0; c < 3; ++c) // I / d²
        EXPECT_NEAR(irradiance(one, up)[c], 2.0f * bulb.color[c], 1e-5f);
    // Band 0 of a point is damped by no window: L_00 = I / d² Y_00, times what makes up for the
    // rest.
    const float ratio = one[6].x / one[0].x; // Y_20 / Y_00 towards y, times the window
    EXPECT_NEAR(ratio, -0.5f * std::sqrt(5.0f) * nearLightWindow(kOrder)[2], 1e-5f);

    Light far = bulb, off = bulb, sun = bulb, spot = bulb;
    far.range = 1.5f;
    off.enabled = false;
    sun.type = LightType::Directional;
    spot.type = LightType::Spot;
    setDirectionToLight(spot, -up); // emits upwards
    for (const Light& light : {far, off, sun, spot})
        EXPECT_TRUE(dark(seen({light}))) << static_cast<int>(light.type);
    setDirectionToLight(spot, up);
    EXPECT_NEAR(irradiance(seen({spot}), up).x, 2.0f, 1e-5f);
    Light alone = bulb;
    alone.solo = true;
    EXPECT_EQ(seen({bulb, alone}), one) << "only what is solo";

    Light ball = bulb, panel = bulb;
    ball.type = LightType::Sphere;
    ball.radius = 0.5f;
    panel.type = LightType::Rectangle;
    panel.width = 1.0f;
    panel.height = 0.5f;
    setDirectionToLight(panel, up); // emits downwards
    // Of radiance 8: pi sin² of the ball.
    const std::vector<glm::vec3> ballLight = seen({ball}), panelLight = seen({panel});
    EXPECT_NEAR(irradiance(ballLight, up).x, 8.0 * kPi / 16.0, 1e-4);
    EXPECT_NEAR(irradiance(panelLight, up).x, illuminanceAt(panel, place), 0.02f);
    EXPECT_NEAR(panelLight[0].y, 0.5f * panelLight[0].x, 1e-6f);
    setDirectionToLight(panel, -up);
    EXPECT_TRUE(dark(seen({panel}))) << "from behind";
    setDirectionToLight(panel, up);

    // Together they add up, to what is there.
    document.lights = {bulb, ball, panel};
    std::vector<glm::vec3> sum(25, glm::vec3(1.0f));
    addNearLights(document, place, kOrder, sum);
    for (std::size_t i = 0; i < sum.size(); ++i)
        EXPECT_NEAR(sum[i].x, 1.0f + one[i].x + ballLight[i].x + panelLight[i].x, 1e-5f) << i;
}

} // namespace
} // namespace patina
