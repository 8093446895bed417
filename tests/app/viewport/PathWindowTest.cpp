// The viewport's picture traced by paths: switched on by a key, followed through edits and moves.
#include "app/editor/trace/BlameBars.h"
#include "app/editor/trace/PathBadge.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathErrorOverlay.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/TransferRemedy.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/image/Channels.h"
#include "core/io/ImageIO.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/trace/file/OutputImages.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/UnderSky.h"

#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <QStatusBar>
#include <QTemporaryDir>
#include <algorithm>

namespace patina::editor {
namespace {

class PathWindow : public EditorTest {
  protected:
    void SetUp() override {
        session->paths.setOn(false);
        session->wall.setOn(false);
        session->views.set({});
        EditorTest::SetUp();
        viewport().setFixedSize(160, 120);
        viewport().setAddsSlowFrames(true); // pictures are compared, on busy machines too
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    void TearDown() override { session->paths.setOn(false); }

    static ViewportWidget& viewport() { return window->viewport(); }
    static PathView& paths() { return session->paths; }
    static void key(Qt::Key code) { QTest::keyClick(&viewport(), code); }
    static PathBadge& badge() { return *viewport().findChild<PathBadge*>(); }
    static std::string text() {
        return badge().findChild<QLabel*>(QStringLiteral("pathBadgeText"))->text().toStdString();
    }
    static bool hasSamples(std::uint32_t count) {
        return eventually([=] { return paths().progress().samples >= count; });
    }
    static double mean(const QImage& picture) {
        double sum = 0.0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                sum += qGray(picture.pixel(x, y));
        return sum / (picture.width() * picture.height());
    }
};

TEST_F(PathWindow, AKeySwitchesItOnAndOff) {
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    const QImage before = viewport().grabFramebuffer();
    EXPECT_FALSE(badge().isVisible());
    const int steps = undoCount();
    key(Qt::Key_F12);
    EXPECT_TRUE(paths().isOn());
    EXPECT_TRUE(badge().isVisible());
    ASSERT_TRUE(hasSamples(4));
    EXPECT_FALSE(viewport().isSettled()) << "it becomes finer yet";
    ASSERT_TRUE(eventually([] { return text().find("paths per pixel") != std::string::npos; }));
    EXPECT_THAT(text(), testing::HasSubstr("± "));
    ASSERT_NE(paths().picture(), nullptr);
    EXPECT_EQ(paths().picture()->width(), 160);
    const QImage shown = viewport().grabFramebuffer();
    EXPECT_NE(shown, before);
    EXPECT_NEAR(mean(shown), mean(before), 25.0) << "it is of the same scene";
    EXPECT_EQ(undoCount(), steps) << "looking changes nothing";
    key(Qt::Key_F12);
    EXPECT_FALSE(paths().isOn());
    EXPECT_FALSE(badge().isVisible());
    EXPECT_EQ(paths().picture(), nullptr);
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    EXPECT_EQ(viewport().grabFramebuffer(), before);
}

TEST_F(PathWindow, AnEditOrAMoveBeginsItAnewAndExposureDoesNot) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(2));
    std::uint32_t before = paths().progress().samples;
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 1.0f);
    ASSERT_TRUE(hasSamples(before + 1));
    ImagePtr picture = paths().picture();
    controller().setParameter(*findParameter("material.metallic"),
                              {Scope::Material, document().materials.front().id}, 0.25f);
    ASSERT_TRUE(eventually([&] { return paths().picture() != picture; }));
    ASSERT_TRUE(eventually([] { return paths().progress().samples <= 1; }));
    ASSERT_TRUE(hasSamples(2));
    Camera camera = document().view.camera;
    camera.yawDeg += 20.0f;
    controller().setCamera(camera);
    ASSERT_TRUE(eventually([] { return paths().progress().samples <= 1; }));
    ASSERT_TRUE(hasSamples(1));
}

TEST_F(PathWindow, RestsWhilePaused) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(2));
    auto* pause = badge().findChild<QPushButton*>(QStringLiteral("pathPause"));
    QTest::mouseClick(pause, Qt::LeftButton);
    EXPECT_TRUE(paths().isPaused());
    ASSERT_TRUE(eventually([] { return !paths().isTracing(); })); // the pass that was under way
    const std::uint32_t samples = paths().progress().samples;
    viewport().update();
    QApplication::processEvents();
    EXPECT_EQ(paths().progress().samples, samples);
    EXPECT_EQ(pause->text(), QStringLiteral("Resume"));
    QTest::mouseClick(pause, Qt::LeftButton);
    EXPECT_TRUE(hasSamples(samples + 1));
}

