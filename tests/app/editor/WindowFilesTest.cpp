// Files and the window: titles, the guard of unsaved work, drops, notices, recent files.
#include "core/document/ViewChoices.h"
#include "tests/app/editor/WindowFixture.h"
#include "tests/support/Events.h"

#include "app/editor/Actions.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/viewport/SceneProgress.h"
#include "app/editor/widget/MessageBar.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/edit/EditSession.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>

namespace patina::editor {
namespace {

TEST_F(WindowTest, TheTitleNamesTheFileAndItsState) {
    const auto titled = [](const char* title) {
        return eventually([=] { return window->windowTitle() == QString::fromUtf8(title); });
    };
    EXPECT_TRUE(titled("Untitled[*] — Patina")) << "with its first picture";
    EXPECT_FALSE(window->isWindowModified());
    modify();
    EXPECT_TRUE(window->isWindowModified());
    saveProjectFile(QStringLiteral("chair.patina"));
    EXPECT_EQ(window->windowTitle().toStdString(), "chair.patina[*] — Patina");
    EXPECT_FALSE(window->isWindowModified());
}

// Until its picture is there the title is that of the scene that is seen, and says over it what
// comes.
TEST_F(WindowTest, TheTitleChangesWithThePicture) {
    ASSERT_TRUE(
        eventually([] { return window->windowTitle().startsWith(QStringLiteral("Untitled")); }));
    const QString model = writeObj(QStringLiteral("wedge.obj"));
    auto* progress = window->viewport().findChild<SceneProgress*>();
    ASSERT_NE(progress, nullptr);
    EXPECT_FALSE(progress->isVisible());
    bool swapped = false, early = false, said = false;
    const auto swap = QObject::connect(&window->viewport(), &QOpenGLWidget::frameSwapped, [&] {
        swapped |= !document().meshes.empty() && document().meshes[0].name == "Triangle";
    });
    const auto look = QObject::connect(&controller(), &DocumentController::changed, [&] {
        said |= progress->isVisible();
        early |= window->windowTitle().startsWith(QStringLiteral("wedge"));
    });
    window->files().open(model);
    EXPECT_TRUE(progress->isVisible()) << "reading";
    EXPECT_TRUE(eventually([&] {
        const bool titled = window->windowTitle().startsWith(QStringLiteral("wedge"));
        early |= titled && !swapped;
        return titled;
    }));
    EXPECT_FALSE(early) << "the old picture was still shown";
    EXPECT_TRUE(said);
    EXPECT_TRUE(swapped);
    EXPECT_FALSE(progress->isVisible());
    QObject::disconnect(swap);
    QObject::disconnect(look);
    // What cannot be read leaves title and picture.
    window->files().open(folder.filePath(QStringLiteral("none.obj")));
    EXPECT_TRUE(settled(*session));
    EXPECT_FALSE(progress->isVisible());
    EXPECT_TRUE(window->windowTitle().startsWith(QStringLiteral("wedge")));
}

// The environment and the lights are the artist's: a model is seen in them, a project in its own.
TEST_F(WindowTest, AModelIsOpenedInTheLightThatIsThere) {
    controller().setEnvironment(QStringLiteral("builtin:sunset"));
    ASSERT_TRUE(settled(*session));
    controller().addLight(LightType::Spot);
    controller().addEnvironment(EnvironmentKind::Sky);
    controller().fadeTo(document().environments[0].id);
    controller().setParameter(parameter("environment.background"), {Scope::Environment, 0},
                              static_cast<int>(BackgroundMode::Off));
    const std::vector<Environment> environments = document().environments;
    const Light light = document().lights[0];
    controller().saveAs(folder.filePath(QStringLiteral("light.patina"))); // nothing to ask about
    ASSERT_TRUE(settled(*session));
    window->files().open(writeObj(QStringLiteral("wedge.obj")));
    ASSERT_TRUE(settled(*session));
    ASSERT_EQ(document().meshes.size(), 1u);
    // They have other ids, and are the same for all else.
    ASSERT_EQ(document().environments.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        Environment expected = environments[i];
        expected.id = document().environments[i].id;
        expected.image = document().environments[i].image; // the sky's may have been refined
        EXPECT_EQ(document().environments[i], expected);
    }
    EXPECT_EQ(document().mix.first, document().environments[1].id);
    EXPECT_EQ(document().mix.second, document().environments[0].id);
    EXPECT_EQ(document().mix.fade, 0.5f);
    EXPECT_EQ(document().view.background, BackgroundMode::Off);
    ASSERT_EQ(document().lights.size(), 1u);
    EXPECT_EQ(document().lights[0].position, light.position);
    EXPECT_EQ(document().lights[0].name, light.name);
    EXPECT_NE(document().lights[0].id, document().meshes[0].id);
    const QString project = saveProjectFile(QStringLiteral("own.patina"));
    controller().setEnvironment(QStringLiteral("builtin:studio"));
    ASSERT_TRUE(settled(*session));
    controller().saveAs(folder.filePath(QStringLiteral("other.patina"))); // nothing to ask about
    ASSERT_TRUE(settled(*session));
    window->files().open(project);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().kind, EnvironmentKind::Sky);
    EXPECT_EQ(document().secondEnvironment()->source, "builtin:sunset");
}

// Where the model or the project lies, its maps and exports lie, too, until one goes elsewhere.
TEST_F(WindowTest, DialogsProposeTheFolderOfTheScene) {
    const QString key = QStringLiteral("folders/images");
    QDir(folder.path()).mkpath(QStringLiteral("model"));
    QDir(folder.path()).mkpath(QStringLiteral("project"));
    QDir(folder.path()).mkpath(QStringLiteral("library"));
    const QString model = folder.filePath(QStringLiteral("model"));
    const QString project = folder.filePath(QStringLiteral("project"));
    const QString library = folder.filePath(QStringLiteral("library"));
    EXPECT_TRUE(QFileInfo(proposedFolder(controller(), key)).isDir()) << "without a scene on disk";
    window->files().open(writeObj(QStringLiteral("model/wedge.obj")));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(proposedFolder(controller(), key), model);
    EXPECT_EQ(proposedFolder(controller(), QStringLiteral("folders/exports")), model);
    rememberFolder(controller(), key, library + QStringLiteral("/wood.png"));
    EXPECT_EQ(proposedFolder(controller(), key), library) << "chosen for this scene";
    EXPECT_EQ(proposedFolder(controller(), QStringLiteral("folders/environments")), model);
    saveProjectFile(QStringLiteral("project/wedge.patina"));
    EXPECT_EQ(proposedFolder(controller(), key), project) << "another scene";
    // The dialogs themselves.
    window->files().saveAs();
    auto* dialog = window->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(dialog->directory().absolutePath(), project);
    dialog->reject();
    EXPECT_TRUE(eventually([] { return window->findChild<QFileDialog*>() == nullptr; }));
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(proposedFolder(controller(), key), library) << "the last one, without a scene";
}

TEST_F(WindowTest, NothingAsksWhenNothingIsLost) {
    bool proceeded = false;
    window->files().guard([&] { proceeded = true; });
    EXPECT_TRUE(proceeded);
    EXPECT_EQ(question(), nullptr);
}

TEST_F(WindowTest, TheGuardStaysOnCancelAndGoesOnDiscard) {
    modify();
    int proceeded = 0;
    window->files().guard([&] { ++proceeded; });
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    answer(QMessageBox::Cancel);
    EXPECT_EQ(proceeded, 0);
    EXPECT_TRUE(controller().isModified());
    window->files().guard([&] { ++proceeded; });
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    answer(QMessageBox::Discard);
    EXPECT_EQ(proceeded, 1);
}

TEST_F(WindowTest, TheGuardSavesFirstWhenAsked) {
    const QString file = saveProjectFile(QStringLiteral("a.patina"));
    modify();
    bool proceeded = false;
    window->files().guard([&] { proceeded = true; });
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    answer(QMessageBox::Save);
    ASSERT_TRUE(eventually([&] { return proceeded; }));
    EXPECT_FALSE(controller().isModified());
    QFile saved(file);
    ASSERT_TRUE(saved.open(QIODevice::ReadOnly));
    EXPECT_TRUE(saved.readAll().contains("0.123"));
}

TEST_F(WindowTest, ClosingAsksAndStaysOnCancel) {
    modify();
    EXPECT_FALSE(window->close());
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    answer(QMessageBox::Cancel);
    EXPECT_TRUE(window->isVisible());
}

TEST_F(WindowTest, AProjectDroppedOpensBehindTheGuard) {
    controller().rename({Scope::Material, selectedMaterial().id}, QStringLiteral("Glaze"));
    const QString file = saveProjectFile(QStringLiteral("dropped.patina"));
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    modify();
    dropOnWindow({file});
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    EXPECT_NE(controller().filePath(), file);
    answer(QMessageBox::Discard);
    ASSERT_TRUE(eventually([&] { return controller().filePath() == file; }));
    EXPECT_TRUE(std::any_of(document().materials.begin(), document().materials.end(),
                            [](const Material& m) { return m.name == "Glaze"; }));
    EXPECT_EQ(window->files().recentFiles().value(0), file);
}

TEST_F(WindowTest, AModelDroppedOnTheStartSceneReplacesIt) {
    dropOnWindow({writeObj(QStringLiteral("triangle.obj"))});
    ASSERT_TRUE(settled(*session));
    ASSERT_EQ(document().meshes.size(), 1u);
    EXPECT_EQ(document().meshes[0].mesh->triangleCount(), 1u);
    EXPECT_EQ(controller().displayName(), QStringLiteral("triangle"));
}

TEST_F(WindowTest, AModelDroppedOnWorkAsksWhatToDo) {
    modify();
    const std::size_t before = document().meshes.size();
    dropOnWindow({writeObj(QStringLiteral("triangle.obj"))});
    QMenu* menu = nullptr;
    ASSERT_TRUE(eventually([&] {
        menu = window->findChild<QMenu*>(QStringLiteral("dropMenu"));
        return menu && menu->isVisible();
    }));
    EXPECT_EQ(document().meshes.size(), before);
    menu->actions().first()->trigger();
    menu->close();
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().meshes.size(), before + 1);
    EXPECT_EQ(undoCount(), 2);
}

