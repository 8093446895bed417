#include "app/editor/MainWindow.h"

#include "app/editor/Actions.h"
#include "app/editor/Docks.h"
#include "app/editor/EnvironmentSaveDialog.h"
#include "app/editor/EscapeKey.h"
#include "app/editor/ExportDialog.h"
#include "app/editor/FileFlow.h"
#include "app/editor/Session.h"
#include "app/editor/ViewActions.h"
#include "app/editor/document/DraggedSources.h"
#include "app/editor/document/PrintableNotice.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/style/Icons.h"
#include "app/editor/trace/PathBadge.h"
#include "app/editor/trace/PathErrorOverlay.h"
#include "app/editor/trace/TracedSave.h"
#include "app/editor/trace/TransferRemedy.h"
#include "app/editor/viewport/DropTarget.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/viewport/LensBadge.h"
#include "app/editor/viewport/SceneProgress.h"
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/viewport/ViewOverlay.h"
#include "app/editor/viewport/ViewStrip.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/SheetSaveDialog.h"
#include "app/editor/wall/WallBar.h"
#include "app/editor/wall/WallOverlay.h"
#include "app/editor/widget/BusyIndicator.h"
#include "app/editor/widget/MessageBar.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/base/Log.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"
#include "core/library/Library.h"

#include <QCloseEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr qint64 kFrameTimeMs = 250; // how often the number changes, so that it can be read

} // namespace

MainWindow::MainWindow(Session& session)
    : m_session(session)
    , m_actions(new Actions(session.controller.undoStack(), this))
    , m_looks(new ViewActions(session.views, session.controller, this))
    , m_files(new FileFlow(session, *this))
    , m_docks(new Docks(*this))
    , m_viewport(new ViewportWidget(session.controller, session.selection, session.ibl))
    , m_models(session.controller, *m_viewport)
    , m_notices(new NoticeArea(*m_viewport)) {
    setObjectName(QStringLiteral("mainWindow"));
    setAcceptDrops(true);
    m_viewport->setBakes(session.bakes);
    m_viewport->setJobs(session.jobs);
    m_viewport->setBounces(session.bounces);
    m_viewport->setNearShadows(session.nearShadows);
    m_viewport->setRadiosity(session.radiosity);
    m_viewport->setDisplays(session.displays);
    m_viewport->setLobe(session.lobe);
    m_viewport->setViews(session.views);
    m_viewport->setWall(session.wall, session.comparison, session.tracedCells);
    session.tracedCells.setGate(session.jobs.gate());
    m_viewport->setPaths(session.paths, session.pathError, session.pathBlame, session.side);
    m_viewport->setProbe(session.probe);

    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto* wallBar =
        new WallBar(session.wall, session.comparison, session.controller, session.selection);
    layout->addWidget(wallBar);
    connect(wallBar, &WallBar::sheetWanted, this, [this] {
        SheetSaveDialog::open(m_session.wall, *m_viewport, m_session.controller, m_session.jobs,
                              this);
    });
    layout->addWidget(m_viewport, 1);
    auto* wallOverlay =
        new WallOverlay(session.wall, session.comparison, session.tracedCells, *m_viewport);
    new SplitHandle(session.comparison, *m_viewport);
    new PathErrorOverlay(session.pathError, session.pathBlame, *m_viewport);
    auto* badge = new PathBadge(
        session.paths, session.pathError, session.heat, session.side,
        new TransferRemedy(session.pathError, session.pathBlame, session.controller, session.bakes),
        *m_viewport);
    m_notices->keepClearOf(*badge);
    connect(&session.side, &TracedSide::changed, this,
            [this] { m_notices->setTraced(m_session.side.wholeBy().has_value()); });
    new LensBadge(session.controller, session.side, *m_viewport);
    connect(badge, &PathBadge::saveWanted, this, [this] {
        askAndSaveTraced(m_session.paths, m_session.controller, m_session.jobs, *this);
    });
    m_overlay =
        new ViewOverlay(session.views, session.side, session.controller, session.wall, *m_viewport);
    m_progress = new SceneProgress(session.controller, *m_viewport);
    m_drop = new DropTarget(*this, *m_viewport, session.controller, session.selection,
                            {session.wall, session.controller, *wallOverlay},
                            {session.wall, session.controller, *m_viewport, *wallOverlay});
    auto* equation =
        new EquationBar(session.views, session.side, session.controller, m_viewport->sheets());
    layout->addWidget(equation);
    connect(m_looks->equation, &QAction::toggled, equation,
            [equation](bool shown) { equation->setFolded(!shown); });
    connect(equation, &EquationBar::foldedChanged, m_looks->equation,
            [this](bool folded) { m_looks->equation->setChecked(!folded); });
    m_looks->equation->setChecked(!equation->isFolded());
    auto* strip = new ViewStrip(session.views, session.controller, m_viewport->sheets());
    layout->addWidget(strip);
    strip->addControl(ViewGroup::Lighting, makeReflectionMix());
    connect(m_looks->strip, &QAction::toggled, strip,
            [strip](bool shown) { strip->setFolded(!shown); });
    connect(strip, &ViewStrip::foldedChanged, m_looks->strip,
            [this](bool folded) { m_looks->strip->setChecked(!folded); });
    m_looks->strip->setChecked(!strip->isFolded());
    setCentralWidget(centre);
    new EscapeKey(*this, {[this] {
                              const bool previews = m_session.preview.isOn();
                              m_session.preview.end();
                              return previews;
                          },
                          [this] { return m_models.showAll(); },
                          [this] {
                              const bool splits = m_session.views.settings().split.has_value();
                              if (splits)
                                  m_session.views.toggleSplit();
                              return splits;
                          },
                          [this] {
                              WallState& wall = m_session.wall;
                              const bool shows = wall.isOn();
                              if (wall.enlarged())
                                  wall.enlarge(std::nullopt);
                              else
                                  wall.setOn(false);
                              return shows;
                          },
                          [equation] { return equation->back(); },
                          [this] {
                              const bool full = windowState().testFlag(Qt::WindowFullScreen);
                              m_actions->fullScreen->setChecked(false);
                              return full;
                          }});

    makeDocks();
    makeMenus();
    makeToolBar();
    makeStatusBar();
    connectActions();
    refreshTitle();
}

