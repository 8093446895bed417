// From linear pixels to display values on the GPU: exposure, adaptation, tone curves, dithering.
#include "core/document/DisplayedPicture.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/material/Material.h"
#include "render/pass/AdaptationPass.h"
#include "tests/render/RenderTest.h"
#include "tests/render/ToneMapFixture.h"

#include <cmath>
#include <limits>

namespace patina::render {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// --- Curves --------------------------------------------------------------------------------------

TEST_F(ToneMapFixture, EveryCurveShowsWhatTheCpuComputes) {
    std::vector<glm::vec4> pixels;
    for (int i = 0; i < 256; ++i)
        pixels.emplace_back(glm::vec3(std::exp2(static_cast<float>(i) / 8.0f - 16.0f)), 1.0f);
    setPicture(256, pixels);
    const std::vector<float> linear = targets().linear().readFloats(4); // as half floats hold them
    Luminance luminance;
    luminance.logAverage = luminance.adapted = 0.4f;
    luminance.darkest = 0.01f, luminance.brightest = 60.0f;
    setLuminance(luminance);
    for (int curve = 0; curve < static_cast<int>(ToneMap::OpenColorIo); ++curve)
        for (const DisplayTransfer transfer : {DisplayTransfer::Srgb, DisplayTransfer::Gamma})
            for (const bool automatic : {false, true}) {
                View view;
                view.toneMap = static_cast<ToneMap>(curve);
                view.displayTransfer = transfer;
                view.displayGamma = 1.8f;
                view.exposureMode = automatic ? ExposureMode::Automatic : ExposureMode::Fixed;
                view.exposureEv = 0.5f;
                view.reinhardAutoKey = automatic;
                view.reinhardKey = 0.3f;
                view.reinhardWhite = automatic ? 3.0f : 0.0f;
                view.exponentialK = 2.5f;
                const auto shown = toneMapped(view);
                for (std::size_t i = 0; i < pixels.size(); ++i) {
                    const float exposed = exposureScale(view, luminance) * linear[4 * i];
                    ASSERT_NEAR(shown[4 * i + 1], 255.0f * displayedGrey(view, luminance, exposed),
                                0.6f)
                        << "curve " << curve << ", transfer " << static_cast<int>(transfer)
                        << ", automatic " << automatic << ", radiance " << linear[4 * i];
                }
            }
}

// Color channels do not swap or leak on their way.
TEST_F(ToneMapFixture, ColorsAreThoseOfTheFormula) {
    setPicture(2, {glm::vec4(4.0f, 2.0f, 1.0f, 1.0f), glm::vec4(0.25f, 0.15f, 0.05f, 0.5f)});
    const auto shown = toneMapped(View());
    // PBR Neutral of (4, 2, 1), and of (0.5, 0.3, 0.1) at half coverage: straight alpha.
    for (int c = 0; c < 3; ++c) {
        const glm::vec3 bright(0.983255813953f, 0.639951387048f, 0.468299173595f);
        const glm::vec3 plain(0.46f, 0.26f, 0.06f);
        EXPECT_NEAR(shown[static_cast<std::size_t>(c)], 255.0f * shading::srgbEncode(bright[c]),
                    0.6f);
        EXPECT_NEAR(shown[static_cast<std::size_t>(4 + c)], 255.0f * shading::srgbEncode(plain[c]),
                    0.6f);
    }
    EXPECT_EQ(shown[3], 255);
    EXPECT_NEAR(shown[7], 127.5f, 0.6f);
}

TEST_F(ToneMapFixture, BrokenPixelsStayInTheirPlace) {
    setPicture(4, {glm::vec4(kNan, 0.5f, kInf, 1.0f), glm::vec4(-3.0f, kInf, 0.5f, 1.0f),
                   glm::vec4(65504.0f, 0.0f, 0.0f, 1.0f), glm::vec4(0.0f, 0.0f, 0.0f, 0.0f)});
    for (int curve = 0; curve < static_cast<int>(ToneMap::OpenColorIo); ++curve) {
        View view;
        view.toneMap = static_cast<ToneMap>(curve);
        const auto shown = toneMapped(view);
        EXPECT_GE(shown[2], 250) << "infinity is bright, curve " << curve;
        EXPECT_GE(shown[8], 250) << "curve " << curve;
        EXPECT_EQ(shown[15], 0) << "alpha, curve " << curve;
    }
}

// --- Luminance -----------------------------------------------------------------------------------

TEST_F(ToneMapFixture, LogAverageOfSixPixels) {
    setPicture(6, {glm::vec4(0.01f, 0.02f, 0.03f, 1.0f), glm::vec4(0.2f, 0.1f, 0.05f, 1.0f),
                   glm::vec4(1.0f), glm::vec4(4.0f, 8.0f, 2.0f, 1.0f),
                   glm::vec4(0.0f, 0.0f, 0.0f, 1.0f), glm::vec4(50.0f, 40.0f, 30.0f, 1.0f)});
    const Luminance measured = lookAt(kInf);
    EXPECT_NEAR(measured.logAverage, 0.198528670882f, 5e-5f); // pixels are rounded to half floats
    EXPECT_EQ(measured.adapted, measured.logAverage);
    EXPECT_FALSE(measured.adapting());
    EXPECT_NEAR(measured.darkest, 1e-4f, 1e-8f);
    EXPECT_NEAR(measured.brightest, 41.4041f, 1e-2f);
}

// Pixels count by their alpha; nothing is no pixel at all; broken ones do not spread.
TEST_F(ToneMapFixture, LogAverageWeighsByAlpha) {
    const float dark = 0.25f, bright = 4.0f;
    setPicture(3, {glm::vec4(glm::vec3(dark), 1.0f),
                   glm::vec4(glm::vec3(0.5f * bright), 0.5f), // premultiplied
                   glm::vec4(0.0f)});
    EXPECT_NEAR(std::log2(lookAt(kInf).logAverage), (1.0f * -2.0f + 0.5f * 2.0f) / 1.5f, 1e-3f);
    EXPECT_NEAR(lookAt(kInf).darkest, dark, 1e-3f);
    setPicture(2, {glm::vec4(kNan, kNan, kNan, 1.0f), glm::vec4(kInf, kInf, kInf, 1.0f)});
    EXPECT_NEAR(std::log2(lookAt(kInf).logAverage), 0.5f * (std::log2(1e-4f) + std::log2(1e9f)),
                1e-3f);
}

// More tiles than one, none of them full, and the sum is the same bits each time.
TEST_F(ToneMapFixture, LogAverageOfManyTiles) {
    constexpr int kWidth = 333, kHeight = 131;
    std::vector<glm::vec4> pixels;
    double sum = 0.0;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const int ev = i * 7 % 13 - 6;
        pixels.emplace_back(glm::vec3(std::exp2(static_cast<float>(ev))), 1.0f);
        sum += std::log2(1e-4 + std::exp2(static_cast<double>(ev)));
    }
    setPicture(kWidth, pixels);
    const Luminance first = lookAt(kInf);
    EXPECT_NEAR(std::log2(first.logAverage), sum / (kWidth * kHeight), 1e-5);
    EXPECT_NEAR(first.brightest, 64.0f, 1e-3f);
    EXPECT_EQ(lookAt(kInf), first);
}

