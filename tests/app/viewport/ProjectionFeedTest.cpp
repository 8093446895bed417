// Coefficients of both pictures of a cross-fade reach the renderer before there is a picture of
// both.
#include "app/editor/viewport/ProjectionFeed.h"
#include "app/editor/job/UiTasks.h"
#include "core/math/SphericalHarmonics.h"
#include "render/gl/Context.h"
#include "tests/support/SecondEnvironment.h"

#include <QSignalSpy>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace patina::editor {
namespace {

ImagePtr smallSky(float brightness) {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = brightness;
    return std::make_shared<const Image>(std::move(image));
}

struct ProjectionFeedTest : ::testing::Test {
    void SetUp() override {
        auto made = gl::Context::createHeadless();
        ASSERT_TRUE(made.ok());
        context = std::move(*made);
        auto created = render::SceneRenderer::create(*context);
        ASSERT_TRUE(created.ok());
        renderer = std::move(*created);
        test::addSecond(document, "second", smallSky(3.0f));
        document.environment().image = smallSky(1.0f);
    }
    void upload() {
        renderer->setDocument(document);
        feed.upload(*renderer, document);
    }
    // Of light that is the same from everywhere.
    [[nodiscard]] float brightness() const {
        return renderer->transferLight(2)[0].y / std::sqrt(4.0f * std::numbers::pi_v<float>);
    }
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<render::SceneRenderer> renderer;
    Document document;
    TaskRunner runner{postToThisThread()};
    ProjectionFeed feed{runner};
    QSignalSpy changed{&feed, &ProjectionFeed::changed};
};

TEST_F(ProjectionFeedTest, KeepsLightLinearBetweenEnvironments) {
    Environment& e = document.environment();
    upload();
    EXPECT_FALSE(renderer->knowsProjection(e.image)) << "nothing fades: nothing is asked for";
    document.mix.fade = 0.5f;
    for (const int done : {1, 2}) {
        upload();
        ASSERT_TRUE(changed.wait(30'000));
        EXPECT_EQ(changed.count(), done) << "one after the other";
    }
    upload();
    EXPECT_TRUE(renderer->knowsProjection(e.image));
    EXPECT_TRUE(renderer->knowsProjection(document.secondEnvironment()->image));
    EXPECT_EQ(document.mix.blended, nullptr) << "no picture of both was needed";
    for (const float fade : {0.25f, 0.5f, 0.9f}) {
        document.mix.fade = fade;
        upload();
        EXPECT_NEAR(brightness(), (1.0f - fade) * 1.0f + fade * 3.0f, 1e-4f) << fade;
    }
    EXPECT_EQ(changed.count(), 2) << "a drag of the fader asks for nothing";
}

TEST_F(ProjectionFeedTest, FollowsAPictureThatIsReplaced) {
    Environment& e = document.environment();
    document.mix.fade = 0.5f;
    upload();
    e.image = smallSky(2.0f); // while the first one is under way
    for (int i = 0; i < 4 && !(renderer->knowsProjection(e.image) &&
                               renderer->knowsProjection(document.secondEnvironment()->image));
         ++i) {
        upload();
        changed.wait(5'000);
        upload();
    }
    EXPECT_NEAR(brightness(), 2.5f, 1e-4f);
}

} // namespace
} // namespace patina::editor
