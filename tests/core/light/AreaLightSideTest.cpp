// Whole area lights at a surface: from which side their light comes, and how much of it.
#include "core/light/DfgTable.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/light/LobeTable.h"
#include "core/math/Shading.h"

#include <cmath>
#include <gtest/gtest.h>

namespace patina {
namespace {

using glm::vec3;

struct Element {
    shading::SurfaceTerms surface;
    glm::vec4 fit;
};

// A grey, rough element at the origin that faces +Z and is seen from there, a little from aside.
Element element() {
    const float NoV = 0.9f, r = 0.6f;
    const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
    return {shading::makeSurface(shading::defaultBrdfModel(), {vec3(0.5f), 0.0f, r, 0.0f},
                                 vec3(0, 0, 1), v, glm::vec2(integrateDfg(NoV, r))),
            lobeFit(r, NoV)};
}

// The document's light as the renderer hands it to the shader.
shading::ShadedLight shade(const Light& light) {
    const Element e = element();
    const vec3 radiance = light.color * light.intensity;
    if (light.type == LightType::Sphere)
        return shading::shadeSphere(e.surface, e.fit, light.position, light.radius, radiance);
    const RectangleAxes axes = rectangleAxes(light);
    return shading::shadeRectangle(e.surface, e.fit, light.position, axes.x * (0.5f * light.width),
                                   axes.y * (0.5f * light.height), radiance);
}

void expectDiffuse(const Light& light, float formFactor) {
    const vec3 albedo = element().surface.diffuseAlbedo;
    const shading::ShadedLight shaded = shade(light);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shaded.diffuse[c], albedo[c] * light.intensity * formFactor,
                    2e-5f * light.intensity);
}

void expectDark(const Light& light) {
    const shading::ShadedLight shaded = shade(light);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(shaded.diffuse[c], 0.0f);
        EXPECT_EQ(shaded.specular[c], 0.0f);
    }
}

} // namespace

// Howell B-3: below the corner of a 1 × 1 square at distance 2 the factor is 0.0598641, below the
// centre of a 2 × 2 square four times that.
TEST(AreaLightSide, ARectangleShinesWhereItPoints) {
    Light light;
    light.type = LightType::Rectangle;
    light.position = {0, 0, 2};
    light.width = light.height = 2.0f;
    light.intensity = 3.0f;
    light.azimuthDeg = light.elevationDeg = 0.0f; // comes from +Z
    expectDiffuse(light, 4.0f * 0.0598641176f);
    EXPECT_GT(shade(light).specular.x, 0.0f);
    light.rollDeg = 90.0f; // a square looks the same
    expectDiffuse(light, 4.0f * 0.0598641176f);
    light.azimuthDeg = 180.0f; // turned away
    expectDark(light);
    light.azimuthDeg = 0.0f;
    light.position = {0, 0, -2}; // behind the surface
    expectDark(light);
}

// Howell B-3 again: 2 × 1 at distance 1, 0.1673750 below its corner: longer along x, or along y.
TEST(AreaLightSide, ARectangleIsAsWideAsItSays) {
    Light light;
    light.type = LightType::Rectangle;
    light.position = {1, 0.5f, 1};
    light.width = 2.0f;
    light.height = 1.0f;
    light.intensity = 1.0f;
    light.azimuthDeg = light.elevationDeg = 0.0f;
    expectDiffuse(light, 0.167375009914f);
    light.position = {0.5f, 1, 1};
    light.rollDeg = 90.0f;
    expectDiffuse(light, 0.167375009914f);
}

// Howell B-43: (r / d)² above; tilted by 0.5 it is 0.2193956.
TEST(AreaLightSide, ASphereShinesFromAbove) {
    Light light;
    light.type = LightType::Sphere;
    light.radius = 1.0f;
    light.intensity = 2.0f;
    light.position = {0, 0, 2};
    expectDiffuse(light, 0.25f);
    EXPECT_GT(shade(light).specular.y, 0.0f);
    light.position = {0, 2.0f * std::sin(0.5f), 2.0f * std::cos(0.5f)};
    expectDiffuse(light, 0.219395640473f);
    light.position = {0, 0, -2}; // below the horizon
    expectDark(light);
}

} // namespace patina
