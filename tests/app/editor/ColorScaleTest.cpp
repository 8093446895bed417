// The numbers of a colour scale: round, few, inside; and short.

#include "app/editor/widget/ColorScale.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

using ::testing::Pointwise;

MATCHER(Near, "") {
    return std::abs(std::get<0>(arg) - std::get<1>(arg)) < 1e-9 * (1 + std::abs(std::get<1>(arg)));
}

TEST(ScaleTicks, AreMultiplesOfOneTwoOrFiveInsideTheRange) {
    EXPECT_THAT(scaleTicks(0, 1, false, 6),
                Pointwise(Near(), std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1}));
    EXPECT_THAT(scaleTicks(-8, 8, false, 6), Pointwise(Near(), std::vector<double>{-5, 0, 5}));
    EXPECT_THAT(scaleTicks(1.7, 4.3, false, 6), Pointwise(Near(), std::vector<double>{2, 3, 4}));
    EXPECT_THAT(scaleTicks(0, 0.03, false, 4),
                Pointwise(Near(), std::vector<double>{0, 0.01, 0.02, 0.03}));
}

TEST(ScaleTicks, OfALogarithmicScaleArePowersOfTen) {
    EXPECT_THAT(scaleTicks(1e-3, 1e3, true, 7),
                Pointwise(Near(), std::vector<double>{1e-3, 1e-2, 0.1, 1, 10, 100, 1000}));
    EXPECT_THAT(scaleTicks(1e-3, 1e3, true, 4),
                Pointwise(Near(), std::vector<double>{1e-3, 0.1, 10, 1000}));
    EXPECT_THAT(scaleTicks(0.7, 400, true, 6), Pointwise(Near(), std::vector<double>{1, 10, 100}));
    EXPECT_THAT(scaleTicks(72, 708, true, 6), Pointwise(Near(), std::vector<double>{200, 400, 600}))
        << "less than two powers";
}

TEST(ScaleTicks, AreNeverMoreThanAskedFor) {
    for (const double span : {1e-6, 0.37, 1.0, 2.5, 7.0, 99.0, 12345.0})
        for (const double min : {-3.3 * span, 0.0, 0.77 * span})
            for (const int most : {2, 4, 6}) {
                const auto ticks = scaleTicks(min, min + span, false, most);
                EXPECT_LE(ticks.size(), static_cast<std::size_t>(most)) << min << " " << span;
                for (const double tick : ticks) {
                    EXPECT_GE(tick, min - 1e-5 * span);
                    EXPECT_LE(tick, min + span * (1 + 1e-5));
                }
            }
}

TEST(TickText, IsShortAndExactForRoundNumbers) {
    const auto text = [](double value) { return tickText(value).toStdString(); };
    EXPECT_EQ(text(0), "0");
    EXPECT_EQ(text(-1e-15), "0");
    EXPECT_EQ(text(0.25), "0.25");
    EXPECT_EQ(text(-5), "-5");
    EXPECT_EQ(text(1000), "1000");
    EXPECT_EQ(text(0.001), "0.001");
    EXPECT_EQ(text(1e4), "10⁴");
    EXPECT_EQ(text(-1e5), "-10⁵");
    EXPECT_EQ(text(2e-6), "2·10⁻⁶");
    EXPECT_EQ(text(2.5e12), "2.5·10¹²");
}

} // namespace
} // namespace patina::editor