TEST_F(PathWindow, NoticesStandAboveTheBadge) {
    viewport().setFixedSize(640, 320);
    UserNotice notice;
    notice.text = QStringLiteral("Something that is as long as a sentence of a notice usually is.");
    auto* area = viewport().findChild<NoticeArea*>();
    area->add(notice);
    const auto overlap = [&] {
        QApplication::processEvents();
        return area->geometry().intersects(badge().geometry());
    };
    const QRect alone = area->geometry();
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1));
    EXPECT_FALSE(overlap());
    EXPECT_LT(area->geometry().bottom(), alone.bottom());
    key(Qt::Key_F12);
    QApplication::processEvents();
    EXPECT_EQ(area->geometry(), alone);
}

TEST_F(PathWindow, WhatIsSavedIsThePictureThatIsThere) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(4));
    paths().setPaused(true);
    ASSERT_TRUE(eventually([] { return !paths().isTracing(); })); // the pass that was under way
    const QTemporaryDir folder;
    const auto save = [&](const char* name, int filter) {
        QTest::mouseClick(badge().findChild<QPushButton*>(QStringLiteral("pathSave")),
                          Qt::LeftButton);
        auto* dialog = window->findChild<QFileDialog*>(QStringLiteral("tracedSaveDialog"));
        ASSERT_NE(dialog, nullptr);
        dialog->selectNameFilter(dialog->nameFilters()[filter]);
        Q_EMIT dialog->fileSelected(folder.filePath(QLatin1String(name)));
        dialog->close();
        ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    };
    const auto load = [&](const char* name) {
        ImageLoadOptions all;
        all.allParts = true;
        return loadImage(session->worker, folder.filePath(QLatin1String(name)).toStdString(), all);
    };
    const Image picture = withoutAlpha(*paths().picture());
    const auto same = [&](const Image& saved) {
        return saved.channels() == 3 && std::ranges::equal(saved.f32(), picture.f32());
    };
    save("linear.exr", 1);
    const auto linear = load("linear.exr");
    ASSERT_TRUE(linear.ok()) << linear.error().message;
    EXPECT_TRUE(same(linear->parts[0].image));
    save("parts.exr", 2);
    const auto parts = load("parts.exr");
    ASSERT_TRUE(parts.ok()) << parts.error().message;
    EXPECT_EQ(parts->parts.size(), outputInfos().size());
    EXPECT_EQ(parts->parts[0].name, "beauty");
    EXPECT_TRUE(same(parts->parts[0].image)) << "the same paths once more";
    save("shown.png", 0);
    const QImage shown(folder.filePath(QStringLiteral("shown.png")));
    ASSERT_EQ(shown.size(), QSize(160, 120));
    EXPECT_NEAR(mean(shown), mean(viewport().grabFramebuffer()), 3.0);
}

TEST_F(PathWindow, TermsAndTheWallAreDrawnAsUsual) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(1));
    session->views.edit(
        [](render::ViewSettings& settings) { settings.shown.kind = shading::kViewBaseColor; });
    ASSERT_TRUE(eventually([] { return text().find("as usual") != std::string::npos; }));
    session->views.set({});
    ASSERT_TRUE(hasSamples(1));
    key(Qt::Key_F3); // a wall
    EXPECT_FALSE(badge().isVisible());
    EXPECT_FALSE(paths().isOn());
    key(Qt::Key_F12); // its cells
    EXPECT_FALSE(paths().isOn());
    EXPECT_TRUE(session->wall.isOn());
    key(Qt::Key_F12);
    key(Qt::Key_F3);
    key(Qt::Key_F12);
    EXPECT_TRUE(paths().isOn());
}

// --- The error of the drawn picture --------------------------------------------------------------

class PathErrorWindow : public PathWindow {
  protected:
    static PathError& error() { return session->pathError; }
    static PathErrorOverlay& overlay() { return *viewport().findChild<PathErrorOverlay*>(); }
    static void show(const char* name) {
        auto* box = badge().findChild<QComboBox*>(QStringLiteral("pathShown"));
        const int index = box->findText(QLatin1String(name));
        ASSERT_GE(index, 0) << name;
        box->setCurrentIndex(index);
        Q_EMIT box->activated(index);
    }
    static bool isMeasured() {
        return eventually([] { return error().measured() != nullptr; });
    }
    static std::string lines() { return overlay().lines().join(QLatin1Char('\n')).toStdString(); }
};

