// The Environment dock by real events: kinds, the sun, images, several environments, files.

#include "core/document/ViewChoices.h"
#include "tests/app/editor/EnvironmentPanelFixture.h"

#include "app/editor/panel/EnvironmentList.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/widget/RecentSkies.h"
#include "app/editor/widget/SkyGallery.h"
#include "core/base/InputFile.h"
#include "core/library/SoftboxRigs.h"
#include "core/light/BrightSources.h"
#include "core/light/Light.h"
#include "core/scene/EnvironmentSave.h"

#include <QFile>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>

namespace patina::editor {
namespace {

TEST_F(EnvironmentPanelTest, KindsChangeTheImageAndComeBack) {
    const ImagePtr studio = environment().image;
    choose("Sky");
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_NE(environment().image, studio);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_FALSE(panel().gallery()->isVisible());
    choose("Softboxes");
    EXPECT_EQ(environment().softboxes.size(), library::softboxRigs().front().softboxes.size());
    EXPECT_EQ(undoCount(), 2); // kind and rig are one step
    choose("Image");
    EXPECT_EQ(environment().image, studio);
    EXPECT_TRUE(panel().gallery()->isVisible());
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Softboxes);
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_TRUE(environment().softboxes.empty());
    controller().undoStack().undo();
    EXPECT_EQ(environment().image, studio);
    // An image chosen by name ends the sky, in one step.
    choose("Sky");
    controller().setEnvironment(QStringLiteral("builtin:white"));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(environment().kind, EnvironmentKind::Image);
    EXPECT_EQ(environment().image->linear(0, 0).g, 1.0f);
    controller().undoStack().undo();
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_GT(radiance(environment().sky.sunAzimuthDeg, environment().sky.sunElevationDeg), 100.0f);
}

TEST_F(EnvironmentPanelTest, TheEnvironmentKeepsItsShapeInADockOfAnyWidth) {
    choose("Softboxes"); // longer than the dock is high
    for (const int width : {311, 520, 400}) {
        alone->resize(width, 700);
        QApplication::processEvents();
        ASSERT_TRUE(eventually([] { return view().width() <= 2 * view().height() + 1; })) << width;
        EXPECT_GE(view().width(), width - 60);
        EXPECT_NEAR(view().height(), view().width() / 2.0, 8.5) << width;
    }
}

TEST_F(EnvironmentPanelTest, TheSunIsDraggedAndSet) {
    choose("Sky");
    const Sky before = environment().sky;
    const QPoint from = pointOf(before.sunAzimuthDeg, before.sunElevationDeg);
    drag(from + QPoint(2, 1), from + QPoint(42, -9)); // taken beside its middle it does not jump
    const Sky dragged = environment().sky;
    EXPECT_NEAR(dragged.sunAzimuthDeg, before.sunAzimuthDeg - 40 * degreesPerPixel(), 0.01);
    EXPECT_NEAR(dragged.sunElevationDeg,
                before.sunElevationDeg + 10 * 180.0 / view().map().area().height(), 0.01);
    EXPECT_EQ(undoCount(), 2); // the kind and the drag
    EXPECT_GT(radiance(dragged.sunAzimuthDeg, dragged.sunElevationDeg), 100.0f);
    controller().undoStack().undo();
    EXPECT_EQ(environment().sky, before);
    EXPECT_LT(radiance(dragged.sunAzimuthDeg, dragged.sunElevationDeg), 50.0f);

    // A click elsewhere brings it there; below the horizon it stays on it.
    const QPoint elsewhere = pointOf(-120, 50);
    press(elsewhere);
    release(elsewhere);
    EXPECT_NEAR(environment().sky.sunAzimuthDeg, -120, degreesPerPixel());
    EXPECT_NEAR(environment().sky.sunElevationDeg, 50, degreesPerPixel());
    press(pointOf(90, -30));
    release(pointOf(90, -30));
    EXPECT_EQ(environment().sky.sunElevationDeg, 0.0f);
    QTest::keyClick(&view(), Qt::Key_Up, Qt::ControlModifier);
    EXPECT_EQ(environment().sky.sunElevationDeg, 10.0f);
}

TEST_F(EnvironmentPanelTest, AnImageIsTurned) {
    const auto width = view().map().area().width();
    const QPoint from = view().rect().center();
    const auto quarter = static_cast<int>(width / 4);
    drag(from, from + QPoint(quarter, 0));
    // What was in the middle (behind, 180°) has gone to the right (90°): clockwise from above.
    EXPECT_NEAR(environment().rotationDeg, -quarter * 360.0 / width, 0.01);
    EXPECT_EQ(undoCount(), 1);
    EXPECT_NEAR(view().map().shift(), quarter, 0.01);
    controller().undoStack().undo();
    EXPECT_EQ(environment().rotationDeg, 0.0f);
}

TEST_F(EnvironmentPanelTest, WhatIsTurnedIsDraggedWhereItIsSeen) {
    const Id id = chooseOneSoftbox(plainBox(0, 0)); // the front is in the middle
    controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 70.0f);
    const QRectF area = view().map().area();
    const QPoint seen = pointOf(0, 0);
    EXPECT_NEAR(seen.x(), area.center().x() - 70 / degreesPerPixel(), 1.0);
    panel().softboxes()->select(0);
    drag(seen, seen + QPoint(20, 0));
    EXPECT_EQ(panel().softboxes()->selected(), id);
    EXPECT_NEAR(softbox(0).azimuthDeg, -20 * degreesPerPixel(), 0.01);
}