TEST_F(WindowTest, AnEnvironmentDroppedLightsTheScene) {
    QFile hdr(folder.filePath(QStringLiteral("sky.hdr")));
    ASSERT_TRUE(hdr.open(QIODevice::WriteOnly));
    hdr.write("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n");
    for (int pixel = 0; pixel < 8; ++pixel)
        hdr.write("\x80\x40\x20\x82", 4); // flat RGBE
    hdr.close();
    dropOnWindow({hdr.fileName()});
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environment().source, hdr.fileName().toStdString());
    ASSERT_NE(document().environment().image, nullptr);
    EXPECT_EQ(document().environment().image->type(), PixelType::F32);
}

TEST_F(WindowTest, ABrokenFileIsANoticeAndNothingIsLost) {
    QFile file(folder.filePath(QStringLiteral("broken.glb")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("this is no GLB");
    file.close();
    const Document before = document();
    dropOnWindow({file.fileName(), folder.filePath(QStringLiteral("notes.txt"))});
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document(), before);
    QStringList texts;
    for (const NoticeBar* bar : window->notices().bars())
        texts << bar->notice().text;
    EXPECT_TRUE(texts.join(QLatin1Char('\n')).contains(QStringLiteral("broken.glb")));
    EXPECT_TRUE(texts.join(QLatin1Char('\n')).contains(QStringLiteral("notes.txt")));
}

TEST_F(WindowTest, NoticesLeaveThePictureItsSize) {
    const QSize before = window->viewport().size();
    for (int i = 0; i < 3; ++i)
        Q_EMIT controller().noticed({NoticeKind::Error, QString::number(i), {}});
    test::handleEvents();
    EXPECT_EQ(window->viewport().size(), before);
    EXPECT_EQ(window->notices().bars().size(), 2);
}

TEST_F(WindowTest, NoticesGoWithTheirScene) {
    const auto texts = [] {
        QStringList all;
        for (const NoticeBar* bar : window->notices().bars())
            all << bar->notice().text;
        return all.join(QLatin1Char('\n'));
    };
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    QFile broken(folder.filePath(QStringLiteral("broken.glb")));
    ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
    broken.write("this is no GLB");
    broken.close();
    controller().openScene(broken.fileName());
    ASSERT_TRUE(settled(*session));
    Q_EMIT controller().noticed({NoticeKind::Warning, QStringLiteral("of this scene"), {}});
    EXPECT_TRUE(texts().contains(QStringLiteral("of this scene")));
    EXPECT_TRUE(texts().contains(QStringLiteral("broken.glb")));
    controller().newDocument(); // as at the start, when there is nothing else to show
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(texts().contains(QStringLiteral("of this scene")));
    EXPECT_TRUE(texts().contains(QStringLiteral("broken.glb")));
    Q_EMIT controller().noticed({NoticeKind::Warning, QStringLiteral("of this scene"), {}});
    controller().openScene(writeObj(QStringLiteral("triangle.obj")));
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(texts().contains(QStringLiteral("of this scene"))) << texts().toStdString();
    EXPECT_FALSE(texts().contains(QStringLiteral("broken.glb"))) << texts().toStdString();
}

TEST_F(WindowTest, RecentFilesForgetWhatIsGone) {
    const QString file = saveProjectFile(QStringLiteral("gone.patina"));
    EXPECT_EQ(window->files().recentFiles().value(0), file);
    ASSERT_TRUE(QFile::remove(file));
    window->files().open(file);
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(window->files().recentFiles().contains(file));
}

} // namespace
} // namespace patina::editor
