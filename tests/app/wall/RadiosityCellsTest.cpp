// Cells of the wall under radiosity: each solved for what it shows, not for the scene as it is.
// PATINA_SCREENSHOTS keeps pictures.
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "core/document/ViewChoices.h"
#include "tests/app/editor/UnderSky.h"
#include "tests/app/wall/WallFixture.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

class RadiosityCells : public WallWindow {
  protected:
    void SetUp() override {
        WallWindow::SetUp();
        // The sky shines in through the open front.
        controller().openScene(QStringLiteral("builtin:cornell-reference"));
        ASSERT_TRUE(settled(*session));
        controller().editStructure(QStringLiteral("Materials"), [](Document& document) {
            for (const char* name : {"Gold", "Night"}) {
                Material material;
                material.name = name;
                material.metallic = 0.0f;
                material.baseColor =
                    name[0] == 'G' ? glm::vec3(0.9f, 0.6f, 0.1f) : glm::vec3(0.02f);
                addMaterial(document, material);
            }
        });
        set("view.radiosityArea", 0.1f);
        set("view.radiosityRays", 64.0f);
        putUnderSky(controller());
        set("view.lighting", static_cast<int>(LightingMode::Radiosity));
        ASSERT_TRUE(isSettled());
    }
    void TearDown() override {
        set("view.lighting", static_cast<int>(LightingMode::Ibl));
        WallWindow::TearDown();
    }

    static void set(const char* name, const ParameterValue& value) {
        controller().setParameter(parameter(name), {Scope::View, 0}, value);
    }
    static std::size_t cellOf(const char* material) {
        EXPECT_EQ(wall().cells().size(), document().materials.size());
        const auto found = std::ranges::find(document().materials, material, &Material::name);
        return static_cast<std::size_t>(found - document().materials.begin());
    }
    static double difference(const QImage& a, const QImage& b) {
        EXPECT_EQ(a.size(), b.size());
        double sum = 0.0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                sum += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y)));
        return sum / (a.width() * a.height());
    }
    static void expectNoTexts() {
        for (std::size_t i = 0; i < wall().cells().size(); ++i)
            EXPECT_EQ(wall().text(i).toStdString(), std::string());
    }
};

TEST_F(RadiosityCells, ShowTheSceneThatTheyStandFor) {
    key(Qt::Key_F3);
    ASSERT_TRUE(wall().isOn());
    ASSERT_TRUE(isSettled());
    keepPicture("wall-radiosity.png");
    expectNoTexts();
    const std::size_t gold = cellOf("Gold"), night = cellOf("Night");
    const QImage ofGold = pictureOf(gold), ofNight = pictureOf(night);
    EXPECT_GT(difference(ofGold, ofNight), 8.0) << "a box of gold is brighter";
    // The scene itself is what the cell shows, and looks like it.
    wall().setCurrent(gold);
    wall().useInScene();
    ASSERT_TRUE(isSettled());
    expectNoTexts();
    EXPECT_LT(difference(pictureOf(gold), ofGold), 1.0);
    EXPECT_LT(difference(pictureOf(night), ofNight), 1.0) << "as before";
}

TEST_F(RadiosityCells, FollowTheScene) {
    key(Qt::Key_F3);
    ASSERT_TRUE(isSettled());
    const std::size_t gold = cellOf("Gold");
    const QImage before = pictureOf(gold);
    controller().setParameter(parameter("environment.exposureEv"), {Scope::Environment, 0}, -2.0f);
    ASSERT_TRUE(isSettled());
    EXPECT_GT(difference(pictureOf(gold), before), 10.0);
    expectNoTexts();
    controller().undoStack().undo();
    ASSERT_TRUE(isSettled());
    EXPECT_LT(difference(pictureOf(gold), before), 1.0);
}

TEST_F(RadiosityCells, LeaveTheScenesOwnLightBehind) {
    ASSERT_TRUE(eventually([] { return session->radiosity.upToDate(); }));
    const QImage scene = viewport().grabFramebuffer();
    keepPicture("scene-radiosity.png");
    key(Qt::Key_F3);
    ASSERT_TRUE(isSettled());
    key(Qt::Key_F3);
    ASSERT_FALSE(wall().isOn());
    ASSERT_TRUE(isSettled());
    keepPicture("scene-radiosity-after.png");
    EXPECT_LT(difference(viewport().grabFramebuffer(), scene), 0.5);
}

} // namespace
} // namespace patina::editor