MainWindow::~MainWindow() {
    hide(); // QWidget's own end would do that, and what is in the window would tell what has ended
}

// Narrow, its name below it: it stands among thumbnails.
QWidget* MainWindow::makeReflectionMix() {
    constexpr int kWidth = 160;
    DocumentController& controller = m_session.controller;
    const ParameterInfo& mix = parameter("view.reflectionMix");
    auto* row = makeParameterRow(mix, {controller, m_session.thumbnails, [] {
                                           return Target{Scope::View, 0};
                                       }});
    row->refresh();
    connect(&controller, &DocumentController::changed, row, &ParameterRow::refresh);
    auto* name = new QLabel(toQString(mix.label));
    name->setAlignment(Qt::AlignCenter);
    name->setToolTip(toQString(mix.help));
    auto* box = new QWidget;
    box->setFixedWidth(kWidth);
    auto* layout = new QVBoxLayout(box);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addStretch(1);
    layout->addWidget(row);
    layout->addWidget(name);
    layout->addStretch(1);
    return box;
}

// --- Menus, tool bar, status bar ----------------------------------------------------------------

void MainWindow::makeMenus() {
    Actions& a = *m_actions;
    QMenu* file = menuBar()->addMenu(tr("&File"));
    file->addActions({a.newScene, a.open});
    m_recentMenu = file->addMenu(tr("Open &Recent"));
    m_recentMenu->setToolTipsVisible(true);
    file->addAction(a.recover);
    file->addSeparator();
    file->addAction(a.addModel);
    QMenu* builtin = file->addMenu(icon(QStringLiteral("library")), tr("Add &Built-in Model"));
    for (const library::Entry& entry : library::models()) {
        QAction* action = builtin->addAction(
            QString::fromStdString(entry.title), this, [this, name = entry.name] {
                m_session.controller.addModel(QStringLiteral("builtin:") +
                                              QString::fromStdString(name));
            });
        Actions::describe(action, QString::fromStdString(entry.help));
    }
    file->addSeparator();
    file->addAction(a.makeHdr);
    file->addSeparator();
    file->addActions(
        {a.save, a.saveAs, a.saveEnvironment, a.exportScene, a.exportRadiosity, a.exportTurntable});
    file->addSeparator();
    file->addAction(a.quit);

    QMenu* edit = menuBar()->addMenu(tr("&Edit"));
    edit->addActions({a.undo, a.redo});
    edit->addSeparator();
    edit->addActions({a.duplicateSelected, a.removeSelected});
    edit->addSeparator();
    edit->addActions({a.placeHandles, a.dropToGround, a.backInPlace});
    edit->addSeparator();
    edit->addAction(a.keepSnapshot);

    QMenu* view = menuBar()->addMenu(tr("&View"));
    view->addActions({a.frame, a.home, a.overlays});
    view->addActions({a.nextModel, a.previousModel});
    view->addSeparator();
    view->addActions({a.wall, a.pathTraced, a.whitted, a.traceCells, a.whittedCells});
    m_looks->fillMenu(*view->addMenu(tr("L&ook At")));
    view->addSeparator();
    view->addActions({a.lightingIbl, a.lightingPrt, a.lightingRadiosity, a.previousEnvironment,
                      a.nextEnvironment, a.environmentOn, a.fadeEnvironments});
    view->addSeparator();
    view->addActions(a.docks());
    view->addActions({a.nextDock, a.previousDock});
    view->addSeparator();
    view->addActions(a.instruments());
    view->addActions({a.pinPixel, a.focusHere, a.furnace});
    view->addSeparator();
    view->addAction(a.resetLayout);
    view->addSeparator();
    view->addAction(a.fullScreen);

    QMenu* help = menuBar()->addMenu(tr("&Help"));
    help->addActions({a.shortcuts, a.memory, a.about});

    // Open or closed, on or off: a tick says it, which an icon would hide.
    for (QAction* action : a.all())
        if (action->isCheckable())
            action->setIconVisibleInMenu(false);

    // Shortcuts go on in full screen, where the menu bar may be hidden.
    addActions(a.all());
    addActions(m_looks->all());
}

