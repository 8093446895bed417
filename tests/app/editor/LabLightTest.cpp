// The values and pixels behind the Light lab, and the jobs that make them.

#include "app/editor/panel/LabLight.h"
#include "app/editor/job/LatestJob.h"
#include "app/editor/job/UiTasks.h"
#include "core/image/ColorMap.h"
#include "core/light/CubeSampling.h"
#include "core/math/Shading.h"
#include "tests/core/light/EnvironmentSum.h"

#include <QTest>
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace patina::editor {
namespace {

constexpr float kPi = 3.14159265f;

template <class Radiance>
ImagePtr latLong(int width, int height, Radiance&& radiance) {
    auto image = std::make_shared<Image>(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 value = radiance(shading::directionFromLatLong(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)}));
            for (int c = 0; c < 3; ++c)
                image->f32()[static_cast<std::size_t>((y * width + x) * 3 + c)] = value[c];
        }
    return image;
}

LabLight makeLight(const ImagePtr& image, int levels = IblSettings().levels) {
    IblSettings settings = IblSettings::quick();
    settings.cubeSize = 32;
    settings.levels = levels;
    LabLight light;
    light.analysis = analyseLight(image, {});
    light.maps = std::make_shared<const IblMaps>(
        computeIbl(*light.analysis->environment, settings, {}).value());
    return light;
}

std::vector<LabView> directionalViews() {
    std::vector<LabView> views{{LabKind::Environment, 0},
                               {LabKind::Faces, 0},
                               {LabKind::Irradiance, 0},
                               {LabKind::IrradianceExact, 0}};
    for (int n = 1; n <= kMaxShOrder; ++n)
        views.push_back({LabKind::Harmonics, n});
    for (int level = 0; level < kLabLevels; ++level)
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
        light.rotationDeg = 33.0f;
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
        EXPECT_LT(LabLight::irradianceError(*light.maps), 1e-3);
    }
}

TEST(LabLight, RotatesAndBrightensWithTheEnvironment) {
    const auto radiance = [](const glm::vec3& d) {
        return glm::vec3(1.0f) + glm::vec3(0.9f * d.x, 0.5f * d.y, 0.8f * d.z);
    };
    LabLight light = makeLight(latLong(128, 64, radiance));
    LabLight turned = light;
    turned.rotationDeg = 90.0f; // what stood at +X stands at -Z, seen from above
    turned.scale = 4.0f;
    for (const LabView& view : directionalViews()) {
        const glm::vec3 before = light.value(view, {1, 0, 0}).value();
        const glm::vec3 after = turned.value(view, {0, 0, -1}).value();
        EXPECT_LT(glm::distance(4.0f * before, after), 2e-2f)
            << static_cast<int>(view.kind) << " " << view.index;
        if (view != LabView{LabKind::Harmonics, 1}) {
            EXPECT_GT(before.x, before.z + 0.2f) << static_cast<int>(view.kind);
        }
    }
    // A linear function: two bands hold it, and irradiance is pi + 2pi/3 of its slope.
    const glm::vec3 d = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    EXPECT_LT(glm::distance(light.value({LabKind::Harmonics, 2}, d).value(), radiance(d)), 1e-3f);
    const glm::vec3 irradiance =
        kPi * glm::vec3(1.0f) + 2.0f / 3.0f * kPi * glm::vec3(0.9f * d.x, 0.5f * d.y, 0.8f * d.z);
    EXPECT_LT(glm::distance(light.value({LabKind::Irradiance, 0}, d).value(), irradiance), 2e-3f);
    EXPECT_LT(glm::distance(light.value({LabKind::IrradianceExact, 0}, d).value(), irradiance),
              3e-2f);
}

