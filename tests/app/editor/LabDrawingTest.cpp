// The pixels of the Light lab.

#include "app/editor/panel/LabDrawing.h"
#include "core/document/ViewChoices.h"
#include "core/image/ColorMap.h"
#include "core/light/DfgLookup.h"
#include "core/math/Shading.h"
#include "tests/core/light/LatLongPicture.h"

#include <QColor>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace patina::editor {
namespace {

using test::latLong;

constexpr float kPi = 3.14159265f;

LabLight makeLight(const ImagePtr& image) {
    IblSettings settings = IblSettings::quick();
    settings.cubeSize = 32;
    settings.levels = IblSettings().levels;
    LabLight light;
    light.lookup.analysis = analyseEnvironment(image, {});
    light.lookup.maps = std::make_shared<const IblMaps>(
        computeIbl(*light.lookup.analysis->environment, settings, {}).value());
    light.reductions = reduceForPictures(*light.lookup.analysis, {});
    return light;
}

std::vector<LabView> directionalViews() {
    std::vector<LabView> views{{LabKind::Environment, 0},
                               {LabKind::Faces, 0},
                               {LabKind::Irradiance, 0},
                               {LabKind::IrradianceExact, 0}};
    for (int n = 1; n <= kMaxShOrder; ++n)
        views.push_back({LabKind::Harmonics, n});
    for (int level = 0; level < kRoughnessSteps; ++level)
        views.push_back({LabKind::Prefiltered, level});
    return views;
}

QSize sizeOf(LabView view) {
    return view.isCross() ? QSize(64, 48) : QSize(64, 32);
}

View clampedView() {
    View view;
    view.toneMap = ToneMap::Clamp;
    return view;
}

TEST(LabLight, AConstantEnvironmentIsConstantEverywhere) {
    const glm::vec3 radiance(0.5f, 0.25f, 0.125f);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 1}, {64, 32}}) {
        LabLight light =
            makeLight(latLong(size.x, size.y, [&](const glm::vec3&) { return radiance; }));
        light.lookup.orientation = 33.0f;
        const LabTone tone(clampedView(), {}, 0.0f);
        for (const LabView& view : directionalViews()) {
            const float factor = view.isIrradiance() ? kPi : 1.0f;
            for (const glm::vec3 d : {glm::vec3(0, 1, 0), {0, 0, -1}, {0.48f, -0.6f, 0.64f}})
                EXPECT_LT(glm::distance(light.value(view, d).value(), factor * radiance), 3e-4f)
                    << static_cast<int>(view.kind) << " " << view.index;
            const QImage picture = labPicture(light, view, sizeOf(view), tone, {});
            ASSERT_EQ(picture.size(), sizeOf(view));
            const QColor expected(tone.pixel(radiance));
            for (int x = 1; x < picture.width(); x += 7) {
                const QColor color = picture.pixelColor(x, picture.height() / 2);
                EXPECT_NEAR(color.red(), expected.red(), 1);
                EXPECT_NEAR(color.blue(), expected.blue(), 1);
            }
        }
    }
}

TEST(LabLight, PicturesShowTheValuesOfTheirDirections) {
    LabLight light = makeLight(latLong(
        256, 128, [](const glm::vec3& d) { return 0.5f + 0.4f * glm::vec3(d.x, d.y, d.z); }));
    light.lookup.orientation = -40.0f;
    const LabTone tone(clampedView(), {}, 0.0f);
    for (const LabView& view : directionalViews()) {
        const QSize size = sizeOf(view);
        const QImage picture = labPicture(light, view, size, tone, {});
        if (view.isCross()) {
            EXPECT_EQ(qAlpha(picture.pixel(2, 2)), 0) << "beside the cross";
            // The middle of -Z is the middle of the second row's second face.
            const glm::vec3 d(0.0625f, -0.0625f, -1.0f);
            EXPECT_NEAR(picture.pixelColor(24, 24).green(),
                        QColor(tone.pixel(light.value(view, d).value())).green(), 1);
            continue;
        }
        for (const QPoint at : {QPoint(5, 4), {40, 16}, {63, 31}, {20, 25}}) {
            const glm::vec3 d = shading::directionFromLatLong(
                {(static_cast<float>(at.x()) + 0.5f) / static_cast<float>(size.width()),
                 (static_cast<float>(at.y()) + 0.5f) / static_cast<float>(size.height())});
            const glm::vec3 value =
                light.value(view, d).value() / (view.isIrradiance() ? kPi : 1.0f);
            const QColor expected(tone.pixel(value)), shown = picture.pixelColor(at);
            EXPECT_NEAR(shown.red(), expected.red(), 3)
                << static_cast<int>(view.kind) << " " << view.index;
            EXPECT_NEAR(shown.blue(), expected.blue(), 3)
                << static_cast<int>(view.kind) << " " << view.index;
        }
    }
}

