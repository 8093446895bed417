#include "core/compare/Flip.h"

#include "Pictures.h"
#include "core/job/Parallel.h"
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

Image constant(int width, int height, const glm::vec3& code) {
    return codedPicture(width, height, [&](int, int) { return code; });
}

Image coded(int width, int height, unsigned seed) {
    return codedPicture(width, height,
                        [&](int x, int y) { return 255.0f * testColor(x, y, seed); });
}

// Some stops of light.
Image hdr(int width, int height, unsigned seed, float scale = 1.0f) {
    return linearPicture(width, height, [&](int x, int y) {
        return scale * testColor(x, y, seed) *
               std::exp2(static_cast<float>((x / 6 + y / 5) % 5) - 1.0f);
    });
}

Flip flip(const Image& image, const Image& reference, const FlipSettings& settings = {}) {
    Result<Flip> result = computeFlip(image, reference, JobContext(), settings);
    EXPECT_TRUE(result.ok());
    return std::move(*result);
}

double score(const Image& image, const Image& reference) {
    return flip(image, reference).error.summary.mean;
}

double largestDistance(const Image& map, const std::vector<double>& expected) {
    const std::span<const float> values = map.f32();
    EXPECT_EQ(values.size(), expected.size());
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(values[i]) - expected[i]));
    return largest;
}

} // namespace

// Against two-dimensional kernels in double precision, at the papers' 67 pixels per degree and at
// others.
TEST(Flip, EachTermAgreesWithItsDefinition) {
    const Image a = coded(37, 29, 1), b = coded(37, 29, 2);
    for (const double pixelsPerDegree : {kFlipPixelsPerDegree, 20.0, 1.0}) {
        SCOPED_TRACE(pixelsPerDegree);
        const test::FlipReference expected = test::flipReference(a, b, pixelsPerDegree);
        const Result<FlipTerms> terms = computeFlipTerms(a, b, JobContext(), pixelsPerDegree);
        EXPECT_LT(largestDistance(terms->color, expected.color), 1e-5);
        EXPECT_LT(largestDistance(terms->edge, expected.edge), 2e-6);
        EXPECT_LT(largestDistance(terms->point, expected.point), 2e-6);
        EXPECT_LT(largestDistance(flip(a, b, {pixelsPerDegree, {}}).error.values, expected.flip),
                  1e-4);
    }
}

TEST(Flip, HdrAgreesWithItsDefinition) {
    const Image a = hdr(31, 23, 1), b = hdr(31, 23, 2);
    const test::HdrFlipReference expected = test::hdrFlipReference(a, b, kFlipPixelsPerDegree);
    const Flip result = flip(a, b);
    ASSERT_TRUE(result.exposures);
    EXPECT_NEAR(result.exposures->start, expected.start, 1e-5);
    EXPECT_NEAR(result.exposures->stop, expected.stop, 1e-5);
    EXPECT_EQ(result.exposures->count, expected.count);
    EXPECT_GT(expected.count, 2);
    EXPECT_LT(largestDistance(result.error.values, expected.flip), 1e-4);
}

// Filters leave constant pictures as they are, and nothing has an edge. From the formulas: black
// and white are 100 apart, green and blue, the farthest, 203.305; (100 / 203.305)^0.7 = 0.60854 is
// beyond the knee at 0.4, so ΔE = 0.95 + 0.05 (0.60854 - 0.4) / 0.6.
TEST(Flip, OfConstantPicturesIsKnown) {
    const auto of = [](const glm::vec3& a, const glm::vec3& b) {
        const Flip result = flip(constant(3, 2, a), constant(3, 2, b));
        EXPECT_FLOAT_EQ(result.error.values.sample(0, 0, 0), result.error.values.sample(2, 1, 0));
        return result.error.summary.mean;
    };
    EXPECT_NEAR(of(glm::vec3(0), glm::vec3(255)), 0.95 + 0.05 * (0.608557 - 0.4) / 0.6, 1e-5);
    EXPECT_NEAR(of({0, 255, 0}, {0, 0, 255}), 1.0, 1e-5);
    EXPECT_NEAR(of({255, 0, 0}, {0, 0, 255}), 0.965078, 1e-5);
    EXPECT_NEAR(of(glm::vec3(128), glm::vec3(129)), 0.0298549, 1e-5);
    EXPECT_NEAR(score(codes(1, 1, 3, {0, 0, 0}), codes(1, 1, 3, {255, 255, 255})), 0.967379, 1e-5);
    EXPECT_NEAR(score(codes(1, 1, 1, {0}), codes(1, 1, 4, {255, 255, 255, 0})), 0.967379, 1e-5);
}

