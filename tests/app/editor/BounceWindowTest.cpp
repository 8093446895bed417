// A wall of the Cornell box recoloured in its window: the light that bounces off it follows.
#include "core/document/ViewChoices.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/UnderSky.h"

#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/EditSession.h"

#include <QDir>
#include <QDockWidget>
#include <QElapsedTimer>
#include <cstdio>

namespace patina::editor {
namespace {

struct BounceWindow : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(390, 300); // software OpenGL pays for each pixel
        controller().openScene(QStringLiteral("builtin:cornell-box"));
        ASSERT_TRUE(settled(*session));
        for (const Material& material : document().materials)
            if (material.baseColor.r > 2.0f * material.baseColor.g)
                red = {Scope::Material, material.id};
        ASSERT_NE(red.id, 0u);
        putUnderSky(*session);
        controller().setParameter(parameter("view.lighting"), {Scope::View, 0},
                                  static_cast<int>(LightingMode::Prt));
        Camera camera = document().view.camera;
        camera.yawDeg = -6.0f; // the tall block shows the side that faces the red wall
        camera.pitchDeg = 8.0f;
        controller().setCamera(frameBounds(camera, document().bounds(), 1.3f));
        TileSink sink;
        PrtSettings settings;
        settings.order = 3;
        settings.samples = 64;
        settings.transfer = TransferKind::Interreflected;
        controller().attachBake(std::make_shared<const BakeArtifact>(
            *bakePrtVertex(bakeInputs(document()), settings, sink, {})));
        ASSERT_TRUE(eventually([] { return bounces().upToDate(); }));
    }
    static BounceUpdater& bounces() { return session->bounces; }
    static ViewportWidget& viewport() { return window->viewport(); }
    static BakeArtifactPtr attached() { return document().bakes.at(0); }
    // The mean of the picture over the side of the tall block that faces the red wall, 0…255. Its
    // edges are left out: they are mixed with what lies behind, by as many samples as the frame's
    // time allows.
    static glm::dvec3 blockColor() {
        const QImage picture = viewport().grabFramebuffer();
        const Camera& camera = document().view.camera;
        const float aspect = float(picture.width()) / float(picture.height());
        const glm::mat4 toClip =
            camera.projectionMatrix(aspect, document().bounds()) * camera.viewMatrix();
        glm::dvec3 sum(0.0);
        int count = 0;
        for (const MeshInstance& block : document().meshes) {
            if (block.name != "Tall Block")
                continue;
            Bounds side;
            for (std::size_t v = 0; v < block.mesh->vertexCount(); ++v)
                if (block.mesh->normals[v].x <= -0.8f)
                    side.add(block.mesh->positions[v]);
            const glm::vec3 margin = 0.03f * (side.max - side.min);
            for (std::size_t v = 0; v < block.mesh->vertexCount(); ++v) {
                const glm::vec3& at = block.mesh->positions[v];
                const glm::vec3 inner = glm::clamp(at, side.min + margin, side.max - margin);
                if (block.mesh->normals[v].x > -0.8f || at.y != inner.y || at.z != inner.z)
                    continue;
                const glm::vec4 clip = toClip * block.placement.matrix() * glm::vec4(at, 1.0f);
                const QColor color = picture.pixelColor(
                    int((0.5f + 0.5f * clip.x / clip.w) * float(picture.width())),
                    int((0.5f - 0.5f * clip.y / clip.w) * float(picture.height())));
                sum += glm::dvec3(color.red(), color.green(), color.blue());
                ++count;
            }
        }
        EXPECT_GT(count, 50);
        return sum / double(count);
    }
    // Of the picture that stays. After an edit frames have fewer pixels, which differs by 0.6 to
    // 0.9 here, and on a busy machine that lasts: two equal pictures do not mean that nothing
    // follows.
    static glm::dvec3 settledColor() {
        EXPECT_TRUE(eventually([] { return viewport().isSettled() && bounces().upToDate(); }));
        return blockColor();
    }
    static void keep(const char* name) {
        const QString folder = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (folder.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(folder));
        EXPECT_TRUE(eventually([] { return viewport().isSettled(); }));
        EXPECT_TRUE(viewport().grabFramebuffer().save(QDir(folder).filePath(QLatin1String(name))));
    }
    const ParameterInfo& baseColor = parameter("material.baseColor");
    Target red;
};

