#include "core/compare/ErrorMap.h"

#include "Pictures.h"
#include "core/compare/Metrics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

using namespace patina;
using patina::test::codes;
using patina::test::floats;

namespace {

std::span<const float> valuesOf(const Result<ErrorMap>& map) {
    return std::as_const(map->values).f32();
}

} // namespace

TEST(ErrorMap, ASummarySaysWhatAMapHolds) {
    Image map(10, 10, 1, PixelType::F32, ColorEncoding::Data);
    // 1…100, each once, some of them negative, not in order.
    for (int i = 0; i < 100; ++i) {
        const int value = (i * 37 + 11) % 100 + 1;
        map.f32()[static_cast<std::size_t>(i)] = static_cast<float>(value % 3 ? value : -value);
    }
    const ErrorSummary summary = summarize(map);
    EXPECT_EQ(summary.max, 100.0);
    EXPECT_EQ(summary.median, 50.0);
    EXPECT_EQ(summary.percentile95, 95.0);
    EXPECT_EQ(summary.percentile99, 99.0);
    // 5050 less twice the multiples of three, 3 · 33 · 34 / 2.
    EXPECT_DOUBLE_EQ(summary.mean, (5050.0 - 2 * 1683) / 100);
    EXPECT_EQ(map.sample(summary.maxPosition.x, summary.maxPosition.y, 0), 100.0f);

    const ErrorSummary one = summarize(floats(1, 1, 1, {-0.25f}));
    EXPECT_EQ(one.mean, -0.25);
    EXPECT_EQ(one.max, 0.25);
    EXPECT_EQ(one.percentile99, 0.25);
    // Of several largest ones the first counts.
    EXPECT_EQ(summarize(floats(3, 1, 1, {0, 2, -2})).maxPosition, (PixelPosition{1, 0}));
}

TEST(ErrorMap, EachDifferenceIsItsDefinition) {
    const Image image = floats(2, 1, 3, {0.5f, 0.25f, 1.0f, 0.0f, 0.75f, 1.0f});
    const Image reference = floats(2, 1, 3, {0.0f, 1.0f, 1.0f, 0.0f, 0.5f, 1.0f});
    const JobContext job;
    const auto sign = differenceMap(image, reference, Difference::Signed, job);
    EXPECT_EQ(valuesOf(sign)[0], -0.75f); // of the channel that differs most
    EXPECT_EQ(valuesOf(sign)[1], 0.25f);
    EXPECT_EQ(sign->summary.mean, -0.25);
    EXPECT_EQ(sign->summary.max, 0.75);
    const auto absolute = differenceMap(image, reference, Difference::Absolute, job);
    EXPECT_EQ(valuesOf(absolute)[0], 0.75f);
    const auto relative = differenceMap(image, reference, Difference::Relative, job);
    EXPECT_FLOAT_EQ(valuesOf(relative)[0], 0.5f / 0.1f); // of the dark channel
    EXPECT_FLOAT_EQ(valuesOf(relative)[1], 0.25f / std::sqrt(0.26f));
}

TEST(ErrorMap, AgreesWithTheMetrics) {
    const Image image = floats(2, 2, 1, {0.1f, 0.5f, 2.0f, 0.3f});
    const Image reference = floats(2, 2, 1, {0.2f, 0.1f, 3.0f, 0.3f});
    const Result<ImageMetrics> metrics = compareImages(image, reference);
    const auto absolute = differenceMap(image, reference, Difference::Absolute, JobContext());
    EXPECT_EQ(absolute->summary.max, metrics->max);
    EXPECT_EQ(absolute->summary.maxPosition, metrics->maxPosition);
    const auto relative = differenceMap(image, reference, Difference::Relative, JobContext());
    double squares = 0;
    for (const float v : valuesOf(relative))
        squares += static_cast<double>(v) * static_cast<double>(v);
    EXPECT_NEAR(squares / 4, metrics->relMse, 1e-7);
    // Alpha is a channel of its own.
    EXPECT_EQ(differenceMap(codes(1, 1, 3, {9, 9, 9}), codes(1, 1, 4, {9, 9, 9, 0}),
                            Difference::Signed, JobContext())
                  ->summary.mean,
              1.0);
}

TEST(ErrorMap, RefusesWhatTheMetricsRefuse) {
    const Image a = floats(2, 1, 1, {0, 0});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto kind = [&](const Image& b) {
        return differenceMap(a, b, Difference::Absolute, JobContext()).error().kind;
    };
    EXPECT_EQ(kind(floats(1, 2, 1, {0, 0})), ErrorKind::Usage);
    EXPECT_EQ(kind(floats(2, 1, 1, {nan, 0})), ErrorKind::InputBroken);
    EXPECT_EQ(kind(floats(2, 1, 1, {std::numeric_limits<float>::infinity(), 0})),
              ErrorKind::InputBroken);
    JobControl control;
    control.cancel();
    EXPECT_EQ(differenceMap(a, a, Difference::Absolute, control.context()).error().kind,
              ErrorKind::Cancelled);
}