TEST(LabLight, PicturesShowTheValuesOfTheirDirections) {
    LabLight light = makeLight(latLong(
        256, 128, [](const glm::vec3& d) { return 0.5f + 0.4f * glm::vec3(d.x, d.y, d.z); }));
    light.rotationDeg = -40.0f;
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

TEST(LabLight, DraftsShowTheSameRoughness) {
    const ImagePtr image =
        latLong(64, 32, [](const glm::vec3& d) { return glm::vec3(d.x > 0.5f ? 4.0f : 0.1f); });
    const LabLight draft = makeLight(image, 5);
    const glm::vec3 d = glm::normalize(glm::vec3(0.7f, 0.4f, 0.2f));
    // Both mirrors, and both wholly rough; in between a mix of two levels, whichever they are.
    EXPECT_EQ(draft.value({LabKind::Prefiltered, 0}, d).value(),
              sampleCube(draft.maps->prefiltered.front(), d));
    EXPECT_LT(glm::distance(draft.value({LabKind::Prefiltered, 6}, d).value(),
                            sampleCube(draft.maps->prefiltered.back(), d)),
              1e-5f);
    const float level = shading::prefilteredLevel(0.5f, 5, 32.0f);
    const auto fine = static_cast<std::size_t>(level);
    EXPECT_LT(glm::distance(draft.value({LabKind::Prefiltered, 3}, d).value(),
                            glm::mix(sampleCube(draft.maps->prefiltered[fine], d),
                                     sampleCube(draft.maps->prefiltered[fine + 1], d),
                                     level - static_cast<float>(fine))),
              1e-5f);
    // What a draft lacks are levels, not light: both are close to the exact sum.
    const float exact =
        reference::EnvironmentSum(draft.maps->prefiltered.front()).at(d, std::vector{0.5f})[0].x;
    const LabLight full = makeLight(image);
    EXPECT_NEAR(full.value({LabKind::Prefiltered, 3}, d)->x / exact, 1.0f, 0.01f);
    EXPECT_NEAR(draft.value({LabKind::Prefiltered, 3}, d)->x / exact, 1.0f, 0.03f);
}

TEST(LabLight, WhatIsNoLightIsReplacedAndCounted) {
    auto image =
        std::make_shared<Image>(*latLong(16, 8, [](const glm::vec3&) { return glm::vec3(1.0f); }));
    image->f32()[5] = std::numeric_limits<float>::quiet_NaN();
    image->f32()[60] = -3.0f;
    image->f32()[90] = std::numeric_limits<float>::infinity();
    const LabAnalysisPtr analysis = analyseLight(image, {});
    EXPECT_EQ(analysis->invalidSamples, 3u);
    EXPECT_TRUE(std::isfinite(analysis->bands.sums[7].rmse));
    for (const float value : analysis->environment->f32())
        EXPECT_TRUE(value >= 0.0f && std::isfinite(value));
    EXPECT_FALSE(std::isfinite(image->f32()[5])) << "the document's image stays as it is";
}

TEST(LabLight, NothingIsShownOfWhatIsNotThere) {
    const LabLight empty;
    const LabTone tone(View{}, {}, 0.0f);
    for (const LabView& view : directionalViews()) {
        EXPECT_FALSE(empty.value(view, {0, 1, 0}));
        EXPECT_TRUE(labPicture(empty, view, {8, 4}, tone, {}).isNull());
    }
    JobControl control;
    control.cancel();
    EXPECT_EQ(analyseLight(latLong(64, 32, [](const glm::vec3&) { return glm::vec3(1); }),
                           control.context()),
              nullptr);
}

TEST(LabTone, IsTheViewsOwnCurve) {
    View view;
    view.exposureEv = 1.0f;
    view.displayTransfer = DisplayTransfer::Gamma;
    view.displayGamma = 2.4f;
    for (const ToneMap map : {ToneMap::Clamp, ToneMap::Reinhard, ToneMap::PbrNeutral, ToneMap::Aces,
                              ToneMap::AgX, ToneMap::Exponential, ToneMap::ReinhardPhotographic}) {
        view.toneMap = map;
        const LabTone tone(view, {}, 0.5f);
        for (const float value : {0.0f, 0.004f, 0.18f, 0.7f, 20.0f}) {
            const float shown = displayedGrey(view, {}, value * std::exp2(1.5f));
            EXPECT_NEAR(qGreen(tone.pixel(glm::vec3(value))), 255.0f * shown, 1.01f)
                << static_cast<int>(map) << " " << value;
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

TEST(LabDfg, ReadsAsTheShaderDoesAndGrowsUpwards) {
    const LabDfg dfg = computeLabDfg(Distribution::GGX, Visibility::SmithCorrelated);
    const int size = dfg.table.width();
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {127, 5}, {64, 100}}) {
        const glm::vec3 value = dfg.value((static_cast<float>(at.x) + 0.5f) / 128.0f,
                                          (static_cast<float>(at.y) + 0.5f) / 128.0f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c], dfg.table.sample(at.x, at.y, c), 1e-5f);
            const auto channel = static_cast<std::size_t>(c);
            const glm::vec3 color =
                255.0f * mapColor(ColorMap::Sequential, value[c] / dfg.range[channel].y);
            const QColor shown = dfg.pictures[channel].pixelColor(at.x, size - 1 - at.y);
            EXPECT_NEAR(shown.red(), color.x, 1.0f);
            EXPECT_NEAR(shown.green(), color.y, 1.0f);
        }
    }
    const glm::dvec3 exact = integrateDfg(0.62f, 0.35f);
    const glm::vec3 looked = dfg.value(0.62f, 0.35f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(looked[c], exact[c], 2e-3) << c;
    EXPECT_EQ(dfg.value(-1.0f, 2.0f).x, dfg.table.sample(0, 127, 0)) << "held at the border";
}

// --- LatestJob -----------------------------------------------------------------------------------

TEST(LatestJob, KeepsTheNewestOfWhatIsAskedMeanwhile) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    std::atomic<bool> go = false;
    std::vector<int> applied;
    for (int i = 0; i < 5; ++i)
        job.request([&, i](const JobContext&) -> LatestJob::Apply {
            while (!go)
                QThread::msleep(1);
            return [&applied, i] { applied.push_back(i); };
        });
    EXPECT_TRUE(job.busy());
    go = true;
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    EXPECT_EQ(applied, (std::vector<int>{0, 4})) << "the first goes on, the last follows";
}

TEST(LatestJob, ACancelledOneAppliesNothingAndTheNextRuns) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    std::vector<int> applied;
    std::atomic<bool> begun = false, sawCancel = false;
    job.request([&](const JobContext& context) -> LatestJob::Apply {
        begun = true;
        while (!context.cancelled())
            QThread::msleep(1);
        sawCancel = true;
        return [&] { applied.push_back(1); };
    });
    ASSERT_TRUE(QTest::qWaitFor([&] { return begun.load(); }, 30'000));
    job.cancel();
    EXPECT_FALSE(job.busy());
    job.request(
        [&](const JobContext&) -> LatestJob::Apply { return [&] { applied.push_back(2); }; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    EXPECT_TRUE(sawCancel);
    EXPECT_EQ(applied, std::vector<int>{2});
}

TEST(LatestJob, AnExceptionEndsOneRequestOnly) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    bool applied = false;
    job.request([](const JobContext&) -> LatestJob::Apply { throw std::runtime_error("no"); });
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    job.request([&](const JobContext&) -> LatestJob::Apply { return [&] { applied = true; }; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return applied; }, 30'000));
}

} // namespace
} // namespace patina::editor