TEST_F(PathErrorWindow, TheDrawnPictureIsMeasuredAgainstTheTracedOne) {
    key(Qt::Key_F12);
    ASSERT_TRUE(hasSamples(2));
    EXPECT_FALSE(overlay().isVisible());
    EXPECT_EQ(paths().reference().traced, nullptr) << "nobody asked";
    show("Visible difference");
    EXPECT_TRUE(overlay().isVisible());
    ASSERT_TRUE(isMeasured());
    const ErrorScore whole = error().measured()->error.whole;
    EXPECT_EQ(whole.pixels, 160u * 120u);
    EXPECT_GT(whole.flip, 0.0);
    EXPECT_GT(whole.flipNoise, 0.0);
    EXPECT_LT(std::abs(whole.biasEv), 0.5) << "it is of the same scene";
    EXPECT_FALSE(error().measured()->error.materials.empty());
    EXPECT_THAT(lines(), testing::HasSubstr("FLIP"));
    EXPECT_THAT(lines(), testing::HasSubstr(document().materials.front().name));
    EXPECT_EQ(error().picture().size(), QSize(160, 120));

    show("Viewport");
    const QImage drawn = error().picture();
    const QImage visible = error().measured()->visible;
    EXPECT_NE(drawn, visible);
    show("Visible difference");
    QTest::keyPress(&viewport(), Qt::Key_Space);
    EXPECT_TRUE(error().isPeeking());
    QTest::keyRelease(&viewport(), Qt::Key_Space);
    EXPECT_FALSE(error().isPeeking());

    key(Qt::Key_F12);
    EXPECT_FALSE(overlay().isVisible());
    EXPECT_EQ(error().shown(), PathPicture::Traced);
    EXPECT_EQ(error().measured(), nullptr) << "what it took is given back";
    viewport().setOverlaysVisible(false); // no grid in it
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    EXPECT_NEAR(mean(viewport().grabFramebuffer()), mean(drawn), 0.5);
    viewport().setOverlaysVisible(true);
}

TEST_F(PathErrorWindow, ItSaysWhichShortcutsMakeTheError) {
    const auto& blame = session->pathBlame;
    key(Qt::Key_F12);
    show("Visible difference");
    ASSERT_TRUE(eventually([&] { return blame.found() != nullptr; }));
    EXPECT_EQ(blame.size(), QSize(160, 120));
    EXPECT_FALSE(blame.found()->blame.materials.empty());
    const std::string causes = overlay().accessibleDescription().toStdString();
    EXPECT_THAT(causes, testing::HasSubstr("Causes: picture"));
    // Over the model: those of its material.
    QTest::mouseMove(&viewport(), viewport().rect().center());
    EXPECT_EQ(blame.scoreAt(QPointF(0.5, 0.5)).material, document().materials.front().id);
    EXPECT_EQ(blame.scoreAt(QPointF(0.01, 0.01)).material, 0u);
    EXPECT_EQ(blame.scoreAt(std::nullopt).material, 0u);
    // And those of the pixels there, with their noise where it is not all.
    const auto here = blame.hereAt(QPointF(0.5, 0.5));
    ASSERT_TRUE(here.has_value());
    EXPECT_EQ(here->material, document().materials.front().id);
    EXPECT_GE(here->pixels, 1u);
    EXPECT_LE(here->pixels, 25u);
    EXPECT_FALSE(blame.hereAt(QPointF(0.01, 0.01))) << "no surface";
    EXPECT_FALSE(blame.hereAt(QPointF(1.5, 0.5)));
    EXPECT_FALSE(blame.hereAt(std::nullopt));
    BlameScore pixel = *here;
    pixel.isKnown = true;
    pixel.causes[0].share = -0.4;
    pixel.causes[0].noise = 0.07;
    BlameScore whole = blame.scoreAt(std::nullopt);
    whole.isKnown = true;
    EXPECT_THAT(blameBars(whole, QStringLiteral("Gold"), pixel)
                    .lines()
                    .join(QLatin1Char('\n'))
                    .toStdString(),
                testing::HasSubstr("−40 ± 7 %"));
    pixel.isKnown = false;
    EXPECT_THAT(blameBars(whole, QStringLiteral("Gold"), pixel).lines().constFirst().toStdString(),
                testing::HasSubstr("within the noise"));

    // Exposure makes other weights.
    const auto before = blame.found();
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 2.0f);
    ASSERT_TRUE(eventually([&] { return blame.found() != nullptr && blame.found() != before; }));
    // Another light has no such causes, and says so.
    controller().setParameter(*findParameter("view.lighting"), {Scope::View, 0},
                              static_cast<int>(LightingMode::ShIrradiance));
    ASSERT_TRUE(eventually([&] { return !blame.problem().isEmpty(); }));
    EXPECT_EQ(blame.found(), nullptr);
    ASSERT_TRUE(isMeasured());
    EXPECT_THAT(overlay().accessibleDescription().toStdString(),
                testing::HasSubstr(blame.problem().toStdString()));
    key(Qt::Key_F12);
    EXPECT_EQ(blame.found(), nullptr) << "what it took is given back";
}

