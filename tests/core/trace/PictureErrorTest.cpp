#include "core/trace/error/PictureError.h"

#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/mesh/Mesh.h"
#include "core/trace/error/PictureErrorMap.h"
#include "core/trace/error/SeenMaterials.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

constexpr int kWide = 48, kHigh = 32;

View linearView() {
    View view;
    view.toneMap = ToneMap::Clamp;
    return view;
}

float truthAt(int x, int y) {
    return 0.1f + 0.4f * static_cast<float>(x) / kWide + 0.2f * static_cast<float>(y) / kHigh;
}

// Of samples around truthAt() that scatter by `deviation`, as a share of it.
Film filmOf(double deviation, std::uint32_t samples) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Film film(kWide, kHigh);
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x)
            for (std::uint32_t i = 0; i < samples; ++i)
                film.at(x, y).add(
                    glm::vec3(truthAt(x, y) * static_cast<float>(1.0 + deviation * normal(random))),
                    1.0f);
    return film;
}

template <class Scale>
Image drawnBy(Scale scale, int channels = 3) {
    Image image(kWide, kHigh, channels, PixelType::F32, ColorEncoding::Linear);
    float* out = image.f32().data();
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x)
            for (int c = 0; c < channels; ++c)
                *out++ = c == 3 ? 1.0f : truthAt(x, y) * scale(x, y);
    return image;
}

PictureError errorOf(const Image& drawn, const Film& film, std::span<const Id> materials = {}) {
    Result<PictureError> error =
        pictureError(drawn, *tracedPicture(film), linearView(), materials, {});
    EXPECT_TRUE(error.ok()) << (error ? "" : error.error().message);
    return *std::move(error);
}

std::size_t hatchedPixels(const PictureError& error) {
    std::size_t count = 0;
    for (const std::uint8_t within : error.withinNoise)
        count += within;
    return count;
}

TEST(PictureError, OfTheSamePictureThereIsNone) {
    const PictureError error = errorOf(drawnBy([](int, int) { return 1.0f; }, 4), filmOf(0.0, 4));
    EXPECT_NEAR(error.whole.flip, 0.0, 1e-6);
    EXPECT_NEAR(error.whole.biasEv, 0.0, 1e-6);
    EXPECT_NEAR(error.whole.relative, 0.0, 1e-6);
    EXPECT_EQ(error.whole.pixels, static_cast<std::size_t>(kWide * kHigh));
    EXPECT_TRUE(error.materials.empty());
    EXPECT_EQ(hatchedPixels(error), 0u) << "nothing is uncertain";
}

TEST(PictureError, AnExposureIsFoundAsOne) {
    const float half = std::sqrt(2.0f);
    const PictureError error = errorOf(drawnBy([half](int, int) { return half; }), filmOf(0.0, 4));
    EXPECT_NEAR(error.whole.biasEv, 0.5, 1e-6);
    EXPECT_LT(error.whole.biasEvNoise, 1e-5);
    EXPECT_EQ(hatchedPixels(error), 0u);
    EXPECT_GT(error.whole.flip, 0.05);
    EXPECT_NEAR(error.whole.flipNoise, 0.0, 2e-4);
    for (int x = 0; x < kWide; ++x) { // dark ones count less
        EXPECT_GT(error.exposure.f32()[static_cast<std::size_t>(x)], 0.3f);
        EXPECT_LT(error.exposure.f32()[static_cast<std::size_t>(x)], 0.5f);
        EXPECT_LE(error.relative.f32()[static_cast<std::size_t>(x)], half - 1.0f + 1e-6f);
    }
}

// Noise of the traced picture is not sold as an error of the drawn one.
TEST(PictureError, NoiseIsToldFromError) {
    const std::uint32_t samples = 16;
    const double deviation = 0.4; // of a sample: 10 % of the mean of 16
    const PictureError right =
        errorOf(drawnBy([](int, int) { return 1.0f; }), filmOf(deviation, samples));
    EXPECT_LT(std::abs(right.whole.biasEv), 4.0 * right.whole.biasEvNoise);
    EXPECT_NEAR(right.whole.biasEvNoise, 0.1 / std::sqrt(kWide * kHigh) / std::log(2.0), 0.0008);
    EXPECT_LT(right.whole.relative, 0.03) << "of the 10 % that the noise is";
    EXPECT_GT(right.whole.flip, 0.01);
    EXPECT_NEAR(right.whole.flipNoise, right.whole.flip, 0.25 * right.whole.flip);
    // 95.4 % of a normal distribution; a standard error of 16 samples is uncertain itself.
    EXPECT_GT(static_cast<double>(hatchedPixels(right)), 0.9 * kWide * kHigh);

    const PictureError wrong =
        errorOf(drawnBy([](int, int) { return 1.5f; }), filmOf(deviation, samples));
    EXPECT_GT(wrong.whole.flip, 2.0 * wrong.whole.flipNoise);
    EXPECT_NEAR(wrong.whole.relative, 0.5, 0.05);
    EXPECT_LT(static_cast<double>(hatchedPixels(wrong)), 0.05 * kWide * kHigh);
}

