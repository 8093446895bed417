// The window as a whole: files, guard, drops, actions, layout, pictures of it.

#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/Actions.h"
#include "app/editor/HelpDialogs.h"
#include "app/editor/ViewActions.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/viewport/SceneProgress.h"
#include "app/editor/widget/MessageBar.h"
#include "app/editor/widget/NoticeArea.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Section.h"
#include "core/edit/EditSession.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QSettings>
#include <QStatusTipEvent>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <map>
#include <set>

namespace patina::editor {
namespace {

struct WindowTest : EditorTest {
    void TearDown() override {
        for (QMessageBox* box : window->findChildren<QMessageBox*>())
            box->done(QMessageBox::Cancel);
    }
    static void modify() {
        controller().setParameter(parameter("material.perceptualRoughness"),
                                  {Scope::Material, selectedMaterial().id}, 0.123f);
        ASSERT_TRUE(controller().isModified());
    }
    static QMessageBox* question() {
        for (QMessageBox* box : window->findChildren<QMessageBox*>())
            if (box->isVisible())
                return box;
        return nullptr;
    }
    static void answer(QMessageBox::StandardButton button) {
        ASSERT_NE(question(), nullptr);
        QTest::mouseClick(question()->button(button), Qt::LeftButton);
    }
    static void dropOnWindow(const QStringList& files) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& file : files)
            urls << QUrl::fromLocalFile(file);
        data.setUrls(urls);
        QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
    }
    QString saveProjectFile(const QString& name) {
        const QString file = folder.filePath(name);
        bool worked = false;
        controller().saveAs(file, [&](bool ok) { worked = ok; });
        EXPECT_TRUE(settled(*session));
        EXPECT_TRUE(worked);
        return file;
    }
    QString writeObj(const QString& name) {
        QFile file(folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        file.write("o Triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        return file.fileName();
    }
};

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

// --- Actions and accessibility -------------------------------------------------------------------

void collect(const QList<QAction*>& actions, QList<QAction*>& all) {
    for (QAction* action : actions) {
        if (action->isSeparator())
            continue;
        if (action->menu())
            collect(action->menu()->actions(), all);
        else
            all << action;
    }
}

QList<QAction*> everyAction(const MainWindow& window) {
    QList<QAction*> all;
    collect(window.menuBar()->actions(), all);
    for (const QToolBar* bar : window.findChildren<QToolBar*>())
        collect(bar->actions(), all);
    return all;
}

TEST_F(WindowTest, EveryActionSaysWhatItDoes) {
    const QList<QAction*> actions = everyAction(*window);
    EXPECT_GT(actions.size(), 25);
    for (const QAction* action : actions) {
        const std::string name = action->text().toStdString();
        EXPECT_FALSE(name.empty());
        EXPECT_GT(action->statusTip().size(), 3) << name;
        EXPECT_GT(action->toolTip().size(), 3) << name;
    }
}

TEST_F(WindowTest, NoShortcutIsTakenTwice) {
    std::map<QString, std::set<const QAction*>> owners;
    for (const QAction* action : everyAction(*window))
        for (const QKeySequence& keys : action->shortcuts())
            owners[keys.toString()].insert(action);
    EXPECT_GT(owners.size(), 12u);
    for (const auto& [keys, actions] : owners)
        EXPECT_EQ(actions.size(), 1u) << keys.toStdString();
}

TEST_F(WindowTest, NoMnemonicIsTakenTwiceInAMenu) {
    QList<QMenu*> menus;
    for (QAction* action : window->menuBar()->actions())
        menus << action->menu();
    for (const QMenu* menu : menus) {
        std::map<QChar, int> count;
        for (const QAction* action : menu->actions()) {
            const qsizetype at = action->text().indexOf(QLatin1Char('&'));
            if (at >= 0)
                ++count[action->text().at(at + 1).toLower()];
        }
        for (const auto& [letter, times] : count)
            EXPECT_EQ(times, 1) << menu->title().toStdString() << ' ' << char(letter.toLatin1());
    }
}

TEST_F(WindowTest, EveryControlHasAnAccessibleName) {
    for (const QDockWidget* dock : window->findChildren<QDockWidget*>()) {
        for (const QWidget* widget : dock->widget()->findChildren<QWidget*>()) {
            if (widget->objectName().startsWith(QLatin1String("qt_")))
                continue; // parts of a control, such as the editor of a spin box
            const auto* button = qobject_cast<const QAbstractButton*>(widget);
            const bool control = button || qobject_cast<const QComboBox*>(widget) ||
                                 qobject_cast<const QLineEdit*>(widget);
            const bool named =
                !widget->accessibleName().isEmpty() || (button && !button->text().isEmpty());
            EXPECT_TRUE(!control || named)
                << dock->objectName().toStdString() << ": " << widget->metaObject()->className()
                << ' ' << widget->toolTip().toStdString();
        }
    }
}

TEST_F(WindowTest, NoHeadingIsThereTwiceInADock) {
    int headings = 0;
    for (const QDockWidget* dock : window->findChildren<QDockWidget*>()) {
        std::set<QString> seen;
        for (const Section* section : dock->widget()->findChildren<Section*>()) {
            const QString title = section->findChild<QToolButton*>()->text();
            EXPECT_TRUE(seen.insert(title).second)
                << dock->objectName().toStdString() << ": " << title.toStdString();
            ++headings;
        }
    }
    EXPECT_GT(headings, 10);
}

TEST_F(WindowTest, LightingFollowsTheDocument) {
    Actions& actions = window->actions();
    EXPECT_TRUE(actions.lightingIbl->isChecked());
    EXPECT_FALSE(actions.lightingPrt->isEnabled()); // there is no transfer yet
    BakeArtifact bake;
    bake.kind = BakeKind::PrtVertex;
    bake.order = 3;
    for (const MeshInstance& mesh : document().meshes)
        bake.vertices.push_back(
            {mesh.id, 9, std::vector<float>(9 * mesh.mesh->vertexCount(), 0.1f)});
    controller().attachBake(std::make_shared<const BakeArtifact>(bake));
    EXPECT_TRUE(actions.lightingPrt->isEnabled());
    actions.lightingPrt->trigger();
    EXPECT_EQ(document().view.lighting, LightingMode::Prt);
    EXPECT_TRUE(actions.lightingPrt->isChecked());
    actions.undo->trigger();
    EXPECT_EQ(document().view.lighting, LightingMode::Ibl);
    EXPECT_TRUE(actions.lightingIbl->isChecked());
}

// --- Esc and the status bar ----------------------------------------------------------------------

TEST_F(WindowTest, EscLeadsOutWhereverTheFocusIs) {
    window->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
    auto* equation = window->findChild<EquationBar*>();
    ASSERT_NE(equation, nullptr);
    QAction* split = window->looks().split;
    QAction* fullScreen = window->actions().fullScreen;
    window->findChild<QDockWidget*>(QStringLiteral("log"))->show();
    auto* scene = window->findChild<QDockWidget*>(QStringLiteral("scene"));
    int kinds = 0;
    std::set<std::string> seen;
    for (const bool floating : {false, true}) {
        scene->setFloating(floating);
        test::handleEvents();
        seen.clear();
        for (QWidget* widget : window->findChildren<QWidget*>()) {
            if (!widget->isVisible() || !widget->isEnabled() || widget->visibleRegion().isEmpty() ||
                widget->focusPolicy() == Qt::NoFocus ||
                widget->window()->windowType() == Qt::Popup ||
                (floating && !scene->isAncestorOf(widget)) ||
                !seen.insert(widget->metaObject()->className()).second)
                continue;
            ++kinds;
            const std::string where = widget->metaObject()->className();
            const auto press = [&] {
                widget->window()->activateWindow();
                widget->setFocus();
                QTest::keyClick(widget, Qt::Key_Escape);
            };
            split->trigger();
            ASSERT_TRUE(split->isChecked());
            equation->open(shading::kViewSpecularIbl);
            press();
            EXPECT_FALSE(split->isChecked()) << where;
            press();
            EXPECT_EQ(equation->opened(), shading::kViewFinal) << where;
            if (split->isChecked())
                split->trigger();
            equation->close(0);
        }
    }
    scene->setFloating(false);
    EXPECT_GT(kinds, 8);
    window->viewport().setFocus();
    fullScreen->setChecked(true);
    ASSERT_TRUE(eventually([] { return window->isFullScreen(); }));
    window->findChild<QTreeView*>()->setFocus();
    QTest::keyClick(window->findChild<QTreeView*>(), Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return !window->isFullScreen(); }));
    EXPECT_FALSE(fullScreen->isChecked());
    window->resetLayout();
}

