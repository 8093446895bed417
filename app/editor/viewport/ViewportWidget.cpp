#include "app/editor/viewport/ViewportWidget.h"

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/LobeOnSurface.h"
#include "app/editor/viewport/TermDrawing.h"
#include "app/editor/wall/WallState.h"
#include "core/base/Log.h"
#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/job/WorkGate.h"
#include "core/mix/LightMix.h"
#include "render/gl/Context.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

namespace patina::editor {
namespace {

constexpr double kPanelsMs = 10.0;      // for lists to show what was added
constexpr double kStepMs = 16.0;        // from the end of a frame to the next, of what moves
constexpr double kShaderPollMs = 500.0; // hot reload in developers' builds

} // namespace

ViewportWidget::ViewportWidget(DocumentController& controller, SelectionModel& selection,
                               IblUpdater& ibl, QWidget* parent)
    : QOpenGLWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_ibl(&ibl)
    , m_hand(controller, selection, *this, m_schedule)
    , m_projections(controller.runner())
    , m_viewFeed(controller)
    , m_gate(controller)
    , m_sheets(m_schedule)
    , m_picker(controller, *this, m_schedule)
    , m_wall(controller, ibl.prepared())
    , m_rest(m_schedule, [this] { refineAtRest(); })
    , m_environmentUpload(m_schedule, [this] { feedEnvironment(); })
    , m_previewUpload(m_schedule, [this] { feedPreview(); })
    , m_accumulation(m_schedule, [this] { drawNextAdded(); })
    , m_slices(m_schedule, [this] { drawSlice(); })
    , m_complete(m_schedule, [this] { redraw(); })
    , m_panels(m_schedule, [this] { redraw(); })
    , m_shaderWatch(m_schedule, [this] { reloadShaders(); })
    , m_fading(m_schedule, kStepMs, [this] { return stepFade(); })
    , m_eye(m_schedule, kStepMs, [this] { return stepEye(); })
    , m_marks(m_schedule, Blink::kTurnMs, [this] { return stepMarks(); }) {
    setObjectName(QStringLiteral("viewport"));
    setAccessibleName(tr("Viewport"));
    setAccessibleDescription(
        tr("The rendered scene. Drag to orbit, wheel to zoom, click to select."));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(320, 136); // small screens, with an instrument below it
    setMouseTracking(true);   // the cursor shows what can be dragged

    connect(&m_gate, &ViewGate::opened, this, &ViewportWidget::gateOpened);
    connect(&m_gate, &ViewGate::waitingChanged, this,
            [this] { m_viewFeed.setPreparing(m_gate.waiting()); });
    connect(&m_picker, &PixelPicker::notReady, &m_gate, &ViewGate::prepareInspection);
    connect(this, &QOpenGLWidget::frameSwapped, this, [this] {
        if (!std::exchange(m_frameShown, true)) // with Qt's part of it
            m_schedule.framePainted(static_cast<double>(m_frameClock.nsecsElapsed()) * 1e-6);
    });
    refineLater();

    connect(&controller, &DocumentController::changed, this, &ViewportWidget::applyChange);
    connect(&selection, &SelectionModel::selectionChanged, this, &ViewportWidget::redrawSoon);
    connect(&m_hand, &ViewportHand::cameraMoved, this, &ViewportWidget::touch);
    connect(&m_hand, &ViewportHand::clicked, this, &ViewportWidget::pickAt);
    connect(&m_hand, &ViewportHand::doubleClicked, this, [this](const QPointF& position) {
        if (m_wall.isOn())
            m_wallState->enlarge(m_wallState->enlarged() ? std::nullopt
                                                         : m_wallLayout.cellAt(position));
    });
    m_wall.setReady(
        [this](const std::vector<render::FrameKind>& frames) { return m_gate.admitCells(frames); });
    connect(&m_wall, &WallPainter::changed, this, &ViewportWidget::redrawSoon);
    connect(&m_viewFeed, &ViewFeed::changed, this, [this] {
        hurry(); // the next frame shows it, however slow the GPU is
        redraw();
    });
    connect(&m_viewFeed, &ViewFeed::termsChanged, this, &ViewportWidget::lookChanged);
    m_picker.setInspect([this](const QPoint& pixel) { return inspect(pixel); });
    m_sheets.setReady([this](ViewKind kind) { return m_gate.isOpenForSheets(kind); });
    m_sheets.setDraw([this](const render::ViewSheet& sheet) { return drawSheet(sheet); });
    connect(&m_preview, &PreviewFeed::changed, this, &ViewportWidget::lookChanged);
    connect(&m_bounces, &BounceFeed::changed, this, &ViewportWidget::lookChanged);
    connect(&m_nearShadows, &NearShadowFeed::changed, this, &ViewportWidget::lookChanged);
    connect(&m_radiosity, &RadiosityFeed::changed, this, &ViewportWidget::lookChanged);
    connect(&m_projections, &ProjectionFeed::changed, this, &ViewportWidget::lookChanged);
    connect(&m_preview, &PreviewFeed::changed, &m_wall, &WallPainter::invalidate);
    connect(&m_projections, &ProjectionFeed::changed, &m_wall, &WallPainter::invalidate);
    connect(&m_nearShadows, &NearShadowFeed::changed, this,
            [this] { m_wall.setNearShadows(m_nearShadows.shown()); });
    connect(m_ibl, &IblUpdater::ready, this, [this] { m_environmentUpload.want(); });
    m_ibl->request(shownEnvironment(controller.document()).image);
}

ViewportWidget::~ViewportWidget() {
    releaseGl();
    if (context() != nullptr) // which ends after this widget's own part
        disconnect(context(), nullptr, this, nullptr);
}

void ViewportWidget::setBakes(BakeService& bakes) {
    m_preview.setBakes(bakes);
}

void ViewportWidget::setJobs(JobManager& jobs) {
    m_workGate = jobs.gate().get();
    m_ibl->setGate(jobs.gate());
    m_wall.setGate(jobs.gate());
    connect(this, &QOpenGLWidget::frameSwapped, this, [this] { m_workGate->open(); });
}

void ViewportWidget::setBounces(BounceUpdater& bounces) {
    m_bounces.setBounces(bounces);
}

void ViewportWidget::setNearShadows(NearShadowUpdater& shadows) {
    m_nearShadows.setShadows(shadows);
}

void ViewportWidget::setRadiosity(RadiosityUpdater& radiosity) {
    m_radiosity.setRadiosity(radiosity);
    m_wall.setRadiosity(radiosity);
}

void ViewportWidget::setDisplays(DisplayLoader& displays) {
    m_displays = &displays;
    connect(&displays, &DisplayLoader::changed, this, [this] {
        m_displayPending = true;
        lookChanged();
    });
}

void ViewportWidget::setViews(ViewState& views) {
    m_viewFeed.setViews(views);
}

void ViewportWidget::setProbe(PixelProbe& probe) {
    m_picker.setProbe(probe);
}

void ViewportWidget::lookChanged() {
    if (m_pathError != nullptr)
        m_pathError->outdate();
    m_sheets.invalidate();
    redrawSoon();
}

void ViewportWidget::redraw() {
    m_redraws = true;
    update();
}

void ViewportWidget::redrawSoon() {
    if (!m_panels.isWanted())
        redraw();
}

void ViewportWidget::setLobe(LobeOnSurface& lobe) {
    m_lobe = &lobe;
    connect(&lobe, &LobeOnSurface::changed, this, [this] {
        m_onlyDisplay = true; // the scene itself is as it was
        redraw();
    });
}

void ViewportWidget::setLuminanceWanted(bool wanted) {
    if (wanted && !m_luminanceWanted)
        redraw();
    m_luminanceWanted = wanted;
}

// --- OpenGL ----------------------------------------------------------------------------------

void ViewportWidget::initializeGL() {
    // Docking and screen changes can make a new context; everything is rebuilt from CPU values.
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &ViewportWidget::releaseGl,
            Qt::DirectConnection);
    Result<std::unique_ptr<gl::Context>> adopted = gl::Context::adoptCurrent();
    if (!adopted) {
        Q_EMIT contextFailed(QString::fromStdString(adopted.error().text()));
        return;
    }
    m_context = std::move(adopted).value();
    // Software OpenGL takes four times as long for four samples in one piece, and keeps no code for
    // them: each program would be compiled anew in every session.
    m_pacing.setAccumulates(m_context->info().software);
    m_gate.setRenderer(m_context->info().renderer);
    const QByteArray shaderFolder = qgetenv("PATINA_SHADER_DIR");
    Result<std::unique_ptr<render::SceneRenderer>> created =
        render::SceneRenderer::create(*m_context, shaderFolder.toStdString());
    if (!created) {
        Q_EMIT contextFailed(QString::fromStdString(created.error().text()));
        return;
    }
    m_scene = std::move(created).value();
    m_renderer = std::make_unique<render::ViewRenderer>(*m_scene);
    m_thumbnails = std::make_unique<render::SheetRenderer>(*m_scene);
    m_scene->setDocument(m_controller.document());
    m_ibl->renew();
    m_environmentUpload.want();
    m_displayPending = true;
    m_preview.restart();
    m_bounces.restart();
    m_nearShadows.restart();
    m_radiosity.restart();
    if (!shaderFolder.isEmpty())
        m_shaderWatch.want(kShaderPollMs);
    Q_EMIT contextReady(QString::fromStdString(m_context->info().renderer),
                        QString::fromStdString(m_context->info().version));
}

