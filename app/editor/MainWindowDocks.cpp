// The part of MainWindow that makes its docks and remembers their layout.
#include "app/editor/MainWindow.h"

#include "app/editor/Actions.h"
#include "app/editor/Docks.h"
#include "app/editor/Session.h"
#include "app/editor/document/SelectionCommands.h"
#include "app/editor/ladder/LadderPanel.h"
#include "app/editor/library/LibraryPanel.h"
#include "app/editor/panel/BakePanel.h"
#include "app/editor/panel/BrdfLensPanel.h"
#include "app/editor/panel/EnergyPanel.h"
#include "app/editor/panel/EnvironmentPanel.h"
#include "app/editor/panel/HistoryPanel.h"
#include "app/editor/panel/JobsPanel.h"
#include "app/editor/panel/LightLabPanel.h"
#include "app/editor/panel/LightsPanel.h"
#include "app/editor/panel/LogPanel.h"
#include "app/editor/panel/MaterialPanel.h"
#include "app/editor/panel/MixerPanel.h"
#include "app/editor/panel/ModelPanel.h"
#include "app/editor/panel/PixelPanel.h"
#include "app/editor/panel/ScenePanel.h"
#include "app/editor/panel/SnapshotsPanel.h"
#include "app/editor/panel/TransferPanel.h"
#include "app/editor/panel/ViewPanel.h"
#include "app/editor/radiosity/ElementOverlay.h"
#include "app/editor/radiosity/RadiosityPanel.h"
#include "app/editor/sweep/LightSweepPanel.h"
#include "app/editor/trace/RayTreeOverlay.h"
#include "app/editor/trace/RayTreePanel.h"
#include "app/editor/trace/WhittedHeatOverlay.h"
#include "app/editor/viewport/ViewOverlay.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/light/Light.h"

#include <QDockWidget>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <QTreeView>
#include <QTreeWidget>