// Painted blue, the wall turns the block's side from reddish to bluish: by the light shown, while
// the document's bake is still the one before, and then by the coefficients.
TEST_F(BounceWindow, ColoursBleedFromTheWallAsItIsPainted) {
    const glm::dvec3 before = settledColor();
    EXPECT_GT(before.r, before.b + 5.0);
    keep("bounces-red.png");

    const BakeArtifactPtr bakeBefore = attached();
    BakeArtifactPtr bakeThen;
    int frames = 0, framesTo = -1;
    double milliseconds = 0.0;
    glm::dvec3 live(0.0);
    QElapsedTimer clock;
    QObject here;
    QObject::connect(&viewport(), &ViewportWidget::frameRendered, &here, [&] { ++frames; });
    QObject::connect(&bounces(), &BounceUpdater::shownChanged, &here, [&] {
        if (!bounces().shown() || framesTo >= 0)
            return;
        framesTo = frames + 1;
        milliseconds = double(clock.nsecsElapsed()) * 1e-6;
        bakeThen = attached();
        // Under a hand that moves the next frame is drawn in one piece, whatever was refined.
        const Camera camera = controller().document().view.camera;
        Camera moved = camera;
        moved.yawDeg += 0.01f;
        controller().setCamera(moved);
        controller().setCamera(camera);
        live = blockColor();
    });
    clock.start();
    controller().setParameter(baseColor, red, glm::vec3(0.05f, 0.08f, 0.6f));
    ASSERT_TRUE(eventually([] { return bounces().upToDate(); }));
    const double settled = double(clock.nsecsElapsed()) * 1e-6;
    ASSERT_GE(framesTo, 0);
    EXPECT_EQ(bakeThen, bakeBefore);
    EXPECT_NE(attached(), bakeBefore);
    EXPECT_EQ(bounces().shown(), nullptr);
    const glm::dvec3 after = settledColor();
    std::printf("bleeding followed in frame %d, %.0f ms after the edit; all coefficients after "
                "%.0f ms; block %.0f %.0f %.0f -> %.0f %.0f %.0f\n",
                framesTo, milliseconds, settled, before.r, before.g, before.b, live.r, live.g,
                live.b);
    EXPECT_LT(live.r, before.r - 5.0);
    EXPECT_GT(live.b, before.b + 5.0);
    EXPECT_GT(live.b, live.r + 5.0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after[c], live[c], 3.0) << c; // which had fewer pixels
    keep("bounces-blue.png");

    controller().undoStack().undo();
    ASSERT_TRUE(eventually([] { return bounces().upToDate(); }));
    const glm::dvec3 back = settledColor();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(back[c], before[c], 0.5) << c;
}

// From left to right there is more light: none, the first bounce, all that the bake has.
TEST_F(BounceWindow, TheSliderGoesFromNoneToAsBaked) {
    auto* dock = window->findChild<QDockWidget*>(QStringLiteral("view"));
    dock->show();
    dock->raise();
    auto* slider = find<Slider>(*dock, QStringLiteral("Bounces"));
    auto* field = find<NumberField>(*dock, QStringLiteral("Bounces"));
    ASSERT_TRUE(slider && field && eventually([&] { return slider->isVisible(); }));
    const int baked = attached()->bounces;
    ASSERT_GE(baked, 2);
    const auto light = [] {
        const glm::dvec3 color = settledColor();
        return color.r + color.g + color.b;
    };
    const auto dragTo = [&](int x) {
        const int y = slider->height() / 2;
        QTest::mousePress(slider, Qt::LeftButton, {}, {slider->handleX(), y});
        QTest::mouseMove(slider, {x, y});
        QTest::mouseRelease(slider, Qt::LeftButton, {}, {x, y});
    };
    EXPECT_EQ(field->text(), QStringLiteral("as baked (%1)").arg(baked));
    EXPECT_GT(slider->handleX(), slider->width() - 10);
    const double all = light();

    dragTo(0);
    EXPECT_EQ(document().view.bounces, -1);
    EXPECT_EQ(field->text(), QStringLiteral("none"));
    const double none = light();
    dragTo(slider->width() / baked);
    EXPECT_EQ(document().view.bounces, 1);
    EXPECT_EQ(field->text(), QStringLiteral("1"));
    const double first = light();
    dragTo(slider->width() - 1);
    EXPECT_EQ(document().view.bounces, 0) << "as the bake, whichever it will be";
    EXPECT_EQ(field->text(), QStringLiteral("as baked (%1)").arg(baked));
    const double allAgain = light();
    EXPECT_GT(first, none + 5.0);
    EXPECT_GT(all, first + 0.5);
    EXPECT_NEAR(allAgain, all, 1.0);

    QTest::mouseClick(field, Qt::LeftButton, {}, {10, 10});
    QTest::keyClicks(field, QStringLiteral("0"));
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_EQ(document().view.bounces, -1);
    EXPECT_NEAR(light(), none, 1.0);
    // In the undo history it is a change like any other.
    while (document().view.bounces != 0)
        controller().undoStack().undo();
    EXPECT_EQ(field->text(), QStringLiteral("as baked (%1)").arg(baked));
}

} // namespace
} // namespace patina::editor
