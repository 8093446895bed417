// The window as a whole: actions, names, keys, layout, pictures of it.

#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "tests/app/editor/WindowFixture.h"
#include "tests/support/Events.h"

#include "app/editor/HelpDialogs.h"
#include "app/editor/ViewActions.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Section.h"
#include "core/edit/EditSession.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QStatusTipEvent>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <map>
#include <set>

namespace patina::editor {
namespace {

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
