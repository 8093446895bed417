#include "core/image/TextRaster.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

// Pixels that are not black, and how far right the last of them lies.
struct Ink {
    int count = 0, right = -1, top = 1 << 20, bottom = -1;
};
Ink ink(const Image& image) {
    Ink result;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (image.sample(x, y, 0) > 0.1f) {
                ++result.count;
                result.right = std::max(result.right, x);
                result.top = std::min(result.top, y);
                result.bottom = std::max(result.bottom, y);
            }
    return result;
}

TEST(TextRaster, DrawsALineOnItsBaseline) {
    const auto text = TextRaster::create();
    ASSERT_TRUE(text.ok()) << text.error().text();
    const int width = text->width("Hxz", 20);
    EXPECT_GT(width, 20);
    Image image(100, 40, 3, PixelType::U8, ColorEncoding::Srgb);
    text->draw(image, 0, 30, 20, glm::vec3(1.0f), "Hxz");
    const Ink drawn = ink(image);
    EXPECT_GT(drawn.count, 40);
    EXPECT_LE(drawn.right, width + 1);
    EXPECT_GE(drawn.right, width - 6);
    EXPECT_NEAR(drawn.bottom, 29, 1);
    EXPECT_NEAR(drawn.top, 15, 2); // capitals are some 0.73 em high
}

TEST(TextRaster, TakesAnyTextAndCutsOff) {
    const auto text = TextRaster::create();
    ASSERT_TRUE(text.ok()) << text.error().text();
    EXPECT_EQ(text->width("", 16), 0);
    EXPECT_GT(text->width("α·β ² …", 16), 16);
    Image image(8, 8, 4, PixelType::U8, ColorEncoding::Srgb);
    text->draw(image, -5, 4, 16, glm::vec3(1.0f), "Wide \xff\xfe text \xe2\x82");
    text->draw(image, 4, 100, 16, glm::vec3(1.0f), "below");
    EXPECT_GT(ink(image).count, 0);
}

} // namespace