TEST_F(WindowTest, EscEndsWhatIsTypedFirst) {
    window->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
    QAction* split = window->looks().split;
    split->trigger();
    auto* field = find<NumberField>(*window, QStringLiteral("Roughness"));
    ASSERT_NE(field, nullptr);
    const double before = field->value();
    field->setFocus();
    QTest::keyClick(field, Qt::Key_Return);
    QTest::keyClicks(field, QStringLiteral("0.77"));
    QTest::keyClick(field, Qt::Key_Escape);
    EXPECT_TRUE(split->isChecked());
    EXPECT_EQ(field->value(), before);
    QTest::keyClick(field, Qt::Key_Escape);
    EXPECT_FALSE(split->isChecked());
}

TEST_F(WindowTest, TheStatusBarSaysRefinedAtRest) {
    auto* label = window->findChild<QLabel*>(QStringLiteral("frameTime"));
    ASSERT_NE(label, nullptr);
    ASSERT_TRUE(eventually([&] { return label->text() == QStringLiteral("Refined"); }))
        << label->text().toStdString();
    Camera camera = document().view.camera;
    camera.distance *= 1.1f;
    controller().setCamera(camera);
    window->viewport().resetCamera(); // as a key does: the next frames are drawn for speed
    EXPECT_TRUE(eventually([&] { return label->text().contains(QStringLiteral("fps")); }));
    EXPECT_TRUE(eventually([&] { return label->text() == QStringLiteral("Refined"); }));
}