// --- Adaptation ----------------------------------------------------------------------------------

TEST_F(ToneMapFixture, TheEyeFollowsAtItsOwnPace) {
    const auto grey = [&](float L) { setPicture(1, {glm::vec4(glm::vec3(L), 1.0f)}); };
    grey(1.0f);
    EXPECT_NEAR(lookAt(0.0f).adapted, 1.0001f, 1e-5f) << "the first look is used to what it sees";
    grey(10.0f);
    Luminance seen = lookAt(0.0f);
    EXPECT_NEAR(seen.logAverage, 10.0001f, 1e-4f);
    EXPECT_NEAR(seen.adapted, 1.0001f, 1e-5f) << "no time has passed";
    EXPECT_TRUE(seen.adapting());
    EXPECT_NEAR(lookAt(1.0f / 60.0f).adapted, 1.0001f + 0.02f * 9.0f, 1e-5f);
    for (int i = 1; i < 60; ++i)
        seen = lookAt(1.0f / 60.0f);
    EXPECT_NEAR(seen.adapted, 7.3221217f, 2e-4f); // 1 → 10 in one second, plus delta

    // The same second in two unequal frames.
    grey(1.0f);
    EXPECT_EQ(lookAt(kInf).adapted, lookAt(kInf).logAverage);
    grey(10.0f);
    lookAt(0.3f);
    EXPECT_NEAR(lookAt(0.7f).adapted, 7.3221217f, 2e-5f);

    // It arrives and rests.
    int frames = 0;
    while (lookAt(0.1f).adapting())
        ASSERT_LT(++frames, 200);
    EXPECT_GT(frames, 20);
    // A picture without a pixel changes nothing.
    setPicture(1, {glm::vec4(0.0f)});
    EXPECT_NEAR(lookAt(1.0f).adapted, 10.0001f, 1e-4f);
}

