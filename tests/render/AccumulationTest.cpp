#include "core/material/Material.h"
#include "render/scene/EnvironmentLight.h"
#include "tests/render/RenderTest.h"

#include <cmath>

using namespace patina;
using namespace patina::render;

namespace {

constexpr int kSide = 48;

// A glowing sphere before black: every pixel is the share of it that the sphere covers.
Document glowingSphere() {
    Document document = makeScene(makeSphere());
    document.materials[0].emissive = glm::vec3(1.0f);
    return document;
}

class AccumulationTest : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        sceneRenderer().setIbl(uniformIbl(glm::vec3(0.0f)));
    }
    Image drawOnce(const Document& document, int size, bool accumulate, bool reuse = false) {
        FrameSettings frame;
        frame.width = frame.height = size;
        frame.samples = 1;
        frame.camera = document.view.camera;
        frame.accumulate = accumulate;
        frame.reuseScene = reuse;
        EXPECT_TRUE(renderer().render(frame, 0).ok());
        return renderer().readLinear();
    }
};

// RMS of what is wrong, against a picture of several pixels for each.
double coverageError(const Image& picture, const Image& fine) {
    const int share = fine.width() / picture.width();
    double sum = 0.0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            double covered = 0.0;
            for (int j = 0; j < share; ++j)
                for (int i = 0; i < share; ++i)
                    covered += static_cast<double>(pixel(fine, x * share + i, y * share + j).r);
            const double error =
                static_cast<double>(pixel(picture, x, y).r) - covered / (share * share);
            sum += error * error;
        }
    return std::sqrt(sum / (picture.width() * picture.height()));
}

TEST_F(AccumulationTest, FramesAddUpToTheShareOfAPixelThatIsCovered) {
    const Document document = glowingSphere();
    sceneRenderer().setDocument(document);
    const Image fine = drawOnce(document, 16 * kSide, false);
    const Image single = drawOnce(document, kSide, false);
    EXPECT_EQ(renderer().accumulatedFrames(), 0);
    Image mean = drawOnce(document, kSide, true);
    EXPECT_EQ(mean, single) << "the first frame is the ordinary one";
    EXPECT_EQ(renderer().accumulatedFrames(), 1);
    for (int i = 2; i <= ViewRenderer::kSteadyFrames; ++i) {
        mean = drawOnce(document, kSide, true);
        EXPECT_EQ(renderer().accumulatedFrames(), i);
    }
    EXPECT_LT(coverageError(mean, fine), 0.45 * coverageError(single, fine));
    EXPECT_FLOAT_EQ(centerPixel(mean).r, centerPixel(single).r);
    EXPECT_EQ(drawOnce(document, kSide, true), mean) << "it is complete";
    EXPECT_EQ(drawOnce(document, kSide, true, true), mean);
}

TEST_F(AccumulationTest, WhatChangesBeginsAnew) {
    Document document = glowingSphere();
    sceneRenderer().setDocument(document);
    for (int i = 0; i < 3; ++i)
        (void)drawOnce(document, kSide, true);
    ASSERT_EQ(renderer().accumulatedFrames(), 3);
    document.materials[0].emissive = glm::vec3(0.25f);
    sceneRenderer().setDocument(document);
    const Image changed = drawOnce(document, kSide, true);
    EXPECT_EQ(renderer().accumulatedFrames(), 1);
    EXPECT_FLOAT_EQ(centerPixel(changed).r, 0.25f) << "nothing is left of what was";
    (void)drawOnce(document, kSide, true);
    EXPECT_EQ(renderer().accumulatedFrames(), 2);
    document.view.camera.yawDeg += 20.0f;
    (void)drawOnce(document, kSide, true);
    EXPECT_EQ(renderer().accumulatedFrames(), 1) << "the camera";
    (void)drawOnce(document, kSide / 2, true);
    EXPECT_EQ(renderer().accumulatedFrames(), 1) << "the size";
}

TEST_F(AccumulationTest, BothSidesOfASplitHaveTheirOwn) {
    const Document document = glowingSphere();
    sceneRenderer().setDocument(document);
    FrameSettings frame;
    frame.width = frame.height = kSide;
    frame.samples = 1;
    frame.camera = document.view.camera;
    const auto steady = [&](const ViewSettings& view) {
        frame.view = view;
        frame.accumulate = true;
        for (int i = 0; i < ViewRenderer::kSteadyFrames + 1; ++i)
            EXPECT_TRUE(renderer().render(frame, 0).ok());
        return renderer().readDisplayed();
    };
    ViewSettings alone, other, split;
    other.shown.kind = shading::kViewEmissive;
    split.split = ViewSplit();
    split.split->other.kind = shading::kViewEmissive;
    const Image left = steady(alone), right = steady(other), both = steady(split);
    for (const int y : {4, kSide / 2, kSide - 5})
        for (int x = 0; x < kSide; ++x)
            if (std::abs(x - kSide / 2) > 1) {
                EXPECT_EQ(pixel(both, x, y), pixel(x < kSide / 2 ? left : right, x, y))
                    << x << ", " << y;
            }
}

} // namespace