// Beside a step from black to white the positive half of the edge's kernel sees white and the rest,
// if anything, what does not count: its weights sum to 1. Of the point's kernel it is half of the
// weight at the centre, -0.298902. A single white pixel has no edge and is a point along x and y,
// each of them that weight times the Gaussian's, 0.145257.
TEST(Flip, OfAStepAndAPointIsKnown) {
    const Image black = constant(40, 40, glm::vec3(0));
    const Image step =
        codedPicture(40, 40, [](int x, int) { return glm::vec3(x < 20 ? 0.0f : 255.0f); });
    const Result<FlipTerms> ofStep = computeFlipTerms(step, black, JobContext());
    for (const int x : {19, 20}) {
        EXPECT_NEAR(ofStep->edge.sample(x, 17, 0), 1.0, 1e-6);
        EXPECT_NEAR(ofStep->point.sample(x, 17, 0), 0.298902 / 2, 1e-6);
    }
    EXPECT_EQ(ofStep->edge.sample(5, 17, 0), 0.0f);
    // ΔE_f = √(1 / √2) there, and ΔE_c is less than that of white and black.
    const double color = ofStep->color.sample(20, 17, 0);
    EXPECT_NEAR(flip(step, black).error.values.sample(20, 17, 0),
                std::pow(color, 1 - std::sqrt(std::sqrt(0.5))), 1e-5);

    const Image point = codedPicture(
        40, 40, [](int x, int y) { return glm::vec3(x == 20 && y == 20 ? 255.0f : 0.0f); });
    const Result<FlipTerms> ofPoint = computeFlipTerms(black, point, JobContext());
    EXPECT_NEAR(ofPoint->point.sample(20, 20, 0), std::sqrt(2.0) * 0.298902 * 0.145257, 1e-6);
    EXPECT_NEAR(ofPoint->edge.sample(20, 20, 0), 0.0, 1e-7);
}

TEST(Flip, IsExactlyZeroForEqualPicturesAndWhereAllAroundIsEqual) {
    const Image a = coded(50, 40, 1);
    EXPECT_EQ(flip(a, a).error.summary.max, 0.0);
    const Image light = hdr(50, 40, 1);
    EXPECT_EQ(flip(light, light).error.summary.max, 0.0);
    Image other = a;
    other.u8()[0] ^= 0x80;
    const Flip one = flip(a, other);
    EXPECT_GT(one.error.values.sample(0, 0, 0), 0.0f);
    EXPECT_EQ(one.error.values.sample(30, 30, 0), 0.0f);
    EXPECT_LT(one.error.summary.maxPosition.x, 10);
}

TEST(Flip, IsSymmetric) {
    const Image a = coded(150, 140, 1), b = coded(150, 140, 2);
    EXPECT_EQ(flip(a, b).error.values, flip(b, a).error.values);
    const Image c = hdr(40, 30, 1), d = hdr(40, 30, 2);
    const FlipSettings settings{kFlipPixelsPerDegree, FlipExposures{-2, 2, 3}};
    EXPECT_EQ(flip(c, d, settings).error.values, flip(d, c, settings).error.values);
    EXPECT_EQ(flip(c, d, settings).exposures, settings.exposures);
}

TEST(Flip, GrowsWithTheError) {
    const Image grey = constant(20, 20, glm::vec3(100));
    double last = 0;
    for (int offset = 1; offset <= 150; offset += 7) {
        const double now =
            score(constant(20, 20, glm::vec3(100.0f + static_cast<float>(offset))), grey);
        EXPECT_GT(now, last) << offset;
        last = now;
    }
    // Noise of growing strength on a picture with edges.
    const Image clean = coded(60, 40, 1);
    last = 0;
    for (const float strength : {2.0f, 8.0f, 20.0f, 50.0f}) {
        const Image noisy = codedPicture(60, 40, [&](int x, int y) {
            const float noise = testColor(x, y, 5).x - testColor(x, y, 6).x;
            return glm::clamp(255.0f * testColor(x, y, 1) + 20.0f * strength * noise, 0.0f, 255.0f);
        });
        const double now = score(noisy, clean);
        EXPECT_GT(now, last) << strength;
        last = now;
    }
}

// More of the same beyond the border changes nothing, nor does where a pixel lies in which tile.
TEST(Flip, GoesOnWithTheBorderBeyondIt) {
    const int width = 130, height = 20, margin = 11;
    const auto padded = [&](const Image& image) {
        return codedPicture(width + 2 * margin, height + 2 * margin, [&](int x, int y) {
            const int column = std::clamp(x - margin, 0, width - 1);
            const int row = std::clamp(y - margin, 0, height - 1);
            glm::vec3 color;
            for (int c = 0; c < 3; ++c)
                color[c] = 255.0f * image.sample(column, row, c);
            return color;
        });
    };
    const Image a = coded(width, height, 1), b = coded(width, height, 2);
    const Image bare = flip(a, b).error.values;
    const Image inside = flip(padded(a), padded(b)).error.values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ASSERT_EQ(bare.sample(x, y, 0), inside.sample(x + margin, y + margin, 0))
                << x << "," << y;
}

TEST(Flip, DoesNotDependOnThreads) {
    const Image a = coded(300, 200, 1), b = coded(300, 200, 2);
    Image alone;
    {
        const ThreadLimit limit(1);
        alone = flip(a, b).error.values;
    }
    const ThreadLimit limit(4);
    EXPECT_EQ(flip(a, b).error.values, alone);
}