void ViewportWidget::releaseGl() {
    if (!m_renderer && !m_context)
        return;
    m_sheets.setResting(false);
    m_picker.frameDrawn({}, false);
    stopSlices();
    m_lastFrameSize = {};
    makeCurrent();
    m_fade.release();
    m_wall.release();
    m_wallShown = false;
    m_thumbnails.reset();
    m_drawn.reset();
    m_terms.reset();
    m_traced.reset();
    m_documentPicture.reset();
    m_previewLight = render::kDocumentLight;
    m_renderer.reset();
    m_scene.reset();
    m_context.reset();
    doneCurrent();
    if (m_lookAhead != nullptr)
        m_lookAhead->end(); // its light went with the rest
}

QSize ViewportWidget::sizeAt(float scale) const {
    const double ratio = devicePixelRatioF() * static_cast<double>(scale);
    return {std::max(1, static_cast<int>(std::lround(width() * ratio))),
            std::max(1, static_cast<int>(std::lround(height() * ratio)))};
}

QSize ViewportWidget::frameSize() const {
    return m_slicing ? m_lastFrameSize : sizeAt(m_pacing.scale());
}

float ViewportWidget::viewAspect() const {
    return static_cast<float>(width()) / static_cast<float>(std::max(height(), 1));
}

render::FrameSettings ViewportWidget::nextFrame() {
    const QSize size = sizeAt(m_pacing.scale()), shown = sizeAt(1.0f);
    render::FrameSettings frame;
    m_pacing.setHasLens(m_controller.document().view.camera.lensRadius() > 0.0f);
    frame.width = size.width();
    frame.height = size.height();
    frame.shownWidth = shown.width();
    frame.shownHeight = shown.height();
    frame.samples = std::min(m_pacing.samples(), m_context->info().maxSamples);
    frame.accumulate = m_pacing.accumulating();
    frame.camera = m_controller.document().view.camera;
    frame.showOverlays = m_overlays;
    frame.selectedMesh = m_selection.mesh();
    frame.dither = true;
    frame.coarse = m_pacing.scale() < 1.0f;
    // The eye does not wait for what nobody looks at; while the hand moves there is no time for it.
    frame.measureLuminance = m_luminanceWanted && !m_pacing.moving();
    m_eyeSeconds += m_adaptation.beginFrame(m_schedule.now() * 1e-3);
    frame.adaptSeconds = m_eyeSeconds;
    frame.view = m_viewFeed.beginFrame(m_gate);
    frame.reuseScene = std::exchange(m_onlyDisplay, false) && frame.camera == m_lastCamera &&
                       m_viewFeed.sameAsBefore();
    m_lastCamera = frame.camera;
    if (m_documentPicture) {
        frame.light = m_previewLight;
        frame.adaptSeconds = std::numeric_limits<float>::infinity(); // it is a look, not a walk
    }
    frame.selectedLight = m_selection.light();
    frame.meshHandles = m_hand.meshes().handles();
    frame.overlayScale = static_cast<float>(devicePixelRatioF());
    if (m_lobe)
        frame.lobe = m_lobe->lobe();
    return frame;
}