TEST_F(EnvironmentPanelTest, RowsFollowTheKindAndTheBackground) {
    ParameterList* list = nullptr;
    for (ParameterList* candidate : panel().findChildren<ParameterList*>())
        if (candidate->row("environment.background"))
            list = candidate;
    ASSERT_NE(list, nullptr);
    const auto hidden = [&](const char* id) { return list->row(id)->isHidden(); };
    EXPECT_TRUE(hidden("environment.skyTurbidity"));
    EXPECT_TRUE(hidden("environment.softboxAmbient"));
    choose("Sky");
    EXPECT_FALSE(hidden("environment.skyTurbidity"));
    choose("Softboxes");
    EXPECT_TRUE(hidden("environment.skyTurbidity"));
    EXPECT_FALSE(hidden("environment.softboxAmbient"));
    for (const auto& [mode, blur, color] : {std::tuple{BackgroundMode::Environment, true, true},
                                            {BackgroundMode::Blurred, false, true},
                                            {BackgroundMode::Color, true, false},
                                            {BackgroundMode::Off, true, true}}) {
        controller().setParameter(parameter("environment.background"), {Scope::Environment, 0},
                                  static_cast<int>(mode));
        EXPECT_EQ(hidden("environment.backgroundBlur"), blur);
        EXPECT_EQ(hidden("environment.backgroundColor"), color);
    }
}

// An HDR that was dropped or chosen can be had again by a click, in this session and in later ones.
TEST_F(EnvironmentPanelTest, EnvironmentsFromFilesJoinTheGallery) {
    const QString file = folder.filePath(QStringLiteral("my street.hdr"));
    const auto written = saveEnvironment(
        controller().worker(), environment(),
        EnvironmentSaveSettings{file.toStdString(), EnvironmentLayout::LatLong, 64, false});
    ASSERT_TRUE(written.ok()) << written.error().text();
    const auto button = [&](QWidget& gallery) {
        return find<QToolButton>(gallery, QStringLiteral("Environment my street"));
    };
    auto& gallery = *panel().findChild<SkyGallery*>();
    EXPECT_EQ(button(gallery), nullptr);
    controller().addFiles({file});
    ASSERT_TRUE(settled(*session));
    ASSERT_NE(button(gallery), nullptr);
    EXPECT_TRUE(button(gallery)->isChecked());

    controller().setEnvironment(QStringLiteral("builtin:studio"));
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(button(gallery)->isChecked());
    QTest::mouseClick(button(gallery), Qt::LeftButton);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(environment().source, file.toStdString());
    EXPECT_EQ(gallery.findChildren<QToolButton*>().count(button(gallery)), 1);

    // The picture is made in the background; the next session has both.
    EXPECT_TRUE(eventually([&] { return !skyPicture(file).isNull(); }));
    SkyGallery next;
    ASSERT_NE(button(next), nullptr);
    QFile::remove(file);
    SkyGallery without;
    EXPECT_EQ(button(without), nullptr) << "the file is gone";
}

