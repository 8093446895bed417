// The built-in materials: maps that tile, agree with each other and stay physically plausible.
#include "core/library/Library.h"
#include "core/library/MaterialRecipes.h"
#include "core/material/Material.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

using namespace patina;

namespace {

std::vector<std::string> materialNames() {
    std::vector<std::string> result;
    for (const library::Entry& entry : library::materials())
        result.push_back(entry.name);
    return result;
}

// Mean difference between two neighbouring columns (or rows).
float step(const Image& image, int a, int b, bool columns) {
    double sum = 0;
    const int n = image.width();
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < image.channels(); ++c)
            sum += std::fabs(columns ? image.sample(a, i, c) - image.sample(b, i, c)
                                     : image.sample(i, a, c) - image.sample(i, b, c));
    return static_cast<float>(sum / (n * image.channels()));
}

class EveryMaterial : public testing::TestWithParam<std::string> {
  protected:
    Material m = library::material(GetParam()).value();
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Library, EveryMaterial, testing::ValuesIn(materialNames()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST_P(EveryMaterial, HasItsMapsInTheRightStorage) {
    EXPECT_EQ(m.baseColor, glm::vec3(1.0f)); // maps multiply the numbers
    EXPECT_EQ(m.perceptualRoughness, 1.0f);
    const auto expectMap = [&](const MapSlot& slot, const char* map, int channels,
                               ColorEncoding encoding) {
        SCOPED_TRACE(map);
        ASSERT_NE(slot.image, nullptr);
        EXPECT_EQ(slot.source, "builtin:" + GetParam() + "/" + map);
        EXPECT_EQ(slot.image, library::map(GetParam() + "/" + map).value());
        EXPECT_EQ(slot.image->width(), 512);
        EXPECT_EQ(slot.image->height(), 512);
        EXPECT_EQ(slot.image->channels(), channels);
        EXPECT_EQ(slot.image->type(), PixelType::U8);
        EXPECT_EQ(slot.image->encoding(), encoding);
    };
    expectMap(m.baseColorMap, "baseColor", 3, ColorEncoding::Srgb);
    expectMap(m.normalMap, "normal", 3, ColorEncoding::Data);
    expectMap(m.perceptualRoughnessMap, "perceptualRoughness", 1, ColorEncoding::Data);
    expectMap(m.occlusionMap, "occlusion", 1, ColorEncoding::Data);
    if (m.metallicMap.assigned()) {
        expectMap(m.metallicMap, "metallic", 1, ColorEncoding::Data);
        EXPECT_EQ(m.metallic, 1.0f);
    } else {
        EXPECT_TRUE(m.metallic == 0.0f || m.metallic == 1.0f);
    }
}

TEST_P(EveryMaterial, TilesWithoutASeam) {
    for (const MapSlot* slot : {&m.baseColorMap, &m.normalMap, &m.perceptualRoughnessMap,
                                &m.metallicMap, &m.occlusionMap}) {
        if (!slot->image)
            continue;
        SCOPED_TRACE(slot->source);
        const Image& image = *slot->image;
        const int n = image.width();
        for (const bool columns : {true, false}) {
            float largest = 0.0f;
            for (int i = 0; i + 1 < n; ++i)
                largest = std::max(largest, step(image, i, i + 1, columns));
            // The border is no greater step than those a material has inside (boards, tows).
            EXPECT_LE(step(image, n - 1, 0, columns), 1.1f * largest + 0.002f);
        }
    }
}

TEST_P(EveryMaterial, NormalsAreUnitVectorsThatAverageToFlat) {
    const Image& image = *m.normalMap.image;
    glm::dvec3 sum(0.0);
    double deviation = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const glm::vec3 n(2.0f * image.sample(x, y, 0) - 1.0f,
                              2.0f * image.sample(x, y, 1) - 1.0f,
                              2.0f * image.sample(x, y, 2) - 1.0f);
            ASSERT_NEAR(glm::length(n), 1.0f, 0.012f);
            ASSERT_GT(n.z, 0.0f);
            sum += glm::dvec3(n);
            deviation += n.x * n.x + n.y * n.y;
        }
    const double count = static_cast<double>(image.width()) * image.height();
    EXPECT_NEAR(sum.x / count, 0.0, 0.02); // a height field that repeats has no slope on average
    EXPECT_NEAR(sum.y / count, 0.0, 0.02);
    EXPECT_GT(std::sqrt(deviation / count), 0.01); // and it is not flat
}

TEST_P(EveryMaterial, ReflectsNoMoreAndNoLessThanRealSurfaces) {
    const Image& color = *m.baseColorMap.image;
    double roughnessSum = 0, roughnessSquares = 0;
    for (int y = 0; y < color.height(); ++y)
        for (int x = 0; x < color.width(); ++x) {
            const glm::vec4 c = color.linear(x, y);
            const float metallic =
                m.metallicMap.image ? m.metallicMap.image->sample(x, y, 0) : m.metallic;
            const float darkest = std::min({c.r, c.g, c.b}), brightest = std::max({c.r, c.g, c.b});
            // One code of the 8-bit sRGB curve at either end.
            ASSERT_GE(darkest, 0.0195f) << x << ", " << y;
            ASSERT_TRUE(metallic > 0.05f || brightest <= 0.904f) << x << ", " << y;
            // No metal is black.
            ASSERT_TRUE(metallic < 0.95f || brightest >= 0.15f) << x << ", " << y;
            const double r = m.perceptualRoughnessMap.image->sample(x, y, 0);
            ASSERT_GE(r, 0.04);
            roughnessSum += r;
            roughnessSquares += r * r;
        }
    const double count = static_cast<double>(color.width()) * color.height();
    const double mean = roughnessSum / count;
    EXPECT_GT(std::sqrt(roughnessSquares / count - mean * mean), 0.005); // a real map
}

TEST_P(EveryMaterial, OcclusionDarkensHollowsOnly) {
    const Image& image = *m.occlusionMap.image;
    double sum = 0;
    float darkest = 1.0f, brightest = 0.0f;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const float value = image.sample(x, y, 0);
            sum += value;
            darkest = std::min(darkest, value);
            brightest = std::max(brightest, value);
        }
    EXPECT_GT(sum / (image.width() * image.height()), 0.7);
    EXPECT_EQ(brightest, 1.0f);
    EXPECT_LT(darkest, 0.98f);
}