void MainWindow::makeToolBar() {
    QToolBar* bar = addToolBar(tr("Tools"));
    bar->setObjectName(QStringLiteral("tools"));
    bar->setMovable(false);
    bar->setIconSize({20, 20});
    bar->toggleViewAction()->setStatusTip(tr("Show or hide the tool bar"));
    bar->toggleViewAction()->setToolTip(tr("Show or hide the tool bar"));
    Actions& a = *m_actions;
    bar->addActions({a.newScene, a.open, a.save});
    bar->addSeparator();
    bar->addActions({a.undo, a.redo});
    bar->addSeparator();
    bar->addActions({a.frame, a.home, a.overlays, a.placeHandles, a.wall, a.pathTraced, a.whitted});
    bar->addSeparator();
    bar->addAction(a.exportScene);
    for (QToolButton* button : bar->findChildren<QToolButton*>()) {
        if (const QAction* action = button->defaultAction()) {
            QString name = action->text();
            button->setAccessibleName(name.remove(QLatin1Char('&')));
        }
    }
}

void MainWindow::makeStatusBar() {
    auto* bar = new MessageBar;
    m_busy = new BusyIndicator;
    m_triangles = new QLabel;
    m_frameTime = new QLabel;
    m_gpu = new QLabel(tr("Starting OpenGL…"));
    m_triangles->setStatusTip(tr("Triangles of the visible meshes"));
    m_frameTime->setObjectName(QStringLiteral("frameTime"));
    m_frameTime->setStatusTip(tr("During interaction the time of a frame and the frames per second "
                                 "that it allows; at rest, whether the picture is refined"));
    m_frameTime->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    m_gpu->setStatusTip(tr("The graphics processor and its version of OpenGL"));
    for (QWidget* widget : {static_cast<QWidget*>(m_busy), static_cast<QWidget*>(m_triangles),
                            static_cast<QWidget*>(m_frameTime), static_cast<QWidget*>(m_gpu)})
        bar->addPermanentWidget(widget);
    // Its place does not move while numbers change; in the font of the bar's style.
    m_frameTime->ensurePolished();
    m_frameTime->setText(QStringLiteral("0000.0 ms  00 fps"));
    m_frameTime->setMinimumWidth(m_frameTime->sizeHint().width());
    m_frameTime->clear();
    bar->setSizeGripEnabled(false);
    setStatusBar(bar);
}