// HDR-FLIP looks at all of a picture's range: twice the light of both is the same picture at other
// exposures.
TEST(Flip, OfMoreLightIsTheSameAtOtherExposures) {
    const Flip one = flip(hdr(40, 30, 1), hdr(40, 30, 2));
    const Flip brighter = flip(hdr(40, 30, 1, 8.0f), hdr(40, 30, 2, 8.0f));
    EXPECT_NEAR(brighter.exposures->start, one.exposures->start - 3, 1e-6);
    EXPECT_NEAR(brighter.exposures->stop, one.exposures->stop - 3, 1e-6);
    EXPECT_EQ(brighter.exposures->count, one.exposures->count);
    EXPECT_NEAR(brighter.error.summary.mean, one.error.summary.mean, 1e-5);
    // What only a dark exposure shows is an error, too, of which LDR-FLIP sees nothing.
    const auto lamp = [](float light) {
        return linearPicture(30, 30, [=](int x, int y) {
            return glm::vec3(x > 10 && x < 20 && y > 10 && y < 20 ? light : 0.2f);
        });
    };
    const auto cut = [](const Image& image) {
        return convertImage(image, PixelType::U8, ColorEncoding::Srgb);
    };
    EXPECT_EQ(score(cut(lamp(40)), cut(lamp(80))), 0.0);
    EXPECT_GT(flip(lamp(40), lamp(80)).error.values.sample(15, 15, 0), 0.1f);
}

// The tone curve takes 0.85 where 0.85 (2.43 y² + 0.59 y + 0.14) = 2.51 y² + 0.03 y, y = 0.6 x:
// x = 2.118872.
TEST(Flip, ExposuresAreThoseOfTheReference) {
    const Image grey = floats(3, 1, 1, {2.118872f, 0.5f * 2.118872f, 0.125f * 2.118872f});
    const FlipExposures exposures = flipExposures(grey);
    EXPECT_NEAR(exposures.start, 0.0, 1e-5);
    EXPECT_NEAR(exposures.stop, 1.0, 1e-5);
    EXPECT_EQ(exposures.count, 2);
    EXPECT_EQ(flipExposures(floats(2, 1, 1, {1.0f, 1.0f / 1000})).count, 2);
    EXPECT_EQ(flipExposures(floats(3, 1, 1, {1.0f, 1.0f / 1000, 0.0f})).count, 10);
    // Of an even number the upper one; of mostly black pictures that of what is not black.
    EXPECT_NEAR(flipExposures(floats(2, 1, 1, {2.118872f, 0.1f})).stop, 0.0, 1e-5);
    EXPECT_NEAR(flipExposures(floats(4, 1, 1, {0, 0, 0, 2.118872f})).stop, 0.0, 1e-5);
    EXPECT_EQ(flipExposures(floats(2, 1, 1, {0, -1})), FlipExposures());
    EXPECT_EQ(flip(floats(1, 1, 1, {0}), floats(1, 1, 1, {0})).error.summary.max, 0.0);
    EXPECT_GT(score(floats(1, 1, 1, {1}), floats(1, 1, 1, {0})), 0.5);
}

TEST(Flip, TakesWhatADisplayCannotShowAtItsEnds) {
    const auto same = [](float a, float b) {
        return score(floats(2, 1, 1, {a, 0.5f}), floats(2, 1, 1, {b, 0.5f}));
    };
    EXPECT_EQ(same(-3.0f, 0.0f), 0.0);
    EXPECT_TRUE(std::isfinite(same(3e38f, 1.0f)));
    EXPECT_TRUE(std::isfinite(same(1.0f, 3e38f)));
    // LDR-FLIP of integers against floats would not see light above white.
    EXPECT_TRUE(flip(codes(1, 1, 1, {255}), floats(1, 1, 1, {1})).exposures);
    EXPECT_FALSE(flip(codes(1, 1, 1, {255}), codes(1, 1, 3, {255, 255, 255})).exposures);
}

TEST(Flip, RefusesWhatIsNoPicture) {
    const auto error = [](const Image& x, const Image& y) {
        return computeFlip(x, y, JobContext()).error();
    };
    const Image a = floats(1, 1, 1, {0});
    const Error sizes = error(floats(2, 1, 1, {0, 0}), a);
    EXPECT_EQ(sizes.kind, ErrorKind::Usage);
    EXPECT_NE(sizes.message.find("2 × 1 and 1 × 1"), std::string::npos) << sizes.message;
    EXPECT_EQ(error(Image(), Image()).kind, ErrorKind::Usage);
    EXPECT_EQ(error(floats(1, 1, 6, {}), floats(1, 1, 6, {})).kind, ErrorKind::Usage);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const Error broken = error(floats(1, 1, 3, {nan, 0, infinite}), a);
    EXPECT_EQ(broken.kind, ErrorKind::InputBroken);
    EXPECT_NE(broken.message.find("2 samples"), std::string::npos) << broken.message;
    EXPECT_EQ(error(a, floats(1, 1, 1, {-infinite})).kind, ErrorKind::InputBroken);
    JobControl control;
    control.cancel();
    EXPECT_EQ(computeFlip(a, a, control.context()).error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(computeFlipTerms(a, a, control.context()).error().kind, ErrorKind::Cancelled);
}
