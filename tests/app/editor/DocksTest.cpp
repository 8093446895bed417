// Docks: opened, tabbed, floated, left and found again, reached by mouse and keys.

#include "core/light/Light.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include "app/editor/ViewActions.h"
#include "app/editor/viewport/ViewThumb.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QTabBar>
#include <set>

namespace patina::editor {
namespace {

// What a button, a field or a tab must measure at least to be hit with a pen.
constexpr int kTarget = 20;

QAction* viewEntry(const MainWindow& window, const QString& name) {
    for (const QAction* menu : window.menuBar()->actions())
        for (QAction* entry : menu->menu()->actions())
            if (entry->iconText() == name && entry->isCheckable())
                return entry;
    return nullptr;
}

bool isSeen(const QDockWidget& dock) {
    return dock.isVisible() && !dock.visibleRegion().isEmpty();
}

QDockWidget* dockNamed(const MainWindow& window, const char* name) {
    return window.findChild<QDockWidget*>(QLatin1String(name));
}

struct Tab {
    QTabBar* bar = nullptr;
    int index = -1;
    [[nodiscard]] QPoint middle() const { return bar->tabRect(index).center(); }
};

Tab tabOf(const MainWindow& window, const QDockWidget& dock) {
    for (QTabBar* bar : window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
        for (int i = 0; bar->isVisible() && i < bar->count(); ++i)
            if (bar->tabText(i) == dock.windowTitle())
                return {bar, i};
    return {};
}

QRect onScreen(const QWidget& widget) {
    return {widget.mapToGlobal(QPoint(0, 0)), widget.size()};
}

QAbstractButton* titleButton(const QDockWidget& dock, const char* name) {
    return dock.findChild<QAbstractButton*>(QLatin1String(name));
}

struct DocksTest : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        window->resetLayout();
        test::handleEvents();
    }
    static QDockWidget* dock(const char* name) { return dockNamed(*window, name); }
    static QDockWidget* dockWithFocus() {
        for (QWidget* at = QApplication::focusWidget(); at; at = at->parentWidget())
            if (auto* found = qobject_cast<QDockWidget*>(at))
                return found;
        return nullptr;
    }
    static void openAll() {
        for (QDockWidget* each : window->findChildren<QDockWidget*>())
            each->show();
        test::handleEvents();
    }
    static void expectTabbedAgain(QDockWidget& dock) {
        dock.setFloating(false);
        ASSERT_TRUE(eventually([&] { return tabOf(*window, dock).bar != nullptr; }));
    }
};

TEST_F(DocksTest, AnEntryOfTheViewMenuRaisesADockBehindATabAndClosesTheOneInFront) {
    for (const char* name : {"lights", "view", "model", "bake"}) {
        QDockWidget* behind = dock(name);
        QAction* entry = viewEntry(*window, behind->windowTitle());
        ASSERT_NE(entry, nullptr) << name;
        ASSERT_FALSE(isSeen(*behind)) << name;
        EXPECT_FALSE(entry->isChecked()) << name << ": it is not seen";
        entry->trigger();
        EXPECT_TRUE(eventually([&] { return isSeen(*behind); })) << name;
        EXPECT_TRUE(entry->isChecked()) << name;
        entry->trigger();
        EXPECT_TRUE(eventually([&] { return behind->isHidden(); })) << name;
        EXPECT_FALSE(entry->isChecked()) << name;
        entry->trigger();
        EXPECT_TRUE(eventually([&] { return isSeen(*behind); })) << name;
    }
}

TEST_F(DocksTest, TheMenuOfTitlesDoesTheSame) {
    const std::unique_ptr<QMenu> menu(window->createPopupMenu());
    QDockWidget* lights = dock("lights");
    ASSERT_FALSE(isSeen(*lights));
    bool found = false;
    for (QAction* entry : menu->actions()) {
        if (entry->iconText() != lights->windowTitle())
            continue;
        found = true;
        entry->trigger();
    }
    EXPECT_TRUE(found);
    EXPECT_TRUE(eventually([&] { return isSeen(*lights); }));
}

TEST_F(DocksTest, ATickSaysWhichDocksAreSeen) {
    openAll();
    for (const QDockWidget* each : window->findChildren<QDockWidget*>()) {
        const QAction* entry = viewEntry(*window, each->windowTitle());
        ASSERT_NE(entry, nullptr) << each->objectName().toStdString();
        EXPECT_EQ(entry->isChecked(), isSeen(*each)) << each->objectName().toStdString();
        // Beside an icon the style draws no tick.
        EXPECT_TRUE(entry->icon().isNull() || !entry->isIconVisibleInMenu())
            << each->objectName().toStdString();
    }
}

TEST_F(DocksTest, ATabIsDoubleClickedToFloatAndComesBackToItsGroup) {
    for (const char* name : {"material", "bake"}) { // in front, behind
        QDockWidget* each = dock(name);
        const Tab tab = tabOf(*window, *each);
        ASSERT_NE(tab.bar, nullptr) << name;
        QTest::mouseDClick(tab.bar, Qt::LeftButton, {}, tab.middle());
        ASSERT_TRUE(eventually([&] { return each->isFloating() && isSeen(*each); })) << name;
        test::handleEvents();
        EXPECT_EQ(each->titleBarWidget(), nullptr) << name << ": it needs its title bar";
        expectTabbedAgain(*each);
    }
}

TEST_F(DocksTest, TheMenuOfATabFloatsAndCloses) {
    QDockWidget* bake = dock("bake");
    const auto choose = [&](const QString& entry) {
        const Tab tab = tabOf(*window, *bake);
        ASSERT_NE(tab.bar, nullptr);
        QContextMenuEvent request(QContextMenuEvent::Mouse, tab.middle(),
                                  tab.bar->mapToGlobal(tab.middle()));
        QApplication::sendEvent(tab.bar, &request);
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        ASSERT_NE(menu, nullptr);
        for (QAction* action : menu->actions())
            if (action->iconText() == entry)
                action->trigger();
        menu->close();
    };
    choose(QStringLiteral("Float"));
    EXPECT_TRUE(eventually([&] { return bake->isFloating(); }));
    expectTabbedAgain(*bake);
    choose(QStringLiteral("Close"));
    EXPECT_TRUE(eventually([&] { return bake->isHidden(); }));
}

TEST_F(DocksTest, ATabIsDraggedOffItsBar) {
    QDockWidget* model = dock("model");
    const Tab tab = tabOf(*window, *model);
    ASSERT_NE(tab.bar, nullptr);
    const QPoint from = tab.middle(), to = from + QPoint(-260, 220);
    QTest::mousePress(tab.bar, Qt::LeftButton, {}, from);
    for (const double part : {0.1, 0.4, 0.7, 1.0}) {
        const QPoint at = from + part * (to - from);
        QMouseEvent move(QEvent::MouseMove, at, tab.bar->mapToGlobal(at), Qt::NoButton,
                         Qt::LeftButton, {});
        if (!model->isFloating())
            QApplication::sendEvent(tab.bar, &move);
    }
    ASSERT_TRUE(model->isFloating());
    // The dock hangs on the pointer now, and docks where it is let go: here, nowhere.
    const QPoint before = model->pos();
    const QPoint pointer = before + QPoint(60, 12);
    for (const QPoint& step : {QPoint(30, 20), QPoint(60, 40)}) {
        QMouseEvent move(QEvent::MouseMove, pointer + step - model->pos(), pointer + step,
                         Qt::NoButton, Qt::LeftButton, {});
        QApplication::sendEvent(model, &move);
    }
    EXPECT_NE(model->pos(), before);
    const QPoint end = pointer + QPoint(60, 40);
    QMouseEvent release(QEvent::MouseButtonRelease, end - model->pos(), end, Qt::LeftButton,
                        Qt::NoButton, {});
    QApplication::sendEvent(model, &release);
    test::handleEvents();
    EXPECT_EQ(QWidget::mouseGrabber(), nullptr);
    EXPECT_TRUE(isSeen(*model));
    expectTabbedAgain(*model);
}

TEST_F(DocksTest, AFloatedDockKeepsClearOfItsNeighbours) {
    for (const char* name : {"scene", "log"}) {
        QDockWidget* each = dock(name);
        each->show();
        test::handleEvents();
        if (const Tab tab = tabOf(*window, *each); tab.bar)
            QTest::mouseDClick(tab.bar, Qt::LeftButton, {}, tab.middle());
        else
            QTest::mouseClick(titleButton(*each, "qt_dockwidget_floatbutton"), Qt::LeftButton);
        ASSERT_TRUE(eventually([&] { return each->isFloating(); })) << name;
        test::handleEvents();
        const QRect floating = onScreen(*each);
        EXPECT_TRUE(window->screen()->availableGeometry().contains(floating)) << name;
        for (const QDockWidget* other : window->findChildren<QDockWidget*>())
            if (other != each && !other->isFloating() && isSeen(*other)) {
                EXPECT_FALSE(floating.intersects(onScreen(*other)))
                    << name << " covers " << other->objectName().toStdString();
            }
        for (const QTabBar* bar :
             window->findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
            if (bar->isVisible()) {
                EXPECT_FALSE(floating.intersects(onScreen(*bar))) << name;
            }
    }
}

TEST_F(DocksTest, KeysLeadFromDockToDockAndBack) {
    window->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
    window->viewport().setFocus();
    std::vector<QString> forwards, backwards;
    const auto press = [&](std::vector<QString>& way, Qt::Key key, Qt::KeyboardModifiers keys) {
        QTest::keyClick(window.get(), key, keys);
        test::handleEvents();
        const QDockWidget* at = dockWithFocus();
        EXPECT_TRUE(at == nullptr || isSeen(*at));
        way.push_back(at ? at->objectName() : QStringLiteral("viewport"));
    };
    std::set<QString> open;
    for (const QDockWidget* each : window->findChildren<QDockWidget*>())
        if (!each->isHidden())
            open.insert(each->objectName());
    for (std::size_t i = 0; i <= open.size(); ++i)
        press(forwards, Qt::Key_Tab, Qt::ControlModifier);
    EXPECT_EQ(forwards.back(), QStringLiteral("viewport")); // all the way round
    EXPECT_TRUE(window->viewport().hasFocus());
    std::set<QString> reached(forwards.begin(), forwards.end());
    reached.erase(QStringLiteral("viewport"));
    EXPECT_EQ(reached, open);
    for (std::size_t i = 0; i <= open.size(); ++i)
        press(backwards, Qt::Key_Backtab, Qt::ControlModifier | Qt::ShiftModifier);
    forwards.pop_back();
    backwards.pop_back();
    EXPECT_EQ(std::vector<QString>(forwards.rbegin(), forwards.rend()), backwards);
}

TEST_F(DocksTest, EveryDockHasAKey) {
    for (const QDockWidget* each : window->findChildren<QDockWidget*>()) {
        const QAction* entry = viewEntry(*window, each->windowTitle());
        ASSERT_NE(entry, nullptr) << each->objectName().toStdString();
        EXPECT_FALSE(entry->shortcut().isEmpty()) << each->objectName().toStdString();
    }
}

// --- The next session --------------------------------------------------------------------------

// How much of the screen where `widget` is shows just that widget.
double partOnTop(QWidget& widget) {
    const QRect at = onScreen(widget);
    const QImage seen = widget.screen()
                            ->grabWindow(0, at.x(), at.y(), at.width(), at.height())
                            .toImage()
                            .convertToFormat(QImage::Format_RGB32);
    const QImage own = widget.grab().toImage().convertToFormat(QImage::Format_RGB32);
    if (seen.size() != own.size())
        return 0.0;
    int equal = 0;
    for (int y = 0; y < own.height(); ++y)
        for (int x = 0; x < own.width(); ++x)
            equal += seen.pixel(x, y) == own.pixel(x, y);
    return static_cast<double>(equal) / (own.width() * own.height());
}

// On the start scene, with the layout that the session before left.
struct BegunSession {
    BegunSession() {
        window.restoreLayout();
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window, 60'000));
        session.controller.newDocument();
        EXPECT_TRUE(settled(session));
    }
    Session session;
    MainWindow window{session};
};

// After a start that died: the docks of the first layout stay as they were left.
TEST(DocksOfTheNextSession, ThoseThatWereOpenedCanBeLeftOut) {
    QApplication::setQuitOnLastWindowClosed(false);
    {
        BegunSession begun;
        dockNamed(begun.window, "scene")->setFloating(true);
        dockNamed(begun.window, "library")->show();
        dockNamed(begun.window, "log")->setFloating(true);
        dockNamed(begun.window, "log")->show();
        test::handleEvents();
        begun.window.close();
        test::handleEvents();
    }
    Session session;
    MainWindow window(session);
    window.restoreLayout();
    EXPECT_EQ(window.closeOpenedDocks(),
              (QStringList{dockNamed(window, "log")->windowTitle(),
                           dockNamed(window, "library")->windowTitle()}));
    EXPECT_TRUE(window.closeOpenedDocks().isEmpty());
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window, 60'000));
    test::handleEvents();
    EXPECT_TRUE(dockNamed(window, "library")->isHidden());
    EXPECT_TRUE(dockNamed(window, "log")->isHidden());
    EXPECT_TRUE(dockNamed(window, "scene")->isFloating());
    EXPECT_TRUE(dockNamed(window, "scene")->isVisible());
    QSettings().remove(QStringLiteral("window"));
}

TEST(DocksOfTheNextSession, AFloatingDockIsWhereItWasAndInFront) {
    QApplication::setQuitOnLastWindowClosed(false);
    QRect left;
    {
        BegunSession begun;
        MainWindow& window = begun.window;
        QDockWidget* scene = dockNamed(window, "scene");
        scene->setFloating(true);
        test::handleEvents();
        const QRect middle = onScreen(*window.centralWidget());
        scene->setGeometry(middle.x() + 60, middle.y() + 50, 280, 260);
        left = scene->geometry();
        window.close();
        ASSERT_TRUE(eventually([&] { return !window.isVisible(); }));
    }
    {
        BegunSession begun;
        MainWindow& window = begun.window;
        QDockWidget* scene = dockNamed(window, "scene");
        ASSERT_TRUE(eventually([&] { return scene->isVisible(); }));
        EXPECT_TRUE(scene->isFloating());
        EXPECT_EQ(scene->geometry(), left);
        EXPECT_TRUE(eventually([&] { return partOnTop(*scene) > 0.95; }))
            << "the window covers it: " << partOnTop(*scene);
        EXPECT_TRUE(viewEntry(window, QStringLiteral("Scene"))->isChecked());
    }
    QSettings().remove(QStringLiteral("window"));
}

// --- Seen and hit ------------------------------------------------------------------------------

TEST_F(DocksTest, TheFocusRingIsNotTheMarkOfTheCurrentItem) {
    ViewThumb thumb(shading::kViewBaseColor);
    thumb.resize(thumb.sizeHint());
    thumb.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&thumb, 30'000));
    thumb.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&thumb, 30'000));
    const auto picture = [&](bool current, bool focus) {
        thumb.setCurrent(current, false);
        if (focus)
            thumb.setFocus();
        else
            thumb.clearFocus();
        return thumb.grab(QRect(QPoint(0, 0), ViewThumb::kPicture + QSize(4, 4))).toImage();
    };
    const QImage none = picture(false, false), current = picture(true, false),
                 focus = picture(false, true), both = picture(true, true);
    // Pixels that any two of the four states tell apart.
    const auto differing = [](const QImage& a, const QImage& b) {
        int count = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                count += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 40;
        return count;
    };
    EXPECT_GT(differing(none, focus), 200);
    EXPECT_GT(differing(none, current), 200);
    EXPECT_GT(differing(current, focus), 200);
    EXPECT_GT(differing(current, both), 200);
    EXPECT_GT(differing(focus, both), 200);
}

void expectTargets(QWidget& parent, const std::string& where) {
    for (const QWidget* widget : parent.findChildren<QWidget*>()) {
        if (!widget->isVisible() || widget->visibleRegion().isEmpty())
            continue;
        const bool target = qobject_cast<const QAbstractButton*>(widget) ||
                            qobject_cast<const QComboBox*>(widget) ||
                            qobject_cast<const QLineEdit*>(widget) ||
                            widget->inherits("patina::editor::Slider");
        if (!target || widget->objectName().startsWith(QLatin1String("qt_spinbox")))
            continue;
        EXPECT_GE(std::min(widget->width(), widget->height()), kTarget)
            << where << ": " << widget->metaObject()->className() << ' '
            << widget->objectName().toStdString() << " \"" << widget->accessibleName().toStdString()
            << '"';
    }
    for (const QTabBar* bar : parent.findChildren<QTabBar*>())
        for (int i = 0; bar->isVisible() && i < bar->count(); ++i)
            EXPECT_GE(std::min(bar->tabRect(i).width(), bar->tabRect(i).height()), kTarget)
                << where << ": tab " << bar->tabText(i).toStdString();
    for (QAbstractItemView* view : parent.findChildren<QAbstractItemView*>()) {
        const QModelIndex first = view->model() ? view->model()->index(0, 0) : QModelIndex();
        // Headers have sections and no rows.
        if (view->isVisible() && first.isValid() && !view->visualRect(first).isEmpty()) {
            EXPECT_GE(view->visualRect(first).height(), kTarget)
                << where << ": rows of " << view->accessibleName().toStdString();
        }
    }
}

TEST_F(DocksTest, NothingToHitIsUnderTwentyPixels) {
    controller().addLight(LightType::Directional);
    controller().addLight(LightType::Rectangle);
    openAll();
    for (QDockWidget* each : window->findChildren<QDockWidget*>()) {
        each->raise();
        test::handleEvents();
        expectTargets(*each, each->objectName().toStdString());
    }
    window->looks().equation->setChecked(true);
    test::handleEvents();
    expectTargets(*window->centralWidget(), "centre");
    expectTargets(*window, "window");
    window->looks().equation->setChecked(false);
}

} // namespace
} // namespace patina::editor