void ViewportWidget::paintPicture() {
    QOpenGLFunctions* gl = context()->functions();
    if (!m_renderer) {
        gl->glClearColor(0.13f, 0.13f, 0.14f, 1.0f);
        gl->glClear(GL_COLOR_BUFFER_BIT);
        return;
    }
    if (m_wall.isOn()) {
        paintWall();
        return;
    }
    if (m_wallShown)
        leaveWall();
    QElapsedTimer clock;
    clock.start();
    if (m_pacing.moving())
        holdJobs();

    render::FrameSettings frame = nextFrame();
    takeDisplay();
    m_painted.showOverlays = false; // there are none over a traced picture
    if (!m_documentPicture && paintPaths(frame))
        return;
    // The picture that is shown stays until the next one is complete.
    const bool sliced = drawsInSlices(frame.view);
    const bool complete = sliced && m_renderer->isPrepared(frame);
    frame.keepPicture = sliced && !complete;
    // Nor does what is new begin it again before it is complete.
    if (!complete && !m_slices.isWanted())
        bringIn();
    if (const Result<void> drawn = m_renderer->render(frame, defaultFramebufferObject()); !drawn)
        logError("the frame could not be drawn: {}", drawn.error().text());
    m_painted = frame;
    m_viewFeed.endFrame(*m_renderer);
    m_bounces.endFrame(*m_scene);
    m_nearShadows.endFrame(*m_scene);
    m_radiosity.setLooked(frame.view, m_controller.document().view.lighting);
    gl->glFinish(); // so that the time below is the frame's, not that of the call

    const bool drawsScene = complete || (!frame.keepPicture && !frame.reuseScene);
    double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    m_slowestFrameMs = std::max(m_slowestFrameMs, milliseconds);
    if (complete)
        milliseconds += m_slicesMs;
    if (complete)
        bringIn();
    if (frame.accumulate && drawsScene)
        m_sheets.setFrameMs(milliseconds);
    if (drawsScene) // else it says nothing about what the scene costs
        m_pacing.frameTook(milliseconds);
    m_eyeSeconds = complete ? frame.adaptSeconds : 0.0f; // a prepared frame was not looked at
    wantFrame(frame);
    if (!frame.keepPicture) {
        m_lastFrameSize = {frame.width, frame.height};
        stopSlices();
        // As its own time says: after a slow frame the next one may be fast enough again.
        if (m_pacing.accumulating() &&
            m_renderer->accumulatedFrames() < render::ViewRenderer::steadyFrames(frame.camera))
            m_accumulation.want(kStepMs);
        else if (complete && !m_renderer->isCurrent(m_sliced))
            startSlices();
    } else if (m_renderer->isCurrent(m_sliced)) {
        stopSlices();
    } else if (!m_slices.isWanted()) {
        startSlices();
    }
    Q_EMIT frameRendered(milliseconds, pictureState());
    followLuminance();
    letOthersDraw();
    if (!m_documentPicture)
        m_picker.frameDrawn(m_lastFrameSize, m_pacing.moving());
}