TEST_F(PathErrorWindow, ItFollowsEditsAndWaitsForWhatIsNew) {
    key(Qt::Key_F12);
    show("Too bright, too dark");
    ASSERT_TRUE(isMeasured());
    auto before = error().measured();
    // Exposure: the same light, another score; nothing is traced anew.
    const std::uint64_t number = paths().number();
    controller().setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, -6.0f);
    ASSERT_TRUE(eventually([&] {
        return error().measured() &&
               mean(error().measured()->shownDrawn) < 0.2 * mean(before->shownDrawn);
    }));
    EXPECT_EQ(paths().number(), number);
    EXPECT_LT(error().measured()->error.whole.flip, before->error.whole.flip);
    // An edit: both are made anew.
    before = error().measured();
    controller().setParameter(*findParameter("material.baseColor"),
                              {Scope::Material, document().materials.front().id},
                              glm::vec3(0.9f, 0.1f, 0.1f));
    ASSERT_TRUE(eventually([&] { return paths().number() != number; }));
    ASSERT_TRUE(eventually([&] {
        const auto& measured = error().measured();
        return measured && measured->traced != before->traced && measured->drawn != before->drawn;
    }));
}

// The box is open to one side only: image-based light knows nothing of its walls.
TEST_F(PathErrorWindow, TransferBakesTheErrorAway) {
    controller().openScene(QStringLiteral("builtin:cornell-box"));
    ASSERT_TRUE(settled(*session));
    putUnderSky(*session);
    for (const Target& lamp : targetsNamed(document(), Scope::Material, "Light"))
        controller().setParameter(*findParameter("material.emissive"), lamp, glm::vec3(0.0f));
    auto* remedy = badge().findChild<TransferRemedy*>();
    ASSERT_NE(remedy, nullptr);
    key(Qt::Key_F12);
    EXPECT_FALSE(remedy->isVisible()) << "no error is looked at";
    show("Visible difference");
    ASSERT_TRUE(isMeasured());
    ASSERT_TRUE(hasSamples(16));
    EXPECT_TRUE(remedy->isVisible());
    EXPECT_EQ(remedy->text(), QStringLiteral("Bake Transfer"));
    const double before = error().measured()->error.whole.flip;
    const int steps = undoCount();
    QTest::mouseClick(remedy, Qt::LeftButton);
    EXPECT_FALSE(remedy->isEnabled()) << "it is being baked";
    ASSERT_TRUE(eventually([] { return hasTransfer(document()); }));
    EXPECT_EQ(document().view.lighting, LightingMode::Prt);
    EXPECT_FALSE(remedy->isVisible());
    EXPECT_EQ(undoCount(), steps + 1) << "the light, not the bake";
    ASSERT_TRUE(eventually([&] { return !remedy->before(); })) << "it says what came of it";
    EXPECT_THAT(window->statusBar()->currentMessage().toStdString(), testing::HasSubstr("FLIP"));
    EXPECT_LT(error().measured()->error.whole.flip, 0.5 * before);

    // Undone, the bake is there: it is only used.
    controller().undoStack().undo();
    EXPECT_EQ(remedy->text(), QStringLiteral("Light with Transfer"));
    QTest::mouseClick(remedy, Qt::LeftButton);
    EXPECT_EQ(document().view.lighting, LightingMode::Prt);
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
}

} // namespace
} // namespace patina::editor