// h = a sin(2 pi x) + a sin(2 pi y), x to the right and y down: the normal is
// (-dh/dx, +dh/dy, 1) in the frame right, up, out.
TEST(LibrarySurface, NormalsFollowTheHeightFieldInTheOpenGlConvention) {
    constexpr int n = 256;
    constexpr double kPi = 3.14159265358979, a = 0.02;
    library::Surface surface(n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            surface.height.row(y)[x] = static_cast<float>(a * std::sin(2 * kPi * (x + 0.5) / n) +
                                                          a * std::sin(2 * kPi * (y + 0.5) / n));
            surface.setColor(x, y, glm::vec3(0.5f));
            surface.roughness.row(y)[x] = 0.25f;
        }
    const library::SurfaceMaps maps = library::finishSurface(surface);
    for (int y = 0; y < n; y += 5)
        for (int x = 0; x < n; x += 5) {
            const double dx = a * 2 * kPi * std::cos(2 * kPi * (x + 0.5) / n);
            const double dy = a * 2 * kPi * std::cos(2 * kPi * (y + 0.5) / n);
            const glm::dvec3 expected = glm::normalize(glm::dvec3(-dx, dy, 1.0));
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(2.0 * maps.normal->sample(x, y, c) - 1.0, expected[c], 0.0045)
                    << x << ", " << y << ", " << c;
        }
    // Linear 0.5 is sRGB 187.5 of 255 (0.7354): either neighbour is as near; 0.25 * 255 = 63.75.
    EXPECT_EQ(maps.baseColor->u8()[0], 188);
    EXPECT_EQ(maps.perceptualRoughness->u8()[0], 64);
    EXPECT_EQ(maps.metallic, nullptr);
    EXPECT_EQ(maps.constantMetallic, 0.0f);
    // Crests are open, hollows are not.
    EXPECT_EQ(maps.occlusion->sample(n / 4, n / 4, 0), 1.0f);
    EXPECT_LT(maps.occlusion->sample(3 * n / 4, 3 * n / 4, 0), 0.98f);
}

TEST(LibrarySurface, BlurKeepsTheMeanAndRepeats) {
    constexpr int n = 64;
    library::Field spike(n);
    spike.at(1, 2) = 1.0f;
    const library::Field soft = library::blur(spike, 5);
    double sum = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            sum += soft.at(x, y);
    EXPECT_NEAR(sum, 1.0, 1e-5);
    for (int d = 0; d <= 12; ++d) { // symmetric, also over the border
        EXPECT_NEAR(soft.at(1 + d, 2), soft.at(1 - d, 2), 1e-8f);
        EXPECT_NEAR(soft.at(1, 2 + d), soft.at(1, 2 - d), 1e-8f);
    }
    EXPECT_NEAR(soft.at(1, 2), 1.0f / 121.0f,
                1e-6f); // a tent of tents: 11 / 11² in both directions
    EXPECT_EQ(soft.at(1 + 11, 2), 0.0f);
}
