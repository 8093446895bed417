// The part of MainWindow that connects actions, the session and what the window shows of them.
#include "app/editor/MainWindow.h"

#include "app/editor/Actions.h"
#include "app/editor/ActivityStatus.h"
#include "app/editor/Docks.h"
#include "app/editor/FileFlow.h"
#include "app/editor/HelpDialogs.h"
#include "app/editor/Session.h"
#include "app/editor/ViewActions.h"
#include "app/editor/library/LibraryPanel.h"
#include "app/editor/library/PreviewBadge.h"
#include "app/editor/memory/MemoryDialog.h"
#include "app/editor/radiosity/RadiosityExportDialog.h"
#include "app/editor/turntable/TurntableDialog.h"
#include "app/editor/viewport/FocusPicker.h"
#include "app/editor/viewport/SceneProgress.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/document/ViewChoices.h"

#include <QLabel>

namespace patina::editor {

void MainWindow::connectActions() {
    Actions& a = *m_actions;
    DocumentController& controller = m_session.controller;
    connect(a.newScene, &QAction::triggered, m_files, &FileFlow::newScene);
    connect(a.open, &QAction::triggered, m_files, &FileFlow::openWithDialog);
    connect(a.addModel, &QAction::triggered, m_files, &FileFlow::addModelWithDialog);
    connect(a.makeHdr, &QAction::triggered, m_files, &FileFlow::makeHdrWithDialog);
    connect(a.save, &QAction::triggered, m_files, qOverload<>(&FileFlow::save));
    connect(a.saveAs, &QAction::triggered, m_files, qOverload<>(&FileFlow::saveAs));
    connect(a.exportScene, &QAction::triggered, this, &MainWindow::openExportDialog);
    connect(a.exportRadiosity, &QAction::triggered, this, [this] {
        auto* dialog = new RadiosityExportDialog(m_session.controller, m_session.radiosity,
                                                 m_session.jobs, this);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->open();
    });
    const auto enableRadiosity = [this] {
        m_actions->exportRadiosity->setEnabled(m_session.radiosity.live() != nullptr);
    };
    connect(&m_session.radiosity, &RadiosityUpdater::shownChanged, this, enableRadiosity);
    connect(&m_session.radiosity, &RadiosityUpdater::changed, this, enableRadiosity);
    enableRadiosity();
    connect(a.exportTurntable, &QAction::triggered, this,
            [this] { TurntableDialog::open(m_session, *m_viewport, this); });
    connect(a.saveEnvironment, &QAction::triggered, this, &MainWindow::openEnvironmentSaveDialog);
    connect(a.quit, &QAction::triggered, this, &QWidget::close);
    connect(a.frame, &QAction::triggered, m_viewport, &ViewportWidget::frameSelection);
    connect(a.home, &QAction::triggered, m_viewport, &ViewportWidget::resetCamera);
    connect(a.placeHandles, &QAction::toggled, m_viewport, &ViewportWidget::setMeshHandlesOn);
    connect(a.overlays, &QAction::toggled, m_viewport, &ViewportWidget::setOverlaysVisible);
    connect(a.wall, &QAction::triggered, &m_session.wall, &WallState::setOn);
    connect(&m_session.wall, &WallState::changed, this, [this] {
        m_actions->wall->setChecked(m_session.wall.isOn());
        if (m_session.wall.isOn() && m_session.views.settings().split)
            m_session.views.toggleSplit(); // cells show one view each
        if (m_session.wall.isOn())
            m_session.paths.setOn(false); // the viewport draws it
    });
    connectTracers();
    const auto lighting = [this](LightingMode mode) {
        m_session.controller.setParameter(parameter("view.lighting"), {Scope::View, 0},
                                          static_cast<int>(mode));
        refreshView();
    };
    connect(a.lightingIbl, &QAction::triggered, this, [=] { lighting(LightingMode::Ibl); });
    connect(a.lightingPrt, &QAction::triggered, this, [=] { lighting(LightingMode::Prt); });
    connect(a.lightingRadiosity, &QAction::triggered, this,
            [=] { lighting(LightingMode::Radiosity); });
    const auto showEnvironment = [this] {
        m_actions->environmentOn->setChecked(m_session.controller.document().environment().enabled);
    };
    connect(a.environmentOn, &QAction::triggered, this, [this, showEnvironment](bool on) {
        m_session.controller.setParameter(parameter("environment.enabled"), {Scope::Environment, 0},
                                          on);
        showEnvironment();
    });
    connect(&controller, &DocumentController::changed, this, showEnvironment);
    showEnvironment();
    connect(a.furnace, &QAction::triggered, this, [this](bool on) {
        m_session.views.edit([on](render::ViewSettings& s) {
            s.furnace = on ? std::optional(glm::vec3(1.0f)) : std::nullopt;
        });
    });
    connect(&m_session.views, &ViewState::changed, this, [this] {
        if (m_session.views.settings().split)
            m_session.wall.setOn(false); // that is of one picture
        m_actions->furnace->setChecked(m_session.views.settings().furnace.has_value());
    });
    connect(a.fullScreen, &QAction::toggled, this,
            [this](bool on) { setWindowState(windowState().setFlag(Qt::WindowFullScreen, on)); });
    connect(a.resetLayout, &QAction::triggered, this, &MainWindow::resetLayout);
    connect(a.nextDock, &QAction::triggered, m_docks, &Docks::focusNext);
    connect(a.previousDock, &QAction::triggered, m_docks, &Docks::focusPrevious);
    connect(a.pinPixel, &QAction::triggered, &m_viewport->picker(), &PixelPicker::togglePin);
    connect(&m_viewport->picker(), &PixelPicker::pinned, this, [this] {
        if (!m_session.probe.wanted()) // nobody shows what was asked for
            m_actions->pixel->trigger();
    });
    new FocusPicker(controller, *m_viewport, *a.focusHere);
    connect(a.shortcuts, &QAction::triggered, this,
            [this] { makeShortcutsDialog(m_actions->all(), m_looks->listed(), this)->show(); });
    connect(a.memory, &QAction::triggered, this,
            [this] { makeMemoryDialog(m_session.memory, this)->show(); });
    connect(a.about, &QAction::triggered, this, [this] { makeAboutDialog(this)->show(); });

    connectLibrary(m_session.library, a, *m_files, *m_viewport);
    m_models.connectActions(a);
    m_viewport->setFade(m_session.library, *a.fadeEnvironments);
    m_viewport->setEnvironmentPreview(m_session.preview);
    new PreviewBadge(m_session.preview, *m_viewport);
    connect(m_files, &FileFlow::recentFilesChanged, this, &MainWindow::fillRecentMenu);
    connect(&controller, &DocumentController::fileChanged, this, &MainWindow::refreshTitle);
    connect(m_progress, &SceneProgress::sceneShown, this, &MainWindow::refreshTitle);
    connect(m_files, &FileFlow::openingChanged, m_progress, &SceneProgress::setOpening);
    connect(&controller, &DocumentController::noticed, this, &MainWindow::notice);
    connect(&controller, &DocumentController::changed, m_notices, [this](const Change& change) {
        if (change.isAnotherDocument())
            m_notices->sceneReplaced(m_session.controller.isPristine());
    });
    auto* activity = new ActivityStatus(m_session, *m_busy, this);
    connect(activity, &ActivityStatus::jobsWanted, this, [this] {
        if (!m_actions->jobsDock->isChecked())
            m_actions->jobsDock->trigger();
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (touches(change.affects, Affects::Geometry | Affects::Structure))
            refreshTriangles();
        if (!change.target || change.target->scope == Scope::View ||
            touches(change.affects, Affects::Bakes))
            refreshView();
    });
    connect(m_viewport, &ViewportWidget::frameRendered, this, &MainWindow::showFrame);
    connect(m_viewport, &ViewportWidget::displayRefused, &m_session.displays,
            &DisplayLoader::refuse);
    connect(&m_session.displays, &DisplayLoader::noticed, this, &MainWindow::notice);
    connect(m_viewport, &ViewportWidget::contextReady, this,
            [this](const QString& gpu, const QString& version) {
                m_gpu->setText(
                    tr("%1   OpenGL %2").arg(gpu, version.section(QLatin1Char(' '), 0, 0)));
                m_gpu->setToolTip(tr("%1\nOpenGL %2").arg(gpu, version));
            });
    connect(m_viewport, &ViewportWidget::contextFailed, this, [this](const QString& reason) {
        m_gpu->setText(tr("No OpenGL 4.5"));
        notice({NoticeKind::Error, reason, {}, {}, NoticeAbout::Program});
    });
    connect(m_viewport, &ViewportWidget::shaderProblems, this, [this](const QStringList& messages) {
        notice({NoticeKind::Error,
                tr("A shader does not compile; the last good one stays in use."),
                messages,
                {},
                NoticeAbout::Program});
    });
    fillRecentMenu();
    refreshTriangles();
    refreshView();
}

// A tracer's key is for the whole picture, a side of the split, or cells of the wall: those below
// the pointer, away from them the current one, or all.
void MainWindow::connectTracers() {
    Actions& a = *m_actions;
    const auto show = [this, &a] {
        const PathView& paths = m_session.paths;
        const TracedCells& cells = m_session.tracedCells;
        const bool wall = m_session.wall.isOn();
        const auto isTraced = [&](TracedBy tracer) {
            return wall ? cells.areTraced(cells.meantCells(), tracer)
                        : paths.isOn() && paths.tracer() == tracer;
        };
        a.pathTraced->setChecked(isTraced(TracedBy::Paths));
        a.whitted->setChecked(isTraced(TracedBy::Whitted));
        for (const auto& [action, tracer] :
             {std::pair(a.traceCells, TracedBy::Paths), {a.whittedCells, TracedBy::Whitted}}) {
            action->setEnabled(wall && !cells.allCells().empty());
            action->setChecked(wall && cells.areTraced(cells.allCells(), tracer));
        }
    };
    const auto trace = [=, this](TracedBy tracer) {
        TracedCells& cells = m_session.tracedCells;
        if (m_session.wall.isOn()) {
            const std::vector<std::size_t> below = m_viewport->cellsUnderPointer();
            cells.toggle(below.empty() ? cells.meantCells() : below, tracer);
        } else {
            m_session.side.toggle(tracer);
        }
        show(); // where it is as it was
    };
    const auto traceAll = [=, this](TracedBy tracer) {
        m_session.tracedCells.toggleAll(tracer);
        show();
    };
    connect(a.pathTraced, &QAction::triggered, this, [=] { trace(TracedBy::Paths); });
    connect(a.whitted, &QAction::triggered, this, [=] { trace(TracedBy::Whitted); });
    connect(a.traceCells, &QAction::triggered, this, [=] { traceAll(TracedBy::Paths); });
    connect(a.whittedCells, &QAction::triggered, this, [=] { traceAll(TracedBy::Whitted); });
    connect(&m_session.paths, &PathView::changed, this, show);
    connect(&m_session.tracedCells, &TracedCells::chosen, this, show);
    connect(&m_session.wall, &WallState::changed, this, show);
    connect(&m_session.wall, &WallState::cellsChosen, this, show);
}

} // namespace patina::editor
