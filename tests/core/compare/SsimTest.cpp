#include "core/compare/Ssim.h"

#include "Pictures.h"
#include "core/image/Srgb.h"
#include "tests/reference/ImageReference.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

using namespace patina;
using patina::test::codedPicture;
using patina::test::codes;
using patina::test::floats;
using patina::test::linearPicture;
using patina::test::testColor;

namespace {

double ssim(const Image& a, const Image& b) {
    return computeSsim(a, b, JobContext())->mean;
}

Image grey(int width, int height, unsigned seed) {
    Image image(width, height, 1, PixelType::F32, ColorEncoding::Data);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.f32()[i++] = testColor(x, y, seed).y;
    return image;
}

} // namespace

TEST(Ssim, AgreesWithTheDefinition) {
    for (const auto& [width, height] : {std::pair(41, 90), std::pair(3, 7), std::pair(1, 1)}) {
        const Image a = grey(width, height, 1), b = grey(width, height, 2);
        const std::vector<double> expected = test::ssimReference(a, b);
        const Result<Ssim> result = computeSsim(a, b, JobContext());
        double sum = 0;
        int pixels = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double value = expected[static_cast<std::size_t>(y * width + x)];
                EXPECT_NEAR(result->map.sample(x, y, 0), value, 1e-6) << x << "," << y;
                if (width < 11 || (x >= 5 && x < width - 5 && y >= 5 && y < height - 5)) {
                    sum += value;
                    ++pixels;
                }
            }
        EXPECT_NEAR(result->mean, sum / pixels, 1e-6);
    }
}

// Constant pictures have neither variance nor covariance, and the rest is the ratio of the means.
TEST(Ssim, OfConstantPicturesIsKnown) {
    const Image black = codedPicture(20, 15, [](int, int) { return glm::vec3(0); });
    const Image white = codedPicture(20, 15, [](int, int) { return glm::vec3(255); });
    EXPECT_NEAR(ssim(black, white), 1e-4 / (1 + 1e-4), 1e-9);
    EXPECT_NEAR(ssim(codes(1, 1, 1, {51}), codes(1, 1, 1, {102})), (0.16 + 1e-4) / (0.2 + 1e-4),
                1e-6);
}

TEST(Ssim, IsOneForEqualPicturesOnlyAndSymmetric) {
    const Image a = codedPicture(40, 30, [](int x, int y) { return 255.0f * testColor(x, y, 1); });
    const Image b = codedPicture(40, 30, [](int x, int y) { return 255.0f * testColor(x, y, 2); });
    EXPECT_EQ(ssim(a, a), 1.0);
    EXPECT_LT(ssim(a, b), 1.0);
    EXPECT_EQ(ssim(a, b), ssim(b, a));
}

// Structure turned around: far below what an offset that keeps it would give.
TEST(Ssim, SeesStructure) {
    const auto stripes = [](float dark, float bright) {
        return codedPicture(33, 33,
                            [=](int x, int) { return glm::vec3(x % 4 < 2 ? dark : bright); });
    };
    EXPECT_LT(ssim(stripes(100, 150), stripes(150, 100)), -0.9);
    EXPECT_GT(ssim(stripes(100, 150), stripes(110, 160)), 0.9);
}

TEST(Ssim, IsOfDisplayEncodedLuma) {
    // Linear light is encoded, and cut to what a display shows.
    const Image a = codedPicture(12, 12, [](int x, int y) { return 255.0f * testColor(x, y, 1); });
    const Image linear = convertImage(a, PixelType::F32, ColorEncoding::Linear);
    EXPECT_NEAR(ssim(a, linear), 1.0, 1e-6);
    EXPECT_EQ(ssim(linearPicture(3, 3, [](int, int) { return glm::vec3(1); }),
                   linearPicture(3, 3, [](int, int) { return glm::vec3(7); })),
              1.0);
    // Rec.709 weighs green ten times as much as blue.
    const auto of = [&](const glm::vec3& color) {
        return ssim(codedPicture(1, 1, [&](int, int) { return color; }), codes(1, 1, 1, {0}));
    };
    EXPECT_NEAR(of({0, 255, 0}), 1e-4 / (0.7152 * 0.7152 + 1e-4), 1e-8);
    EXPECT_NEAR(of({0, 0, 255}), 1e-4 / (0.0722 * 0.0722 + 1e-4), 1e-7);
}

TEST(Ssim, RefusesWhatIsNoPicture) {
    const Image a = floats(1, 1, 1, {0});
    const auto kind = [](const Image& x, const Image& y) {
        return computeSsim(x, y, JobContext()).error().kind;
    };
    EXPECT_EQ(kind(a, floats(2, 1, 1, {0, 0})), ErrorKind::Usage);
    EXPECT_EQ(kind(floats(1, 1, 6, {}), floats(1, 1, 6, {})), ErrorKind::Usage);
    EXPECT_EQ(kind(a, floats(1, 1, 1, {std::numeric_limits<float>::quiet_NaN()})),
              ErrorKind::InputBroken);
    JobControl control;
    control.cancel();
    EXPECT_EQ(computeSsim(a, a, control.context()).error().kind, ErrorKind::Cancelled);
}