TEST(LabLight, NothingIsShownOfWhatIsNotThere) {
    const LabLight empty;
    const LabTone tone(View{}, {}, 0.0f);
    for (const LabView& view : directionalViews()) {
        EXPECT_FALSE(empty.value(view, {0, 1, 0}));
        EXPECT_TRUE(labPicture(empty, view, {8, 4}, tone, {}).isNull());
    }
    const EnvironmentAnalysisPtr analysis =
        analyseEnvironment(latLong(64, 32, [](const glm::vec3&) { return glm::vec3(1); }), {});
    JobControl control;
    control.cancel();
    EXPECT_EQ(reduceForPictures(*analysis, control.context()), nullptr);
}

TEST(LabTone, IsTheViewsOwnCurve) {
    View view;
    view.exposureEv = 1.0f;
    view.displayTransfer = DisplayTransfer::Gamma;
    view.displayGamma = 2.4f;
    for (int map = 0; map < static_cast<int>(ToneMap::OpenColorIo); ++map) {
        view.toneMap = static_cast<ToneMap>(map);
        const LabTone tone(view, {}, 0.5f);
        for (const float value : {0.0f, 0.004f, 0.18f, 0.7f, 20.0f}) {
            const float shown = displayedGrey(view, {}, value * std::exp2(1.5f));
            EXPECT_NEAR(qGreen(tone.pixel(glm::vec3(value))), 255.0f * shown, 1.01f)
                << map << " " << value;
        }
    }
    view.exposureMode = ExposureMode::Automatic;
    view.toneMap = ToneMap::Clamp;
    Luminance luminance;
    luminance.adapted = 0.9f; // a fifth of the light
    EXPECT_NEAR(qRed(LabTone(view, luminance, 0.0f).pixel(glm::vec3(1.0f))),
                255.0f * displayedGrey(view, luminance, 0.4f), 1.01f);
}

TEST(LabTone, MarksWhatIsBelowZeroAndSurvivesAnything) {
    const LabTone tone(clampedView(), {}, 0.0f);
    const QColor negative(tone.pixel(glm::vec3(-0.5f)));
    EXPECT_GT(negative.red(), 150);
    EXPECT_EQ(negative.green(), 0);
    EXPECT_GT(negative.blue(), 100);
    EXPECT_GT(qRed(tone.pixel({0.0f, -0.5f, 0.0f})), 150) << "one channel is enough";
    EXPECT_EQ(tone.pixel(glm::vec3(0.0f)), qRgb(0, 0, 0));
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(qGreen(tone.pixel({nan, nan, nan})), 0);
    EXPECT_EQ(tone.pixel(glm::vec3(infinity)), qRgb(255, 255, 255));
    View view;
    view.toneMap = ToneMap::OpenColorIo;
    View neutral;
    EXPECT_EQ(LabTone(view, {}, 0.0f).pixel(glm::vec3(0.3f)),
              LabTone(neutral, {}, 0.0f).pixel(glm::vec3(0.3f)));
}

TEST(LabDfg, ShowsTheTableAndGrowsUpwards) {
    const LabDfg dfg = computeLabDfg(Distribution::GGX, Visibility::SmithCorrelated);
    const int size = dfg.table.width();
    ASSERT_EQ(size, 128);
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {127, 5}, {64, 100}}) {
        const glm::vec3 value = lookUpDfg(dfg.table, (static_cast<float>(at.x) + 0.5f) / 128.0f,
                                          (static_cast<float>(at.y) + 0.5f) / 128.0f);
        for (int c = 0; c < 3; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            const glm::vec3 color =
                255.0f * mapColor(ColorMap::Sequential, value[c] / dfg.range[channel].y);
            const QColor shown = dfg.pictures[channel].pixelColor(at.x, size - 1 - at.y);
            EXPECT_NEAR(shown.red(), color.x, 1.0f);
            EXPECT_NEAR(shown.green(), color.y, 1.0f);
        }
    }
}

} // namespace
} // namespace patina::editor
