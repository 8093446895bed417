// Light of cells' environments in the background: pictures of what is generated or mixed, small
// light, then all of it, and nothing that nobody asks for any more.
#include "app/editor/wall/WallLights.h"
#include "app/editor/job/UiTasks.h"
#include "core/cells/Cell.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/mix/LightMix.h"
#include "tests/support/TemporaryFolder.h"

#include <QSignalSpy>
#include <QTest>
#include <cstring>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

ImagePtr sky(float brightness) {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = brightness;
    return std::make_shared<const Image>(std::move(image));
}

struct WallLightsTest : ::testing::Test {
    WallLightsTest() {
        document.environment().source = "first.hdr";
        document.environment().image = document.environment().fileImage = sky(1.0f);
    }
    template <class Condition>
    static bool eventually(Condition condition) {
        return QTest::qWaitFor(condition, 120'000);
    }
    bool idle() {
        return eventually([&] { return !lights.busy(); });
    }
    Document cellOf(const char* parameter, const ParameterValue& value) {
        Cell cell;
        const ParameterInfo* info = findParameter(parameter);
        cell.own.push_back({{info->scope, 0}, info, value});
        const Result<Document> shown = documentOf(document, cell);
        EXPECT_TRUE(shown.ok());
        return *shown;
    }

    test::TemporaryFolder folder;
    TaskRunner runner{postToThisThread()};
    PreparedLights prepared{folder.path()};
    WallLights lights{runner, prepared};
    Document document;
};

TEST_F(WallLightsTest, LightIsSmallAtFirstAndThenInFull) {
    const ImagePtr picture = sky(2.0f);
    EXPECT_EQ(lights.light(picture), nullptr);
    ASSERT_TRUE(eventually([&] { return lights.light(picture) != nullptr; }));
    EXPECT_EQ(lights.light(picture)->image, picture);
    ASSERT_TRUE(idle());
    const EnvironmentTexelsPtr full = lights.light(picture);
    EXPECT_EQ(full->side, IblSettings().cubeSize);
    EXPECT_EQ(lights.light(picture), full) << "it is kept";
    EXPECT_EQ(lights.light(nullptr), nullptr);
}

TEST_F(WallLightsTest, OthersAreLetGo) {
    const ImagePtr kept = sky(1.0f), dropped = sky(3.0f);
    (void)lights.light(kept);
    (void)lights.light(dropped);
    ASSERT_TRUE(idle());
    lights.sweep();
    const EnvironmentTexelsPtr light = lights.light(kept);
    EXPECT_NE(light, nullptr);
    lights.sweep();
    EXPECT_EQ(lights.light(kept), light);
    EXPECT_EQ(lights.light(dropped), nullptr) << "it was let go";
}

// The pictures are those that the command line draws its cells with.
TEST_F(WallLightsTest, GeneratedAndMixedPicturesAreThoseOfTheCell) {
    Document linked = cellOf("environment.rotationDeg", 30.0f);
    EXPECT_TRUE(lights.resolve(linked, document)) << "a number of the light";
    EXPECT_EQ(linked.environment().image, document.environment().image);

    const Document asked = cellOf("environment.kind", static_cast<int>(EnvironmentKind::Softboxes));
    Document shown = asked, expected = asked;
    EXPECT_FALSE(lights.resolve(shown, document));
    ASSERT_TRUE(eventually([&] {
        shown = asked;
        return lights.resolve(shown, document);
    }));
    resolveCell(expected, document);
    EXPECT_EQ(*shown.environment().image, *expected.environment().image);

    Environment second;
    second.source = "second.hdr";
    second.image = second.fileImage = sky(0.25f);
    fadeTo(document, addEnvironment(document, second));
    const Document half = cellOf("environment.fade", 0.75f);
    shown = expected = half;
    EXPECT_FALSE(lights.resolve(shown, document));
    ASSERT_TRUE(eventually([&] {
        shown = half;
        return lights.resolve(shown, document);
    }));
    resolveCell(expected, document);
    ASSERT_NE(shown.mix.blended, nullptr);
    EXPECT_EQ(*shown.mix.blended, *expected.mix.blended);
}

} // namespace
} // namespace patina::editor