TEST_F(WindowTest, LongHintsEndInAnEllipsis) {
    auto* bar = qobject_cast<MessageBar*>(window->statusBar());
    ASSERT_NE(bar, nullptr);
    const QString brief = QStringLiteral("Brightness"), word = QStringLiteral("candela ");
    QStatusTipEvent briefHint(brief);
    QCoreApplication::sendEvent(window.get(), &briefHint);
    EXPECT_EQ(bar->shownMessage(), brief);
    QStatusTipEvent longHint(word.repeated(200));
    QCoreApplication::sendEvent(window.get(), &longHint);
    EXPECT_TRUE(bar->shownMessage().startsWith(word));
    EXPECT_TRUE(bar->shownMessage().endsWith(QChar(0x2026)));
    const auto* frameTime = bar->findChild<QLabel*>(QStringLiteral("frameTime"));
    EXPECT_LT(bar->fontMetrics().horizontalAdvance(bar->shownMessage()), frameTime->x());
}

// --- Layout and pictures -------------------------------------------------------------------------

TEST_F(WindowTest, TheLayoutIsRememberedAndReset) {
    auto* log = window->findChild<QDockWidget*>(QStringLiteral("log"));
    auto* scene = window->findChild<QDockWidget*>(QStringLiteral("scene"));
    ASSERT_TRUE(log->isHidden());
    scene->hide();
    log->show();
    const QByteArray state = window->saveState(1);
    window->resetLayout();
    EXPECT_FALSE(scene->isHidden());
    EXPECT_TRUE(log->isHidden());
    ASSERT_TRUE(window->restoreState(state, 1));
    EXPECT_TRUE(scene->isHidden());
    EXPECT_FALSE(log->isHidden());
    EXPECT_FALSE(window->restoreState(state, 999)); // another version's layout is not for us
    window->resetLayout();
}

TEST_F(WindowTest, PicturesOfTheWindowAreKept) {
    const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS", folder.path());
    ASSERT_TRUE(QDir().mkpath(target));
    const auto keep = [&](QWidget* widget, const QString& name) {
        const QImage picture = widget->grab().toImage();
        EXPECT_FALSE(picture.isNull());
        EXPECT_TRUE(picture.save(QDir(target).filePath(name + QStringLiteral(".png"))));
    };
    controller().addLight(LightType::Directional);
    for (QDockWidget* dock : window->findChildren<QDockWidget*>()) {
        dock->show();
        dock->raise();
        test::handleEvents();
        keep(dock, QStringLiteral("dock-") + dock->objectName());
    }
    window->resetLayout();
    Q_EMIT controller().noticed(
        {NoticeKind::Warning,
         QStringLiteral("helmet.gltf refers to 2 files that are missing; a checkered placeholder "
                        "stands in for them."),
         {QStringLiteral("Missing: a.png"), QStringLiteral("Missing: b.png")}});
    test::handleEvents();
    keep(window.get(), QStringLiteral("window"));
    QDialog* shortcuts =
        makeShortcutsDialog(window->actions().all(), window->looks().listed(), window.get());
    shortcuts->show();
    test::handleEvents(); // the style's sizes arrive with events
    keep(shortcuts, QStringLiteral("shortcuts"));
    shortcuts->close();
    QDialog* about = makeAboutDialog(window.get());
    about->show();
    keep(about, QStringLiteral("about"));
    about->close();
}

} // namespace
} // namespace patina::editor