void ViewportWidget::bringIn() {
    m_preview.upload(*m_scene);
    m_bounces.upload(*m_scene);
    m_nearShadows.upload(*m_scene);
    m_radiosity.upload(*m_scene);
    m_projections.upload(*m_scene, m_controller.document());
}

void ViewportWidget::letOthersDraw() {
    if (!m_renderer)
        return; // no context, or it is on its way
    const bool rests = !m_pacing.moving() && !m_documentPicture;
    m_sheets.setResting(rests && !(m_wallShown && m_slicing));
    if (rests)
        m_gate.prepareSheets(m_sheets.wanted());
    m_picker.setReady(m_gate.isOpenForInspection());
}

void ViewportWidget::gateOpened() {
    if (m_wall.isOn() && m_wall.preparing()) {
        m_wall.recompose();
        redraw();
    }
    if (m_gate.waiting()) {
        hurry();
        redraw();
        return;
    }
    letOthersDraw();
    if (!m_rest.isWanted())
        compileAhead(); // the gate may have been busy with something else
}

Result<render::Inspection> ViewportWidget::inspect(const QPoint& pixel) {
    if (!m_renderer)
        return Error{ErrorKind::NoOpenGl, "there is no OpenGL to draw with", {}, {}};
    makeCurrent();
    const render::ViewRenderer& picture = m_documentPicture ? *m_documentPicture : *m_renderer;
    Result<render::Inspection> inspection = picture.inspect(pixel.x(), pixel.y());
    doneCurrent();
    return inspection;
}

Result<std::vector<Image>> ViewportWidget::drawSheet(const render::ViewSheet& sheet) {
    if (!m_renderer)
        return Error{ErrorKind::NoOpenGl, "there is no OpenGL to draw with", {}, {}};
    makeCurrent();
    if (m_wallShown)
        m_scene->setDocument(m_controller.document()); // it shows a cell's
    render::FrameSettings frame;
    frame.camera = m_controller.document().view.camera;
    // The middle of what the viewport shows: a narrow one shows less to the sides.
    const float aspect = static_cast<float>(sheet.width) / static_cast<float>(sheet.height);
    if (const float part = viewAspect() / aspect; part < 1.0f)
        frame.camera.fovDeg = glm::degrees(
            2.0f * std::atan(part * std::tan(0.5f * glm::radians(frame.camera.fovDeg))));
    frame.view = m_viewFeed.chosen();
    Result<std::vector<Image>> drawn = m_thumbnails->draw(frame, sheet, *m_renderer);
    doneCurrent();
    return drawn;
}