void MainWindow::refreshTriangles() {
    m_triangles->setText(tr("%L1 triangles").arg(m_session.controller.document().triangleCount()));
}

void MainWindow::showFrame(double milliseconds, PictureState state) {
    // At rest a frame's time is that of a finer picture, and says nothing about interaction.
    if (state != PictureState::Moving) {
        m_frameTimeShown.invalidate();
        m_frameTime->setText(state == PictureState::Refined ? tr("Refined") : tr("Refining…"));
        return;
    }
    if (m_frameTimeShown.isValid() && m_frameTimeShown.elapsed() < kFrameTimeMs)
        return;
    m_frameTimeShown.start();
    m_frameTime->setText(tr("%1 ms  %2 fps")
                             .arg(milliseconds, 0, 'f', 1)
                             .arg(qRound(1000.0 / std::max(milliseconds, 1.0))));
}

// --- What is shown ------------------------------------------------------------------------------

void MainWindow::fillRecentMenu() {
    m_recentMenu->clear();
    const QStringList files = m_files->recentFiles();
    for (const QString& file : files) {
        QAction* action = m_recentMenu->addAction(shownFileName(file), this,
                                                  [this, file] { m_files->open(file); });
        Actions::describe(action, file);
    }
    if (!files.isEmpty()) {
        m_recentMenu->addSeparator();
        Actions::describe(
            m_recentMenu->addAction(tr("&Clear List"), m_files, &FileFlow::clearRecentFiles),
            tr("Forget the files that were opened"));
    }
    m_recentMenu->setEnabled(!files.isEmpty());
}

void MainWindow::refreshTitle() {
    setWindowModified(m_session.controller.isModified());
    if (m_progress->pending())
        return; // the picture is still that of the scene before
    setWindowTitle(tr("%1[*] — Patina").arg(shownName(m_session.controller.displayName())));
    setWindowFilePath(m_session.controller.filePath());
}

void MainWindow::refreshView() {
    const Document& document = m_session.controller.document();
    const LightingMode mode = document.view.lighting;
    m_actions->lightingPrt->setEnabled(hasTransfer(document));
    m_actions->lightingIbl->setChecked(mode == LightingMode::Ibl);
    m_actions->lightingPrt->setChecked(mode == LightingMode::Prt);
    m_actions->lightingRadiosity->setChecked(mode == LightingMode::Radiosity);
}

void MainWindow::notice(const UserNotice& notice) {
    m_notices->add(printableNotice(notice));
    const std::string text =
        notice.details.isEmpty()
            ? notice.text.toStdString()
            : (notice.text + QStringLiteral(" ") + notice.details.join(QStringLiteral("; ")))
                  .toStdString();
    switch (notice.kind) {
    case NoticeKind::Info:
        logMessage(LogLevel::Info, text);
        break;
    case NoticeKind::Warning:
        logMessage(LogLevel::Warning, text);
        break;
    case NoticeKind::Error:
        logMessage(LogLevel::Error, text);
        break;
    }
}

void MainWindow::openExportDialog() {
    auto* dialog = new ExportDialog(m_session.controller, m_session.jobs, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::openEnvironmentSaveDialog() {
    auto* dialog = new EnvironmentSaveDialog(m_session.controller, m_session.jobs, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

// --- Window events ------------------------------------------------------------------------------

// Window managers have ways of their own into full screen and out of it.
void MainWindow::changeEvent(QEvent* event) {
    if (event->type() == QEvent::WindowStateChange)
        m_actions->fullScreen->setChecked(windowState().testFlag(Qt::WindowFullScreen));
    QMainWindow::changeEvent(event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!m_mayClose) {
        event->ignore();
        m_files->guardQuit([this] {
            m_mayClose = true;
            // Not from within the event: Qt ignores close() on a window that is closing.
            QMetaObject::invokeMethod(this, &QWidget::close, Qt::QueuedConnection);
        });
        return;
    }
    saveLayout();
    m_session.jobs.shutDown();
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (!draggedSources(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    event->acceptProposedAction();
    const QStringList files = draggedSources(*event->mimeData());
    if (!m_drop->drop(files, event->position()))
        m_files->dropped(files, mapToGlobal(event->position().toPoint()));
}

} // namespace patina::editor
