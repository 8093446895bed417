// The response is the camera's, whatever camera it is and whatever is in the way.
#include "tests/core/bracket/Photos.h"

#include <random>

namespace patina {
namespace {

using test::Camera;

// By bisection: the exposure that gives the code.
double exposureOfCode(const Camera& camera, double code) {
    double low = 1e-9, high = 64.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = std::sqrt(low * high);
        (camera(middle) * 255.0 < code ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

// Largest relative error of the curve's exposures in its middle.
double curveError(const LogResponse& curve, const Camera& camera) {
    const double mid = exposureOfCode(camera, kMidCode);
    double worst = 0.0;
    for (int code = 32; code <= 224; ++code) {
        const double truth = exposureOfCode(camera, code) / mid;
        worst = std::max(worst,
                         std::abs(std::exp(curve[static_cast<std::size_t>(code)]) / truth - 1.0));
    }
    return worst;
}

class Response : public test::BracketPhotos {};

TEST_F(Response, IsTheCamerasWithinTwoPercent) {
    for (const Camera& camera : {Camera(test::gammaCamera), Camera(test::filmCamera)})
        for (const OIIO::TypeDesc type : {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16}) {
            const Bracket bracket = make(writeAll(test::fiveShots("tif"), camera, type));
            ASSERT_EQ(bracket.report.curves.size(), 3u);
            for (const LogResponse& curve : bracket.report.curves) {
                EXPECT_LT(curveError(curve, camera), 0.02);
                EXPECT_EQ(curve[kMidCode], 0.0);
                EXPECT_TRUE(std::is_sorted(curve.begin(), curve.end()));
            }
        }
}

TEST_F(Response, OfAFilmIsNotSrgbs) {
    const Bracket bracket = make(writeAll(test::fiveShots("tif"), test::filmCamera));
    EXPECT_EQ(bracket.report.response, ResponseKind::Recovered);
    EXPECT_GT(bracket.report.srgbDifference, 0.1);
}

TEST_F(Response, OfSrgbPicturesIsCalledSo) {
    const Bracket bracket = make(writeAll(test::fiveShots("tif"), test::srgbCamera));
    EXPECT_EQ(bracket.report.response, ResponseKind::Srgb);
    EXPECT_LT(bracket.report.srgbDifference, 0.02);
}

TEST_F(Response, SurvivesJpegAndTwoPhotos) {
    std::vector<test::Shot> shots = test::fiveShots("jpg");
    shots = {shots[1], shots[2]};
    const Bracket bracket = make(writeAll(shots, test::filmCamera));
    for (const LogResponse& curve : bracket.report.curves)
        EXPECT_LT(curveError(curve, test::filmCamera), 0.05);
}

// Every fifth place has moved in one photo, and all codes are noisy.
TEST(ResponseCurve, IsRobust) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::uniform_real_distribution<double> stops(-6.0, 6.0);
    std::vector<ResponseSample> samples;
    for (int i = 0; i < 2000; ++i) {
        const double radiance = std::exp2(stops(random));
        ResponseSample sample;
        for (int j = 0; j < 5; ++j) {
            const double log2Exposure = 2.0 * j - 4.0;
            const double seen = i % 5 == 0 && j == 2 ? std::exp2(stops(random)) : radiance;
            const double code =
                255.0 * test::filmCamera(seen * std::exp2(log2Exposure)) + noise(random);
            if (code > 0.5 && code < 254.5)
                sample.seen.push_back({static_cast<float>(std::round(code)),
                                       static_cast<float>(log2Exposure * std::log(2.0))});
        }
        if (sample.seen.size() > 1)
            samples.push_back(std::move(sample));
    }
    const RecoveredResponse response = recoverResponse(samples);
    EXPECT_LT(curveError(response.curve, test::filmCamera), 0.05);
    EXPECT_GT(response.noiseCodes, 0.5);
    EXPECT_LT(response.noiseCodes, 1.5);
}

TEST(ResponseCurve, OfSrgbIsItsInverse) {
    const LogResponse curve = srgbResponse();
    EXPECT_LT(curveError(curve, test::srgbCamera), 1e-5);
    EXPECT_NEAR(logResponseAt(curve, 100.5), 0.5 * (curve[100] + curve[101]), 1e-12);
    EXPECT_EQ(hatWeight(0.0f), 0.0f);
    EXPECT_EQ(hatWeight(255.0f), 0.0f);
    EXPECT_EQ(hatWeight(127.5f), 1.0f);
}

} // namespace
} // namespace patina