void ViewportWidget::takeDisplay() {
    if (!m_displayPending || !m_displays)
        return;
    m_displayPending = false;
    if (const Result<void> set = m_scene->setDisplay(m_displays->transform()); !set)
        Q_EMIT displayRefused(set.error());
}

// Draws on while the eye adapts, and looks on while what was measured is on its way here; then
// rests.
void ViewportWidget::followLuminance() {
    if (m_documentPicture)
        return; // it is not the document's
    if (isEyeDue())
        m_eye.start();
    else
        m_eye.stop();
}

bool ViewportWidget::isEyeDue() {
    const std::optional<Luminance> luminance = m_renderer->luminance();
    const bool automatic = m_controller.document().view.exposureMode == ExposureMode::Automatic;
    const bool due = m_adaptation.endFrame(luminance, automatic) || m_renderer->luminancePending();
    if (luminance && luminance != m_luminance) {
        m_luminance = luminance;
        m_sheets.invalidate(); // the eye adapts: they are exposed like the picture
        Q_EMIT luminanceMeasured(*luminance);
    }
    return due;
}

bool ViewportWidget::stepEye() {
    if (!m_renderer || m_documentPicture) {
        m_eye.stop();
        return false;
    }
    if (m_slicing && m_renderer->preparesPicture(m_sliced))
        return false;              // for an eye like this; it goes on when that is shown
    if (!m_adaptation.running()) { // nothing moves: what was measured is on its way
        makeCurrent();
        const bool due = isEyeDue();
        doneCurrent();
        if (!due)
            m_eye.stop();
        if (!m_adaptation.running())
            return false;
    }
    m_onlyDisplay = true;
    redraw();
    return true;
}

bool ViewportWidget::stepMarks() {
    if (m_pacing.moving())
        return false; // the time is needed
    m_viewFeed.blink().turn();
    m_onlyDisplay = true;
    redraw();
    return true;
}

void ViewportWidget::reloadShaders() {
    m_shaderWatch.want(kShaderPollMs);
    if (!m_renderer)
        return;
    makeCurrent();
    QStringList problems;
    for (const std::string& message : m_scene->reloadShaders())
        problems << QString::fromStdString(message);
    doneCurrent();
    if (!problems.isEmpty())
        Q_EMIT shaderProblems(problems);
    redraw();
}

double ViewportWidget::takeSlowestFrameMs() {
    return std::exchange(m_slowestFrameMs, 0.0);
}

void ViewportWidget::applyChange(const Change& change) {
    // What is new may take a second until the driver has compiled for it: its row in a list, which
    // is drawn in the same pass of the window, must not wait for that.
    if (touches(change.affects, Affects::Structure) && !change.isAnotherDocument())
        m_panels.want(kPanelsMs);
    // Another document: a project brings its own view, anything else is framed for this widget.
    if (change.isAnotherDocument() && m_controller.filePath().isEmpty()) {
        const Document& document = m_controller.document();
        m_controller.setCamera(frameBounds(document.view.camera, document.bounds(), viewAspect()));
    }
    const bool otherMap = touches(change.affects, Affects::EnvironmentMap);
    if (otherMap)
        m_ibl->request(shownEnvironment(m_controller.document()).image);
    else if (change.affects != Affects::Nothing)
        m_fade.end(); // an edit is seen at once
    // Camera moves affect nothing: the camera travels with each frame.
    if (m_renderer && !m_wallShown && change.affects != Affects::Nothing) {
        makeCurrent();
        m_scene->setDocument(m_controller.document());
        doneCurrent();
        if (touches(change.affects, Affects::Bakes))
            m_bounces.restart();
    }
    if (otherMap && m_environmentUpload.isWanted())
        feedEnvironment(); // what is ready is seen in the next frame
    touch();
}

// --- Camera ----------------------------------------------------------------------------------

void ViewportWidget::touch() {
    hurry();
    m_picker.placeMark();
    lookChanged();
}

void ViewportWidget::hurry() {
    m_pacing.beginMoving();
    stopSlices();
    m_preview.setHandMoves(true);
    holdJobs();
    refineLater();
    m_sheets.setResting(false);
}

// Software OpenGL draws with all cores; elsewhere the window's thread and its driver's fill a small
// machine.
void ViewportWidget::holdJobs() {
    if (m_workGate && m_context && (m_context->info().software || threadCount() <= 2))
        m_workGate->close();
}

void ViewportWidget::setMeshHandlesOn(bool on) {
    m_hand.meshes().setOn(on);
    redraw();
}

void ViewportWidget::setOverlaysVisible(bool visible) {
    m_overlays = visible;
    m_hand.setHandlesVisible(visible && !m_wall.isOn());
    redraw();
}

} // namespace patina::editor
