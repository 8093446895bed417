// Everything fits on every screen: sizes of the window, texts in docks and dialogs.
// PATINA_SCREENSHOTS keeps a picture of each.

#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/TextFit.h"
#include "tests/support/Events.h"

#include "app/editor/EnvironmentSaveDialog.h"
#include "app/editor/ExportDialog.h"
#include "app/editor/HelpDialogs.h"
#include "app/editor/ViewActions.h"
#include "app/editor/bracket/BracketDialog.h"
#include "app/editor/memory/MemoryDialog.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/viewport/ViewStrip.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"

#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QScreen>
#include <QStatusBar>

namespace patina::editor {
namespace {

// Screens in device-independent pixels, less the title bar and a panel: 1366×768, 1920×1080,
// 1920×1080 at scale 1.5, 2880×1800 at scale 2.
struct Screen {
    const char* name;
    QSize size;
};
constexpr int kTaken = 60; // height of title bar and panel
const Screen kScreens[] = {{"1366x768", {1366, 768 - kTaken}},
                           {"1920x1080", {1920, 1080 - kTaken}},
                           {"1920x1080@1.5", {1280, 720 - kTaken}},
                           {"2880x1800@2", {1440, 900 - kTaken}}};

struct LayoutTest : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        window->resetLayout();
        const QString longName =
            QStringLiteral("Weathered copper of the harbour master's roof, v%1");
        controller().addLight(LightType::Rectangle);
        controller().addLight(LightType::Spot);
        controller().editStructure(QStringLiteral("Long names"), [&](Document& document) {
            int number = 100;
            for (Material& material : document.materials)
                material.name = longName.arg(++number).toStdString();
            for (MeshInstance& mesh : document.meshes)
                mesh.name = longName.arg(++number).toStdString();
            for (Light& light : document.lights)
                light.name = longName.arg(++number).toStdString();
        });
        controller().setMap(parameter("material.baseColor.map"),
                            {Scope::Material, selectedMaterial().id}, picture(2048, 1024));
        controller().setMap(parameter("material.metallic.map"),
                            {Scope::Material, selectedMaterial().id}, picture(1024, 1024));
        ASSERT_TRUE(settled(*session));
    }
    QString picture(int width, int height) {
        QImage image(width, height, QImage::Format_RGB32);
        image.fill(Qt::darkCyan);
        const QString file = folder.filePath(
            QStringLiteral("harbour_roof_weathered_copper_%1x%2.png").arg(width).arg(height));
        EXPECT_TRUE(image.save(file));
        return file;
    }
    static void keep(QWidget& widget, const QString& name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (target.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(target));
        constexpr int kFast = 80; // zlib's level 1
        ASSERT_TRUE(
            widget.grab().save(QDir(target).filePath(name + QStringLiteral(".png")), "PNG", kFast));
    }
    static void resizeTo(const QSize& size) {
        window->resize(size);
        ASSERT_TRUE(eventually([&] { return window->size() == size; }))
            << window->width() << "x" << window->height() << ", at least "
            << window->minimumSizeHint().width() << "x" << window->minimumSizeHint().height();
        test::handleEvents();
    }
    static void expectNothingCut(const QWidget& widget, const std::string& where) {
        for (const QString& text : cutTexts(widget))
            ADD_FAILURE() << where << ": " << text.toStdString();
    }
};

TEST_F(LayoutTest, EveryDockFitsEveryScreen) {
    for (const Screen& screen : kScreens) {
        window->viewport().setUpdatesEnabled(false); // 14 pictures of the scene that nobody sees
        resizeTo(screen.size);
        for (QDockWidget* dock : window->findChildren<QDockWidget*>()) {
            const bool wasHidden = dock->isHidden();
            dock->show();
            dock->raise();
            test::handleEvents();
            const std::string where = screen.name + (" " + dock->objectName().toStdString());
            EXPECT_EQ(window->size(), screen.size) << where << ": the window has grown";
            expectNothingCut(*dock, where);
            keep(*dock, QLatin1String(screen.name) + QStringLiteral("-dock-") + dock->objectName());
            if (wasHidden)
                dock->hide();
        }
        window->viewport().setUpdatesEnabled(true);
        // Bars under the picture, open both.
        window->looks().equation->setChecked(true);
        window->looks().strip->setChecked(true);
        test::handleEvents();
        EXPECT_EQ(window->size(), screen.size) << screen.name << " with both bars";
        expectNothingCut(*window, screen.name);
        keep(*window, QLatin1String(screen.name) + QStringLiteral("-window"));
        // And an instrument below them.
        window->actions().pixel->trigger();
        test::handleEvents();
        EXPECT_EQ(window->size(), screen.size) << screen.name << " with bars and an instrument";
        EXPECT_GE(window->viewport().height(), 136) << screen.name;
        keep(*window, QLatin1String(screen.name) + QStringLiteral("-all"));
        window->actions().pixel->trigger();
        window->looks().equation->setChecked(false);
        test::handleEvents();
    }
}