TEST(PictureError, EachMaterialHasItsOwn) {
    std::vector<Id> materials;
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x)
            materials.push_back(y < 8 ? 0 : x < kWide / 2 ? 5 : 3);
    const PictureError error =
        errorOf(drawnBy([](int x, int y) { return y >= 8 && x >= kWide / 2 ? 0.5f : 1.0f; }),
                filmOf(0.01, 64), materials);
    ASSERT_EQ(error.materials.size(), 2u) << "the background is none";
    EXPECT_EQ(error.materials[0].material, 3u) << "the largest error first";
    EXPECT_NEAR(error.materials[0].biasEv, -1.0, 0.01);
    EXPECT_NEAR(error.materials[1].biasEv, 0.0, 0.01);
    EXPECT_EQ(error.materials[0].pixels + error.materials[1].pixels,
              static_cast<std::size_t>(kWide * (kHigh - 8)));
    EXPECT_GT(error.materials[0].flip, 4.0 * error.materials[1].flip);
    EXPECT_LT(error.whole.flip, error.materials[0].flip);
}

TEST(PictureError, PicturesThatCannotBeComparedAreRefused) {
    const Film film = filmOf(0.1, 4);
    const Image small(3, 2, 3, PixelType::F32, ColorEncoding::Linear);
    const Result<PictureError> size =
        pictureError(small, *tracedPicture(film), linearView(), {}, {});
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().kind, ErrorKind::Usage);
    EXPECT_NE(size.error().message.find("3 × 2"), std::string::npos);
    const Result<PictureError> broken =
        pictureError(drawnBy([](int x, int) { return x == 3 ? std::nanf("") : 1.0f; }),
                     *tracedPicture(film), linearView(), {}, {});
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().kind, ErrorKind::InputBroken);
    EXPECT_FALSE(tracedPicture(filmOf(0.1, 1))) << "one sample says nothing of its noise";
}

TEST(PictureErrorMap, WhatIsWithinTheNoiseIsHatched) {
    PictureError error = errorOf(drawnBy([](int, int) { return 2.0f; }), filmOf(0.0, 4));
    const Image plain = errorPicture(error, ErrorShown::Exposure);
    error.withinNoise[0] = 1;
    const Image hatched = errorPicture(error, ErrorShown::Exposure);
    EXPECT_NE(plain.u8()[0], hatched.u8()[0]);
    for (std::size_t i = 3; i < plain.u8().size(); ++i)
        ASSERT_EQ(plain.u8()[i], hatched.u8()[i]) << i;
    for (const ErrorShown shown : {ErrorShown::Relative, ErrorShown::Visible})
        EXPECT_EQ(errorPicture(error, shown).u8().size(), plain.u8().size());
}

// A large quad in front of a small one's half, seen along -z.
TEST(SeenMaterials, OfWhatIsInFront) {
    const auto quad = [](float left, float right, float z) {
        auto mesh = std::make_shared<Mesh>();
        mesh->positions = {{left, -9, z}, {right, -9, z}, {right, 9, z}, {left, 9, z}};
        mesh->normals.assign(4, {0, 0, 1});
        mesh->tangents.assign(4, {1, 0, 0, 1});
        mesh->uvs.assign(4, {0, 0});
        mesh->indices = {0, 1, 2, 0, 2, 3};
        return mesh;
    };
    TraceInputs inputs;
    inputs.materials.resize(2);
    inputs.materials[0].id = 11;
    inputs.materials[1].id = 12;
    inputs.meshes.push_back({1, quad(-9, 9, 0), glm::mat4(1.0f), 0});
    inputs.meshes.push_back({2, quad(-9, 0, 1), glm::mat4(1.0f), 1});
    const Result<TraceScene> scene = TraceScene::build(inputs, {});
    ASSERT_TRUE(scene);
    TraceView view;
    view.camera.target = glm::vec3(0.0f);
    view.camera.yawDeg = view.camera.pitchDeg = 0.0f;
    view.camera.distance = 5.0f;
    view.width = 8;
    view.height = 4;
    const std::vector<Id> seen = seenMaterials(*scene, view, {});
    ASSERT_EQ(seen.size(), 32u);
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_EQ(seen[i], i % 8 < 4 ? 12u : 11u) << i;
}

} // namespace
} // namespace patina
