// What a sweep finds out about environments: black sides, and which are the same light.
#include "core/rank/SweepEnvironment.h"

#include "core/library/Library.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace patina;

namespace {

// 1 where the direction is on `side`, 0 elsewhere.
Image halfLit(const glm::dvec3& side, float elsewhere = 0.0f) {
    Image image(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
    const LatLongGrid grid(64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                image.f32()[3 * std::size_t(y * 128 + x) + c] =
                    glm::dot(grid.direction(x, y), side) > 0.0 ? 1.0f : elsewhere;
    return image;
}

Image rotated(const Image& image, float rotationDeg) {
    const EnvironmentMapping mapping =
        *EnvironmentMapping::create(EnvironmentLayout::LatLong, {image.width(), image.height()});
    return resampleEnvironment(image, mapping, mapping, {rotationDeg, 1.0f});
}

ImagePtr builtin(const char* name) {
    return *library::environment(name);
}

} // namespace

TEST(SweepEnvironment, BlackFromOneSideWhereverThatIs) {
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                   glm::dvec3(-0.3, 0.4, 0.866), glm::dvec3(0.61, -0.5, -0.61)}) {
        const SweepEnvironment lit = measureEnvironment("half", halfLit(side), {});
        EXPECT_TRUE(lit.blackFromOneSide()) << lit.darkestShare;
        EXPECT_GT(glm::dot(glm::dvec3(lit.darkestSide), -glm::normalize(side)), 0.99);
        const SweepEnvironment dim = measureEnvironment("dim", halfLit(side, 0.02f), {});
        EXPECT_FALSE(dim.blackFromOneSide()) << dim.darkestShare;
        EXPECT_NEAR(dim.darkestShare, 0.02, 0.003);
    }
}

TEST(SweepEnvironment, LightFromAllSidesOrFromNone) {
    const SweepEnvironment white = measureEnvironment("white", *builtin("white"), {});
    EXPECT_NEAR(white.darkestShare, 1.0, 0.01);
    EXPECT_FALSE(white.blackFromOneSide());
    const SweepEnvironment black =
        measureEnvironment("black", Image(64, 32, 3, PixelType::F32, ColorEncoding::Linear), {});
    EXPECT_TRUE(black.black);
    EXPECT_FALSE(black.blackFromOneSide());
}

TEST(SweepEnvironment, RecognisesCopiesRotatedOrSmaller) {
    std::vector<SweepEnvironment> environments;
    for (const library::Entry& entry : library::environments())
        environments.push_back(measureEnvironment(entry.name, *builtin(entry.name.c_str()), {}));
    const std::size_t own = environments.size();
    const auto at = [&](const std::string& name) {
        return std::size_t(std::ranges::find(environments, name, &SweepEnvironment::name) -
                           environments.begin());
    };
    environments.push_back(measureEnvironment("again", *builtin("sunset"), {}));
    environments.push_back(measureEnvironment("turned", rotated(*builtin("studio"), 77.5f), {}));
    environments.push_back(measureEnvironment("small", shrinkLatLong(*builtin("night"), 512), {}));
    // The same light, but brighter: another one.
    Image brighter = *builtin("studio");
    for (float& value : brighter.f32())
        value *= 1.05f;
    environments.push_back(measureEnvironment("brighter", brighter, {}));
    const auto same = findSameEnvironments(environments, {});
    for (std::size_t i = 0; i < own; ++i)
        EXPECT_FALSE(same[i]) << environments[i].name << " is " << environments[same[i]->of].name;
    ASSERT_TRUE(same[own] && same[own + 1] && same[own + 2]);
    EXPECT_EQ(same[own]->of, at("sunset"));
    EXPECT_TRUE(same[own]->exactly);
    EXPECT_EQ(same[own + 1]->of, at("studio"));
    EXPECT_FALSE(same[own + 1]->exactly);
    EXPECT_NEAR(same[own + 1]->rotationDeg, 77.5f, 0.2f);
    EXPECT_EQ(same[own + 2]->of, at("night"));
    EXPECT_NEAR(std::min(same[own + 2]->rotationDeg, 360.0f - same[own + 2]->rotationDeg), 0.0f,
                0.2f);
    EXPECT_FALSE(same[own + 3]);
}