namespace patina::editor {
namespace {

constexpr QSize kComfortable(1440, 900);
constexpr int kFrameHeight = 60;   // more than a title bar needs; what it is is known too late
constexpr int kLayoutVersion = 11; // raise when docks come or go: older layouts are ignored

} // namespace

void MainWindow::makeDocks() {
    const Actions& a = *m_actions;
    DocumentController& controller = m_session.controller;
    auto* scene = new ScenePanel(controller, m_session.selection, m_session.thumbnails, a);
    connect(scene, &ScenePanel::frameRequested, m_viewport, &ViewportWidget::frameSelection);
    m_docks->add(a.sceneDock, QStringLiteral("scene"), scene);
    m_docks->add(a.materialDock, QStringLiteral("material"),
                 new MaterialPanel(controller, m_session.selection, m_session.thumbnails));
    auto* environment = new EnvironmentPanel(controller, m_session.thumbnails);
    connect(environment, &EnvironmentPanel::saveRequested, a.saveEnvironment, &QAction::trigger);
    m_docks->add(a.environmentDock, QStringLiteral("environment"), environment);
    auto* lights = new LightsPanel(controller, m_session.selection, m_session.thumbnails);
    m_docks->add(a.lightsDock, QStringLiteral("lights"), lights);
    new SelectionCommands(controller, m_session.selection, a, *m_viewport,
                          {scene->tree(), lights->list()}, this);
    auto* view = new ViewPanel(controller, m_session.displays, m_session.thumbnails);
    connect(m_viewport, &ViewportWidget::luminanceMeasured, view, &ViewPanel::setLuminance);
    connect(m_docks->add(a.viewDock, QStringLiteral("view"), view), &QDockWidget::visibilityChanged,
            m_viewport, &ViewportWidget::setLuminanceWanted);
    auto* bake = new BakePanel(controller, m_session.bakes, m_session.jobs);
    m_docks->add(a.bakeDock, QStringLiteral("bake"), bake);
    connect(m_overlay, &ViewOverlay::remedyWanted, this, [&controller, bake](ViewRemedy remedy) {
        if (remedy == ViewRemedy::AddLight)
            controller.addLight(LightType::Directional);
        else
            bake->bakeTransfer(remedy == ViewRemedy::BakeBounces);
    });
    m_docks->add(a.modelDock, QStringLiteral("model"),
                 new ModelPanel(controller, m_session.selection, m_session.thumbnails));
    m_docks->add(a.jobsDock, QStringLiteral("jobs"), new JobsPanel(m_session.jobs));
    m_docks->add(a.logDock, QStringLiteral("log"), new LogPanel);
    m_docks->add(a.historyDock, QStringLiteral("history"),
                 new HistoryPanel(controller, *m_viewport, m_session.wall));
    auto* snapshots = new SnapshotsPanel(controller, *m_viewport, m_session.wall);
    connect(a.keepSnapshot, &QAction::triggered, snapshots, &SnapshotsPanel::keep);
    m_docks->add(a.snapshotsDock, QStringLiteral("snapshots"), snapshots);
    m_docks->addInstrument(a.pixel, QStringLiteral("pixel"),
                           new PixelPanel(controller, m_session.probe, m_viewport->picker()));
    auto* lightLab = new LightLabPanel(controller, m_session.ibl, m_session.probe);
    connect(m_viewport, &ViewportWidget::luminanceMeasured, lightLab, &LightLabPanel::setLuminance);
    connect(m_docks->addInstrument(a.lightLab, QStringLiteral("lightLab"), lightLab),
            &QDockWidget::visibilityChanged, lightLab, &LightLabPanel::setSeen);
    m_docks->addInstrument(
        a.lens, QStringLiteral("lens"),
        new BrdfLensPanel(controller, m_session.selection, m_session.probe, m_session.lobe));
    m_docks->addInstrument(a.energy, QStringLiteral("energy"),
                           new EnergyPanel(controller, m_session.selection, m_session.views));
    m_docks->addInstrument(a.mixer, QStringLiteral("mixer"), new MixerPanel(controller));
    auto* transfer =
        new TransferPanel(controller, m_session.probe, m_session.lobe, m_session.nearShadows);
    connect(transfer, &TransferPanel::bakeWanted, bake, [bake] { bake->bakeTransfer(false); });
    m_docks->addInstrument(a.transfer, QStringLiteral("transfer"), transfer);
    m_docks->addInstrument(a.lightSweep, QStringLiteral("lightSweep"),
                           new LightSweepPanel(controller, m_session.jobs, *m_viewport));
    new WhittedHeatOverlay(m_session.heat, controller, *m_viewport);
    new RayTreeOverlay(m_session.rayTree, controller, *m_viewport);
    auto* rays = new RayTreePanel(m_session.rayTree, m_session.paths, controller);
    // Rays and methods are looked at in one picture.
    connect(rays, &RayTreePanel::pictureWanted, a.whitted, [this, whitted = a.whitted] {
        m_session.wall.setOn(false);
        whitted->trigger();
    });
    m_docks->addInstrument(a.rayTree, QStringLiteral("rayTree"), rays);
    auto* element = new ElementOverlay(m_session.radiosity, controller, *m_viewport);
    m_docks->addInstrument(a.radiosity, QStringLiteral("radiosity"),
                           new RadiosityPanel(m_session, *element));
    auto* ladder = new LadderPanel(m_session, *m_viewport);
    connect(ladder, &LadderPanel::pathTracingWanted, a.pathTraced, [this, path = a.pathTraced] {
        m_session.wall.setOn(false);
        if (!path->isChecked())
            path->trigger();
    });
    m_docks->addInstrument(a.ladder, QStringLiteral("ladder"), ladder);
    m_docks->addInstrument(a.library, QStringLiteral("library"),
                           new LibraryPanel(m_session.library, m_session.preview));
    m_docks->reset();
}

// Of the menu bar and the titles of docks. Qt's own would close docks that are behind a tab.
QMenu* MainWindow::createPopupMenu() {
    auto* menu = new QMenu(this);
    menu->addActions(m_actions->docks());
    menu->addSeparator();
    menu->addActions(m_actions->instruments());
    return menu;
}

QSize MainWindow::firstSize(const QSize& available) {
    return kComfortable.boundedTo(available - QSize(0, kFrameHeight));
}

void MainWindow::restoreLayout() {
    QSettings settings;
    // Small screens, and scaled ones, which are small in device-independent pixels, are filled.
    const QSize available = screen()->availableSize();
    resize(firstSize(available));
    if (firstSize(available) != kComfortable)
        setWindowState(windowState() | Qt::WindowMaximized);
    if (!restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray()) ||
        !m_docks->restore(settings.value(QStringLiteral("window/state")).toByteArray(),
                          kLayoutVersion))
        m_docks->reset();
}

QStringList MainWindow::closeOpenedDocks() {
    return m_docks->closeOpened();
}

void MainWindow::resetLayout() {
    m_docks->reset();
}

void MainWindow::saveLayout() const {
    QSettings settings;
    settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
    settings.setValue(QStringLiteral("window/state"), saveState(kLayoutVersion));
}

} // namespace patina::editor