// Several environments: the list appears with the second, a click lights the scene with another.
TEST_F(EnvironmentPanelTest, TheSceneHoldsSeveralEnvironments) {
    EnvironmentList& environments = *panel().findChild<EnvironmentList*>();
    QListWidget& list = *environments.list();
    const auto add = [&](const char* what) {
        auto* button = find<QToolButton>(environments,
                                         tr("Add an environment that the scene can be lit with"));
        for (QAction* action : button->menu()->actions())
            if (action->text().remove(QLatin1Char('&')) == tr(what)) {
                action->trigger();
                return eventually([] { return !controller().tasks().busy(); });
            }
        return false;
    };
    auto* remove = find<QToolButton>(environments, tr("Remove the environment"));
    auto* duplicate = find<QToolButton>(environments, tr("Duplicate the environment"));
    EXPECT_TRUE(list.isHidden());
    EXPECT_FALSE(remove->isEnabled());
    const Environment before = environment();

    ASSERT_TRUE(add("Night"));
    ASSERT_FALSE(list.isHidden());
    ASSERT_EQ(list.count(), 2);
    EXPECT_EQ(list.currentRow(), 1);
    EXPECT_EQ(list.item(1)->text(), tr("Night"));
    EXPECT_EQ(environment().source, "builtin:night");
    ASSERT_TRUE(add("Sky"));
    EXPECT_EQ(environment().kind, EnvironmentKind::Sky);
    EXPECT_NE(environment().image, nullptr) << "a draft at once";
    EXPECT_TRUE(eventually([] { return environment().image->height() == kEnvironmentHeight; }))
        << "then the full picture";
    const ImagePtr sky = environment().image;
    if (const QString shots = qEnvironmentVariable("PATINA_SCREENSHOTS"); !shots.isEmpty())
        panel().grab().save(shots + QStringLiteral("/environment-list.png"));

    // What is edited is the current one's.
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Right);
    EXPECT_NE(environment().sky, Sky()) << "the sun moved";
    EXPECT_TRUE(eventually([&] {
        return environment().image != sky && environment().image->height() == kEnvironmentHeight;
    }));
    const Sky moved = environment().sky;
    choose("Image");
    EXPECT_EQ(environment().source, "builtin:night") << "what lit the scene when it was added";
    EXPECT_EQ(environment().image, environment().fileImage);
    ASSERT_NE(environment().image, nullptr);
    controller().undoStack().undo();
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {},
                      list.visualItemRect(list.item(0)).center());
    EXPECT_EQ(environment(), before);
    EXPECT_EQ(controller().undoStack().undoText(), tr("Light with %1").arg(list.item(0)->text()));
    EXPECT_EQ(document().environments[2].sky, moved);

    // Its name: typed, then taken away again.
    controller().rename({Scope::Environment, before.id}, tr("Cold light"));
    EXPECT_EQ(list.item(0)->text(), tr("Cold light"));
    list.item(0)->setText({});
    EXPECT_EQ(document().environment().name, "");
    EXPECT_EQ(list.item(0)->text(), EnvironmentList::titleOf(before));

    // The same picture is not added twice.
    const int steps = controller().undoStack().count();
    ASSERT_TRUE(add("Night"));
    EXPECT_EQ(list.count(), 3);
    EXPECT_EQ(environment().source, "builtin:night");
    EXPECT_EQ(controller().undoStack().count(), steps + 1);

    QTest::mouseClick(duplicate, Qt::LeftButton);
    EXPECT_EQ(list.count(), 4);
    EXPECT_EQ(list.currentRow(), 2);
    EXPECT_NE(list.item(2)->text(), list.item(1)->text());
    for (int left = 3; left >= 1; --left) {
        QTest::mouseClick(remove, Qt::LeftButton);
        EXPECT_EQ(list.count(), left);
    }
    EXPECT_FALSE(remove->isEnabled());
    EXPECT_TRUE(list.isHidden());
    while (controller().undoStack().canUndo())
        controller().undoStack().undo();
    EXPECT_EQ(document().environments.size(), 1u);
    EXPECT_EQ(environment(), before);
    EXPECT_TRUE(list.isHidden());
}

