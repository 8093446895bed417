// Half floats as textures take them, checked against doubles.
#include "core/light/EnvironmentTexels.h"

#include "core/job/Parallel.h"
#include "core/light/CubeAtlas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace patina;

namespace {

double valueOf(std::uint16_t half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const double sign = half & 0x8000 ? -1.0 : 1.0;
    if (exponent == 0)
        return sign * std::ldexp(mantissa, -24);
    return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

double at(const HalfPicture& picture, int x, int y, int channel) {
    return valueOf(
        picture.texels.at(4 * static_cast<std::size_t>(y * picture.width + x) + channel));
}

ImagePtr picture(int width, int height, int channels,
                 const std::function<float(int x, int y, int c)>& value) {
    Image image(width, height, channels, PixelType::F32, ColorEncoding::Linear);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.f32()[i++] = value(x, y, c);
    return std::make_shared<const Image>(std::move(image));
}

} // namespace

TEST(EnvironmentTexels, HoldThePictureInHalfFloats) {
    // A fourth channel is no part of the light.
    const auto value = [](int x, int y, int c) {
        return c == 3 ? 7.0f : 0.001f * static_cast<float>(1 + x + 5 * y) * std::pow(40.0f, c);
    };
    for (const int channels : {3, 4}) {
        const HalfMipmapsPtr levels =
            *makeBackground(*picture(5, 3, channels, value), JobContext());
        const HalfPicture& full = levels->front();
        ASSERT_EQ(full.width, 5);
        ASSERT_EQ(full.height, 3);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x) {
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(at(full, x, y, c), value(x, y, c), value(x, y, c) * 0x1p-11);
                EXPECT_EQ(at(full, x, y, 3), 1.0);
            }
    }
}

TEST(EnvironmentTexels, MipmapsAreTheMeansOfWhatTheyCover) {
    // Odd sides: each texel covers parts of its neighbours' sources.
    const int width = 7, height = 5;
    const auto value = [](int x, int y, int c) { return static_cast<float>(x * x + 3 * y + c); };
    const HalfMipmapsPtr levels = *makeBackground(*picture(width, height, 3, value), JobContext());
    ASSERT_EQ(levels->size(), 3u);
    EXPECT_EQ((*levels)[1].width, 3);
    EXPECT_EQ((*levels)[1].height, 2);
    EXPECT_EQ((*levels)[2].width, 1);
    EXPECT_EQ((*levels)[2].height, 1);
    // Areas in 3 × 2 parts of a source texel: exact.
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            double sum = 0.0;
            for (int part = 0; part < width; ++part)      // thirds of columns
                for (int half = 0; half < height; ++half) // halves of rows
                    sum += value((x * width + part) / 3, (y * height + half) / 2, 1);
            const double mean = sum / (width * height);
            EXPECT_NEAR(at((*levels)[1], x, y, 1), mean, mean * 0x1p-11 + 1e-5);
        }
    double mean = 0.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            mean += static_cast<double>(value(x, y, 2)) / (width * height);
    EXPECT_NEAR(at((*levels)[2], 0, 0, 2), mean, mean * 0x1p-11 + 1e-5);
}

TEST(EnvironmentTexels, ThinPicturesReduceToOneTexel) {
    const HalfMipmapsPtr levels =
        *makeBackground(*picture(1, 6, 3, [](int, int y, int) { return float(y); }), JobContext());
    ASSERT_EQ(levels->size(), 3u);
    EXPECT_EQ((*levels)[1].width, 1);
    EXPECT_EQ((*levels)[1].height, 3);
    EXPECT_EQ(at((*levels)[1], 0, 2, 0), 4.5);
    EXPECT_EQ(at((*levels)[2], 0, 0, 0), 2.5);
}

TEST(EnvironmentTexels, ASunKeepsItsSizeInTheMipmaps) {
    const HalfMipmapsPtr levels = *makeBackground(
        *picture(2, 2, 3, [](int x, int y, int) { return x + y == 0 ? 1e7f : 0.0f; }),
        JobContext());
    EXPECT_EQ(at((*levels)[0], 0, 0, 0), 65504.0);
    EXPECT_EQ(at((*levels)[1], 0, 0, 0), 16376.0) << "a quarter of what level 0 shows";
}

TEST(EnvironmentTexels, AreTheSameOnOneThreadAndStopWhenCancelled) {
    const ImagePtr image =
        picture(129, 64, 3, [](int x, int y, int c) { return std::sin(float(x * y + c)) + 1.0f; });
    const HalfMipmapsPtr many = *makeBackground(*image, JobContext());
    {
        const ThreadLimit one(1);
        const HalfMipmapsPtr single = *makeBackground(*image, JobContext());
        ASSERT_EQ(many->size(), single->size());
        for (std::size_t i = 0; i < many->size(); ++i)
            EXPECT_EQ((*many)[i].texels, (*single)[i].texels) << i;
    }
    JobControl control;
    control.cancel();
    const auto cancelled = makeBackground(*image, control.context());
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(EnvironmentTexels, HoldTheAtlasOfTheLightAndCountWhatIsCutOff) {
    IblMaps maps;
    maps.prefiltered.push_back({2, std::vector<glm::vec3>(24, {0.25f, 2.0f, 4.0f})});
    maps.prefiltered[0].texels[5] = {1.0f, 65505.0f, 2.0f};
    maps.prefiltered[0].texels[6] = {1.0f, 65504.0f, 2.0f};
    maps.irradianceSh.fill(glm::vec3(0.0f));
    maps.radianceSh.fill(glm::vec3(0.0f));
    maps.irradianceSh[3] = glm::vec3(1.0f, 2.0f, 3.0f);
    maps.radianceSh[24] = glm::vec3(4.0f, 5.0f, 6.0f);
    const ImagePtr image = picture(1, 1, 3, [](int, int, int) { return 1.0f; });
    const EnvironmentTexels texels = makeEnvironmentTexels(image, maps, nullptr);
    EXPECT_EQ(texels.image, image);
    EXPECT_EQ(texels.side, 2);
    EXPECT_EQ(texels.levels, 1);
    EXPECT_EQ(texels.clamped, 1u);
    EXPECT_EQ(texels.irradianceSh, maps.irradianceSh);
    EXPECT_EQ(texels.radianceSh, maps.radianceSh);
    const CubeAtlas atlas = makeCubeAtlas(maps.prefiltered);
    ASSERT_EQ(texels.prefiltered.width, atlas.width);
    ASSERT_EQ(texels.prefiltered.height, atlas.height);
    for (int y = 0; y < atlas.height; ++y)
        for (int x = 0; x < atlas.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(at(texels.prefiltered, x, y, c),
                          std::min(atlas.texels[static_cast<std::size_t>(y * atlas.width + x)][c],
                                   65504.0f));
}