// The picture does not move because something was selected: docks are as wide as what they may
// show.
TEST_F(LayoutTest, DocksKeepTheirWidth) {
    window->viewport().setUpdatesEnabled(false);
    resizeTo(kScreens[0].size);
    const auto docks = [] {
        QString text;
        for (QDockWidget* dock : window->findChildren<QDockWidget*>())
            if (dock->isVisible() && !dock->isFloating())
                text += QStringLiteral("%1 %2; ").arg(dock->objectName()).arg(dock->width());
        return text;
    };
    const auto dockNamed = [](const char* name) {
        auto* dock = window->findChild<QDockWidget*>(QLatin1String(name));
        EXPECT_NE(dock, nullptr) << name;
        return dock;
    };
    const int left = window->viewport().mapTo(window.get(), QPoint(0, 0)).x();
    const int width = window->viewport().width();
    const auto expectStill = [&](const std::string& after) {
        test::handleEvents();
        EXPECT_EQ(window->viewport().mapTo(window.get(), QPoint(0, 0)).x(), left)
            << after << ": " << docks().toStdString();
        EXPECT_EQ(window->viewport().width(), width) << after << ": " << docks().toStdString();
    };
    for (QDockWidget* dock : window->findChildren<QDockWidget*>())
        if (dock->isVisible() && !dock->isFloating() &&
            !window->tabifiedDockWidgets(dock).isEmpty()) {
            for (QDockWidget* other : window->tabifiedDockWidgets(dock)) {
                other->raise();
                expectStill("raised " + other->objectName().toStdString());
            }
        }
    dockNamed("lights")->raise();
    for (const Light& light : document().lights) {
        session->selection.selectLight(light.id);
        expectStill("selected a light");
    }
    dockNamed("environment")->raise();
    for (const EnvironmentKind kind :
         {EnvironmentKind::Sky, EnvironmentKind::Softboxes, EnvironmentKind::Image}) {
        controller().setEnvironmentKind(kind);
        ASSERT_TRUE(settled(*session));
        expectStill("another kind of environment");
    }
    for (const MeshInstance& mesh : document().meshes) {
        session->selection.selectMesh(mesh.id);
        expectStill("selected a mesh");
    }
    for (const Material& material : document().materials) {
        session->selection.selectMaterial(material.id);
        expectStill("selected a material");
    }
    window->viewport().setUpdatesEnabled(true);
}

// Below the steps it was cut off, and had to be scrolled to.
TEST_F(LayoutTest, TheRadiosityDockOpensWithItsWholePlot) {
    window->viewport().setUpdatesEnabled(false);
    resizeTo(kScreens[1].size);
    window->actions().radiosity->trigger();
    test::handleEvents();
    const auto* plot = window->findChild<QWidget*>(QStringLiteral("radiosityPlot"));
    ASSERT_NE(plot, nullptr);
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return plot->visibleRegion().boundingRect() == plot->rect(); }, 9000))
        << plot->visibleRegion().boundingRect().height() << " of " << plot->height() << ", dock "
        << window->findChild<QDockWidget*>(QStringLiteral("radiosity"))->height();
    EXPECT_GE(plot->height(), 80);
    EXPECT_GE(plot->width(), 250);
    keep(*window, QStringLiteral("1920x1080-radiosity"));
    window->actions().radiosity->trigger();
    window->viewport().setUpdatesEnabled(true);
}

TEST_F(LayoutTest, EveryDialogFitsEveryScreen) {
    window->viewport().setUpdatesEnabled(false); // it is not in these pictures
    for (const Screen& screen : kScreens) {
        resizeTo(screen.size);
        const auto check = [&](QDialog* dialog, const char* name) {
            dialog->show();
            test::handleEvents();
            const std::string where = screen.name + std::string(" ") + name;
            EXPECT_LE(dialog->width(), screen.size.width()) << where;
            EXPECT_LE(dialog->height(), screen.size.height()) << where;
            expectNothingCut(*dialog, where);
            keep(*dialog,
                 QLatin1String(screen.name) + QStringLiteral("-dialog-") + QLatin1String(name));
            delete dialog;
        };
        check(new ExportDialog(controller(), session->jobs, window.get()), "export");
        check(makeMemoryDialog(session->memory, window.get()), "memory");
        check(new EnvironmentSaveDialog(controller(), session->jobs, window.get()), "environment");
        check(new BracketDialog(controller(), session->jobs,
                                {QStringLiteral("/nowhere/IMG_4100.jpg"),
                                 QStringLiteral("/nowhere/IMG_4101.jpg")},
                                window.get()),
              "bracket");
        check(makeShortcutsDialog(window->actions().all(), window->looks().listed(), window.get()),
              "shortcuts");
        check(makeAboutDialog(window.get()), "about");
    }
    window->viewport().setUpdatesEnabled(true);
}

TEST_F(LayoutTest, TheFirstWindowLeavesRoomForItsFrame) {
    for (const Screen& screen : kScreens) {
        const QSize available = screen.size + QSize(0, kTaken);
        const QSize first = MainWindow::firstSize(available);
        EXPECT_LE(first.width(), available.width()) << screen.name;
        EXPECT_LE(first.height(), available.height() - kTaken) << screen.name;
    }
}

} // namespace
} // namespace patina::editor