TEST_F(EnvironmentPanelTest, AMissingFileIsSaid) {
    const QListWidget& list = *panel().findChild<EnvironmentList*>()->list();
    const QImage shown = view().grab().toImage();
    controller().editStructure(QStringLiteral("lose it"), [](Document& edited) {
        Environment lost = edited.environment();
        lost.id = edited.takeId();
        lost.source = "/lost/night.hdr";
        lost.problem = kNoSuchFile;
        edited.mix.first = lost.id;
        edited.environments.push_back(std::move(lost));
    });
    QApplication::processEvents();
    const QString said = QStringLiteral("night.hdr is missing; a neutral grey stands in");
    ASSERT_EQ(list.count(), 2);
    EXPECT_EQ(list.item(1)->toolTip(), said);
    EXPECT_NE(list.item(0)->toolTip(), said);
    EXPECT_NE(view().grab().toImage(), shown);
    EXPECT_TRUE(
        eventually([&] { return list.geometry().bottom() < list.parentWidget()->height(); }));
    if (const QString shots = qEnvironmentVariable("PATINA_SCREENSHOTS"); !shots.isEmpty())
        panel().grab().save(shots + QStringLiteral("/environment-missing.png"));
    controller().undoStack().undo();
    EXPECT_EQ(list.count(), 1);
}

// Its full picture is still under way when it is removed.
TEST_F(EnvironmentPanelTest, AnEnvironmentIsRemovedWhileItsPictureIsMade) {
    const Id studio = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Sky);
    const Id sky = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Softboxes);
    const Id boxes = document().mix.first;
    QTest::qWait(260); // the full picture of the softboxes has begun
    controller().removeEnvironment(boxes);
    EXPECT_EQ(document().mix.first, sky);
    const auto isFull = [](Id id) {
        const ImagePtr& image = document().environment(id)->image;
        return image && image->height() == kEnvironmentHeight;
    };
    EXPECT_TRUE(eventually([&] { return isFull(sky); })) << "the other one is still made";
    controller().removeEnvironment(sky);
    EXPECT_EQ(document().mix.first, studio);
    controller().undoStack().undo();
    controller().undoStack().undo();
    EXPECT_EQ(document().mix.first, boxes);
    EXPECT_TRUE(eventually([&] { return isFull(boxes); }));
}

// A picture that is read when its environment is no longer the one that lights goes where it was
// asked for.
TEST_F(EnvironmentPanelTest, AReadPictureGoesToTheEnvironmentItWasAskedFor) {
    const Id studio = document().mix.first;
    controller().addEnvironment(EnvironmentKind::Sky);
    const Id sky = document().mix.first;
    controller().lightWith(studio);
    controller().setEnvironment(QStringLiteral("builtin:night"));
    controller().lightWith(sky);
    ASSERT_TRUE(eventually([] { return !controller().tasks().busy(); }));
    EXPECT_EQ(document().environment(studio)->source, "builtin:night");
    EXPECT_EQ(document().environment(sky)->kind, EnvironmentKind::Sky);
}

// The brightest source of the image becomes a light, in one step, and the picture loses it.
TEST_F(EnvironmentPanelTest, TheSunIsExtracted) {
    controller().setEnvironment(QStringLiteral("builtin:clear-sky"));
    ASSERT_TRUE(eventually([] {
        return !controller().tasks().busy() && environment().source == "builtin:clear-sky";
    }));
    const Document before = document();
    const int steps = undoCount();
    auto* extract = find<QPushButton>(panel(), tr("Extract Sun"));
    ASSERT_NE(extract, nullptr);
    extract->click();
    ASSERT_TRUE(eventually([] { return !document().lights.empty(); }));
    EXPECT_EQ(undoCount(), steps + 1);
    EXPECT_EQ(environment().removedSources, 1);
    const BrightSources found = extractBrightSources(*environment().fileImage, 1);
    EXPECT_EQ(document().lights[0].intensity, lightOf(found.sources[0], environment()).intensity);
    EXPECT_TRUE(eventually([&] { return *environment().image == found.picture; }))
        << "a draft at once, then the full picture";
    controller().undoStack().undo();
    EXPECT_EQ(document(), before);
    EXPECT_EQ(environment().image, environment().fileImage);
    controller().undoStack().redo();
    EXPECT_EQ(environment().removedSources, 1);

    // Another image has its own.
    controller().setEnvironment(QStringLiteral("builtin:white"));
    ASSERT_TRUE(eventually([] { return environment().source == "builtin:white"; }));
    EXPECT_EQ(environment().removedSources, 0);
    const std::size_t lights = document().lights.size();
    extract->click();
    ASSERT_TRUE(eventually([] { return !controller().tasks().busy(); }));
    EXPECT_EQ(document().lights.size(), lights) << "nothing stands out from a white sky";
}

} // namespace
} // namespace patina::editor
