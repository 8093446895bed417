// The certificate of the Cornell box, at settings that take little time.
#include "core/radiosity/certificate/Certificate.h"

#include "core/job/Parallel.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

// The reference itself as an estimator.
Estimator perfect(bool sampled) {
    Estimator estimator;
    if (!sampled)
        estimator.radiosity = {FactorMethod::Rays, Solver::GaussSeidel};
    for (const library::CornellPoint& point : library::cornellPoints()) {
        library::CornellValues& values = estimator.irradiance.emplace_back();
        for (std::size_t c = 0; c < values.size(); ++c)
            values[c] = point.irradiance(c);
        if (sampled)
            estimator.standardErrors.emplace_back().fill(1e-4);
    }
    return estimator;
}

} // namespace

TEST(Certificate, FindsTheValueThatIsOff) {
    for (const bool sampled : {false, true}) {
        Estimator estimator = perfect(sampled);
        const EstimatorSummary right = summarize(estimator);
        EXPECT_TRUE(right.holds());
        EXPECT_EQ(right.largest, 0.0);
        EXPECT_EQ(right.meanStandardError.has_value(), sampled);
        double& value = estimator.irradiance[13][4];
        const double error = sampled ? 4.2e-4 : -0.021 * value;
        value += error;
        const EstimatorSummary wrong = summarize(estimator);
        EXPECT_FALSE(wrong.holds());
        EXPECT_EQ(wrong.point, 13u);
        EXPECT_EQ(wrong.channel, 4u);
        EXPECT_NEAR(wrong.largestOfTolerance, 1.05, 0.01);
        EXPECT_NEAR(wrong.mean * 132.0, wrong.largest, 1e-12);
        value -= 0.1 * error;
        EXPECT_TRUE(summarize(estimator).holds());
    }
}

// Coarse elements: 10 % of the truth, but all of the machinery; the same on any number of threads.
TEST(Certificate, IsMadeByEveryEstimator) {
    CertificateSettings settings;
    settings.paths = 4096;
    settings.edge = 0.2;
    settings.gatherRays = 4096;
    settings.rays = 1024;
    settings.hemicube = 16;
    settings.paraboloid = 32;
    settings.analytic = 4;
    settings.lightSamples = 64;
    const auto certificate = makeCertificate(settings, {});
    ASSERT_TRUE(certificate) << certificate.error().text();
    ASSERT_EQ(certificate->estimators.size(), 13u);
    EXPECT_EQ(certificate->estimators[0].name(), "path tracer");
    EXPECT_EQ(certificate->estimators[4].name(), "hemicube, progressive");
    EXPECT_EQ(certificate->estimators[7].name(), "paraboloid, progressive");
    EXPECT_TRUE(summarize(certificate->estimators[0]).holds());
    EXPECT_LT(*summarize(certificate->estimators[0]).meanStandardError, 0.03);
    for (const Estimator& estimator : certificate->estimators) {
        ASSERT_EQ(estimator.irradiance.size(), 22u);
        // Single points lie close to edges, where these elements are too coarse.
        EXPECT_LT(summarize(estimator).mean, 0.06) << estimator.name();
    }

    // The same sums need no samples that are worth something.
    settings.paths = settings.gatherRays = 256;
    settings.edge = 0.4;
    settings.rays = 128;
    std::vector<Certificate> some;
    for (const int threads : {1, 3}) {
        const ThreadLimit limit(threads);
        const auto made = makeCertificate(settings, {});
        ASSERT_TRUE(made) << made.error().text();
        some.push_back(*made);
    }
    for (std::size_t i = 0; i < some[0].estimators.size(); ++i)
        EXPECT_EQ(some[0].estimators[i].irradiance, some[1].estimators[i].irradiance)
            << some[0].estimators[i].name();

    JobControl control;
    control.cancel();
    const auto cancelled = makeCertificate(settings, control.context());
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

} // namespace patina::test