TEST_F(ToneMapFixture, ResultsArriveWithoutWaitingAndInOrder) {
    EXPECT_FALSE(adaptation().poll().has_value()) << "nothing was measured";
    for (int i = 1; i <= 5; ++i) { // more than fit: nobody asks meanwhile
        setPicture(1, {glm::vec4(glm::vec3(static_cast<float>(i)), 1.0f)});
        ASSERT_TRUE(adaptation().measure(targets()).ok());
        ASSERT_TRUE(adaptation().adapt(kInf, ExposureMeter::Surfaces).ok());
    }
    EXPECT_TRUE(adaptation().pending());
    const auto last = adaptation().read();
    ASSERT_TRUE(last.has_value());
    EXPECT_NEAR(last->logAverage, 5.0001f, 1e-4f);
    EXPECT_FALSE(adaptation().pending());
    EXPECT_EQ(adaptation().poll(), last) << "the newest stays known";
}

// --- Dithering -----------------------------------------------------------------------------------

TEST_F(ToneMapFixture, DitheringKeepsTheMeanAndWhatLiesOnAStep) {
    constexpr int kSide = 64;
    View view;
    view.toneMap = ToneMap::Clamp;
    view.displayTransfer = DisplayTransfer::Gamma;
    view.displayGamma = 1.0f;
    for (const float code : {100.25f, 100.5f, 100.9f}) {
        setPicture(kSide, std::vector<glm::vec4>(kSide * kSide,
                                                 glm::vec4(glm::vec3(code / 255.0f), 1.0f)));
        const float stored = 255.0f * targets().linear().readFloats(4)[0];
        const auto plain = toneMapped(view, false), dithered = toneMapped(view, true);
        double sum = 0.0;
        for (std::size_t i = 0; i < plain.size(); i += 4) {
            EXPECT_EQ(plain[i], plain[0]) << "no noise unless asked for";
            EXPECT_TRUE(dithered[i] == 100 || dithered[i] == 101);
            EXPECT_EQ(dithered[i], dithered[i + 2]) << "greys stay grey";
            sum += dithered[i];
        }
        EXPECT_NEAR(sum / (kSide * kSide), stored, 0.03) << code;
        EXPECT_EQ(toneMapped(view, true), dithered) << "the same noise each time";
    }
    for (const float exact : {0.0f, 1.0f}) {
        setPicture(kSide, std::vector<glm::vec4>(kSide * kSide, glm::vec4(glm::vec3(exact), 1.0f)));
        EXPECT_EQ(toneMapped(view, true), toneMapped(view, false)) << exact;
    }
}

// --- In whole frames -----------------------------------------------------------------------------

class ExposureOfFrames : public RenderTest {
  protected:
    // Nothing but background of this radiance.
    static Document background(float radiance) {
        Document document = makeScene(makeSphere(8));
        document.meshes[0].visible = false;
        document.view.background = BackgroundMode::Color;
        document.view.backgroundColor = glm::vec3(radiance);
        document.view.exposureMode = ExposureMode::Automatic;
        document.view.toneMap = ToneMap::Clamp;
        return document;
    }
    float shownLinear() { return shading::srgbDecode(centerPixel(renderer().readDisplayed()).x); }
};

TEST_F(ExposureOfFrames, AutomaticExposureShowsTheAverageAsMiddleGrey) {
    for (const float radiance : {0.02f, 0.5f, 1.0f}) {
        Document document = background(radiance);
        draw(document);
        EXPECT_NEAR(shownLinear(), 0.18f, 0.003f) << radiance;
        document.view.exposureEv = 1.0f; // corrects
        draw(document);
        EXPECT_NEAR(shownLinear(), 0.36f, 0.005f) << radiance;
        document.view.toneMap = ToneMap::ReinhardPhotographic;
        document.view.exposureEv = 0.0f;
        document.view.reinhardKey = 0.5f;
        draw(document);
        EXPECT_NEAR(shownLinear(), 0.5f / 1.5f, 0.005f) << radiance;
        EXPECT_NEAR(renderer().readLuminance()->logAverage, radiance, 1e-3f);
    }
}

