#include "core/cells/ReferencePicture.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace patina {
namespace {

Image plain(int width, int height, float value, PixelType type = PixelType::F32) {
    const bool floats = type == PixelType::F32;
    Image image(width, height, 3, type, floats ? ColorEncoding::Linear : ColorEncoding::Srgb);
    if (floats)
        std::ranges::fill(image.f32(), value);
    else
        std::ranges::fill(image.u8(), static_cast<std::uint8_t>(std::lround(value * 255.0f)));
    return image;
}

TEST(ReferencePicture, ADisplayedPictureOfTheSameSizeIsAsItIs) {
    Image picture = plain(4, 3, 0.5f, PixelType::U8);
    picture.u8()[7] = 200;
    const auto made = referencePicture(picture, plain(4, 3, 0.1f, PixelType::U8), View(), {});
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->displayed, picture);
    EXPECT_EQ(made->note, "");
}

TEST(ReferencePicture, RadianceIsExposedAndToneMappedAsTheViewIs) {
    View view;
    view.exposureEv = 1.0f;
    for (const ToneMap curve : {ToneMap::PbrNeutral, ToneMap::Reinhard, ToneMap::Aces}) {
        view.toneMap = curve;
        const auto made = referencePicture(plain(8, 6, 0.3f), plain(4, 3, 0.1f), view, {});
        ASSERT_TRUE(made.ok());
        EXPECT_EQ(made->displayed.width(), 4);
        EXPECT_NEAR(made->displayed.u8()[0], 255.0f * displayedGrey(view, {}, 0.6f), 1.0f);
        EXPECT_EQ(made->note, "8 × 6 fitted to 4 × 3");
    }
    view.toneMap = ToneMap::OpenColorIo;
    EXPECT_FALSE(referencePicture(plain(4, 3, 0.3f), plain(4, 3, 0.1f), view, {}).ok());
}

// An exposure that adapts makes equal pictures of one scene in more or less light.
TEST(ReferencePicture, AnAutomaticExposureAdaptsToIt) {
    View view;
    view.exposureMode = ExposureMode::Automatic;
    const auto dim = referencePicture(plain(4, 3, 0.05f), plain(4, 3, 0.1f), view, {});
    const auto bright = referencePicture(plain(4, 3, 5.0f), plain(4, 3, 0.1f), view, {});
    ASSERT_TRUE(dim.ok() && bright.ok());
    EXPECT_NEAR(dim->displayed.u8()[0], bright->displayed.u8()[0], 1);
}

TEST(ReferencePicture, OtherProportionsAreStretchedOnlyWhenThatIsAsked) {
    const Image picture = plain(4, 4, 0.5f, PixelType::U8), cell = plain(8, 4, 0.5f, PixelType::U8);
    const auto refused = referencePicture(picture, cell, View(), {});
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("4 × 4, the cell has 8 × 4"), std::string::npos);
    ReferenceSettings stretch;
    stretch.stretch = true;
    const auto made = referencePicture(picture, cell, View(), stretch);
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->displayed.width(), 8);
    EXPECT_EQ(made->note, "4 × 4 stretched to 8 × 4");
}

TEST(ReferencePicture, ExposureIsMatchedInLinearLight) {
    ReferenceSettings match;
    match.matchExposure = true;
    const auto radiance = referencePicture(plain(4, 3, 0.1f), plain(4, 3, 0.4f), View(), match);
    ASSERT_TRUE(radiance.ok());
    EXPECT_NEAR(radiance->matchedEv, 2.0f, 1e-5f);
    EXPECT_NEAR(radiance->displayed.u8()[0], 255.0f * displayedGrey(View(), {}, 0.4f), 1.0f);
    const auto displayed = referencePicture(plain(4, 3, 0.2f, PixelType::U8),
                                            plain(4, 3, 0.6f, PixelType::U8), View(), match);
    ASSERT_TRUE(displayed.ok());
    EXPECT_NEAR(displayed->displayed.u8()[0], 153, 1);
    EXPECT_NE(displayed->note.find("exposure matched by +"), std::string::npos);
    // Nothing can be matched with black.
    EXPECT_TRUE(referencePicture(plain(4, 3, 0.0f), plain(4, 3, 0.4f), View(), match).ok());
}

} // namespace
} // namespace patina