// A bright model in a dark room must not burn out, nor one in front of a white wall go black.
TEST_F(ExposureOfFrames, AutomaticExposureMetersTheModelAndNotTheBackground) {
    constexpr float kRadiance = 2.0f;
    for (const int samples : {1, 4})
        for (const float behind : {0.0f, 0.18f, 20.0f}) {
            Document document = background(behind);
            document.meshes[0].visible = true;
            document.materials[0].baseColor = glm::vec3(0.0f);
            document.materials[0].emissive = glm::vec3(kRadiance);
            document.environment().enabled = false;
            FrameSettings frame;
            frame.samples = samples;
            draw(document, 64, frame);
            // Pixels of the outline hold a little of both.
            EXPECT_NEAR(std::log2(renderer().readLuminance()->logAverage / kRadiance), 0.0f, 0.3f)
                << behind << ' ' << samples;
            EXPECT_NEAR(shownLinear(), 0.18f, 0.04f) << behind << ' ' << samples;
        }
}

// As a camera does: black around a small lamp lets it burn out.
TEST_F(ExposureOfFrames, TheWholeFrameIsMeteredOnRequest) {
    constexpr float kRadiance = 2.0f, kBehind = 0.5f;
    Document document = background(kBehind);
    document.meshes[0].visible = true;
    document.materials[0].baseColor = glm::vec3(0.0f);
    document.materials[0].emissive = glm::vec3(kRadiance);
    document.environment().enabled = false;
    FrameSettings frame;
    frame.samples = 4;
    draw(document, 64, frame);
    const float surfaces = renderer().readLuminance()->logAverage;
    EXPECT_NEAR(std::log2(surfaces / kRadiance), 0.0f, 0.3f);
    document.view.exposureMeter = ExposureMeter::Frame;
    draw(document, 64, frame);
    const float all = renderer().readLuminance()->logAverage;
    EXPECT_NEAR(std::log2(all / luminanceOf(renderer().readLinear()).logAverage), 0.0f, 0.01f);
    EXPECT_LT(all, 0.8f * surfaces);
    EXPECT_GT(all, kBehind);
    document.view.exposureMeter = ExposureMeter::Surfaces;
    draw(document, 64, frame);
    EXPECT_EQ(renderer().readLuminance()->logAverage, surfaces);
}

TEST_F(ExposureOfFrames, FixedExposureMeasuresOnlyWhenAsked) {
    Document document = background(0.5f);
    document.view.exposureMode = ExposureMode::Fixed;
    draw(document);
    EXPECT_FALSE(renderer().readLuminance().has_value());
    FrameSettings frame;
    frame.measureLuminance = true;
    draw(document, 64, frame);
    ASSERT_TRUE(renderer().readLuminance().has_value());
    EXPECT_NEAR(renderer().readLuminance()->logAverage, 0.5001f, 1e-3f);
    EXPECT_NEAR(shownLinear(), 0.5f, 0.005f) << "fixed all the same";
}

TEST_F(ExposureOfFrames, AdaptationNeedsNoNewScene) {
    const Document dark = background(0.1f), bright = background(0.8f);
    draw(dark);
    FrameSettings frame;
    frame.width = frame.height = 64;
    frame.camera = bright.view.camera;
    frame.adaptSeconds = 0.0f;
    frame.reuseScene = true; // without effect: the document changed
    sceneRenderer().setDocument(bright);
    ASSERT_TRUE(renderer().render(frame, 0).ok());
    EXPECT_NEAR(shownLinear(), 1.0f, 1e-3f) << "dazzled: 0.8 × 0.18 / 0.1";
    frame.adaptSeconds = 0.5f;
    float before = 2.0f;
    for (int i = 1; i <= 8; ++i) {
        ASSERT_TRUE(renderer().render(frame, 0).ok());
        const float adapted =
            0.8001f + (0.1001f - 0.8001f) * std::pow(0.98f, 30.0f * static_cast<float>(i));
        const float expected = std::min(0.8f * 0.18f / adapted, 1.0f);
        EXPECT_NEAR(shownLinear(), expected, 0.01f * expected) << i;
        EXPECT_LE(shownLinear(), before);
        before = shownLinear();
    }
    EXPECT_NEAR(centerPixel(renderer().readLinear()).x, 0.8f, 1e-3f) << "the scene is still there";
    // Another size is another picture.
    frame.width = 32;
    ASSERT_TRUE(renderer().render(frame, 0).ok());
    EXPECT_EQ(renderer().readLinear().width(), 32);
    EXPECT_NEAR(centerPixel(renderer().readLinear()).x, 0.8f, 1e-3f);
}

} // namespace
} // namespace patina::render
