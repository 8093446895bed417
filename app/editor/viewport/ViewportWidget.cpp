#include "app/editor/viewport/ViewportWidget.h"

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/LivePreview.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/Navigator.h"
#include "core/base/Log.h"
#include "core/document/Lights.h"
#include "render/Renderer.h"
#include "render/gl/Context.h"

#include <QApplication>
#include <QFile>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <QStandardPaths>
#include <QStatusTipEvent>
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace patina::editor {
namespace {

constexpr int kRestMs = 250;         // without movement until the picture is refined
constexpr int kFlyStepMs = 16;       // a flying camera moves 60 times a second
constexpr int kPreviewMs = 100;      // how often a bake is asked for a new pass
constexpr int kAdaptationMs = 16;    // between the frames of an eye that adapts
constexpr int kShaderPollMs = 500;   // hot reload in developers' builds
constexpr double kClickPixels = 4.0; // a press that moves less selects
constexpr float kTurnDegrees = 0.4f; // of the surroundings or a light, per pixel

glm::vec2 toGlm(const QPointF& point) {
    return {static_cast<float>(point.x()), static_cast<float>(point.y())};
}

// Computed light outlives the session; the system may empty this folder at any time.
std::filesystem::path iblCacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "ibl";
}

} // namespace

ViewportWidget::ViewportWidget(DocumentController& controller, SelectionModel& selection,
                               QWidget* parent)
    : QOpenGLWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_ibl(new IblUpdater(iblCacheFolder(), this)) {
    setObjectName(QStringLiteral("viewport"));
    setAccessibleName(tr("Viewport"));
    setAccessibleDescription(
        tr("The rendered scene. Drag to orbit, wheel to zoom, click to select."));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(320, 240);
    setMouseTracking(true); // the cursor shows what can be dragged

    m_restTimer.setSingleShot(true);
    m_restTimer.setInterval(kRestMs);
    connect(&m_restTimer, &QTimer::timeout, this, [this] {
        // A held button or key is a hand that has not let go yet.
        if (m_drag != Drag::None || !m_flyKeys.empty()) {
            m_restTimer.start();
            return;
        }
        if (m_pacing.refine()) {
            update();
            m_restTimer.start(); // the next step
        }
    });
    m_restTimer.start();
    m_flyTimer.setInterval(kFlyStepMs);
    connect(&m_flyTimer, &QTimer::timeout, this, &ViewportWidget::flyStep);
    m_clock.start();
    m_adaptationTimer.setSingleShot(true);
    m_adaptationTimer.setInterval(kAdaptationMs);
    connect(&m_adaptationTimer, &QTimer::timeout, this, [this] {
        m_onlyExposure = true;
        update();
    });
    m_previewTimer.setInterval(kPreviewMs);
    connect(&m_previewTimer, &QTimer::timeout, this, &ViewportWidget::pollPreview);
    m_shaderTimer.setInterval(kShaderPollMs);
    connect(&m_shaderTimer, &QTimer::timeout, this, [this] {
        if (!m_renderer)
            return;
        makeCurrent();
        QStringList problems;
        for (const std::string& message : m_renderer->reloadShaders())
            problems << QString::fromStdString(message);
        doneCurrent();
        if (!problems.isEmpty())
            Q_EMIT shaderProblems(problems);
        update();
    });

    connect(&controller, &DocumentController::changed, this, &ViewportWidget::applyChange);
    connect(&selection, &SelectionModel::selectionChanged, this, qOverload<>(&QWidget::update));
    connect(m_ibl, &IblUpdater::ready, this, [this] {
        m_iblPending = true;
        update();
    });
    m_ibl->request(controller.document().environment.image);
}

ViewportWidget::~ViewportWidget() {
    releaseGl();
}

void ViewportWidget::setJobs(JobManager& jobs) {
    m_jobs = &jobs;
    connect(&jobs, &JobManager::previewChanged, this, [this] {
        m_previewSamples = 0;
        m_previewPending = m_jobs->preview() != nullptr;
        if (m_previewPending) {
            m_previewTimer.start();
            update();
        } else {
            m_previewTimer.stop();
            update(); // paintGL drops the preview
        }
    });
}

void ViewportWidget::setDisplays(DisplayLoader& displays) {
    m_displays = &displays;
    connect(&displays, &DisplayLoader::changed, this, [this] {
        m_displayPending = true;
        update();
    });
}

void ViewportWidget::setLuminanceWanted(bool wanted) {
    if (wanted && !m_luminanceWanted)
        update();
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
    const QByteArray shaderFolder = qgetenv("PATINA_SHADER_DIR");
    Result<std::unique_ptr<render::Renderer>> created =
        render::Renderer::create(*m_context, shaderFolder.toStdString());
    if (!created) {
        Q_EMIT contextFailed(QString::fromStdString(created.error().text()));
        return;
    }
    m_renderer = std::move(created).value();
    m_renderer->setDocument(m_controller.document(), Change::everything());
    m_iblPending = true;
    m_displayPending = true;
    if (m_jobs && m_jobs->preview()) {
        m_jobs->preview()->markAllChanged();
        m_previewPending = true;
    }
    if (!shaderFolder.isEmpty())
        m_shaderTimer.start();
    Q_EMIT contextReady(QString::fromStdString(m_context->info().renderer),
                        QString::fromStdString(m_context->info().version));
}

void ViewportWidget::releaseGl() {
    if (!m_renderer && !m_context)
        return;
    makeCurrent();
    m_reduced.reset();
    m_renderer.reset();
    m_context.reset();
    doneCurrent();
}

QSize ViewportWidget::frameSize() const {
    const double ratio = devicePixelRatioF() * static_cast<double>(m_pacing.scale());
    return {std::max(1, static_cast<int>(std::lround(width() * ratio))),
            std::max(1, static_cast<int>(std::lround(height() * ratio)))};
}

float ViewportWidget::viewAspect() const {
    return static_cast<float>(width()) / static_cast<float>(std::max(height(), 1));
}

void ViewportWidget::paintGL() {
    QOpenGLFunctions* gl = context()->functions();
    if (!m_renderer) {
        gl->glClearColor(0.13f, 0.13f, 0.14f, 1.0f);
        gl->glClear(GL_COLOR_BUFFER_BIT);
        return;
    }
    QElapsedTimer clock;
    clock.start();

    // Bring in what the background has prepared since the last frame.
    if (m_iblPending && m_ibl->maps()) {
        m_renderer->setIbl(*m_ibl->maps());
        m_iblPending = false;
    }
    if (m_previewPending && m_jobs && m_jobs->preview()) {
        m_previewPending = false;
        m_previewShown |= m_jobs->preview()->collect(
            [this, kind = m_jobs->preview()->kind()](Id mesh, int stride,
                                                     std::span<const float> values) {
                m_renderer->previewVertices(kind, mesh, stride, values);
            },
            [this](Id material, int size, std::span<const float> values) {
                m_renderer->previewTexels(material, size, values);
            });
    } else if (m_previewShown && !(m_jobs && m_jobs->preview())) {
        m_renderer->clearPreview();
        m_previewShown = false;
    }

    takeDisplay();

    // Full frames go to the widget; reduced ones to a smaller buffer that is stretched.
    const QSize size = frameSize();
    const QSize full(std::max(1, static_cast<int>(std::lround(width() * devicePixelRatioF()))),
                     std::max(1, static_cast<int>(std::lround(height() * devicePixelRatioF()))));
    GLuint target = defaultFramebufferObject();
    if (size != full) {
        if (!m_reduced || m_reduced->size() != size)
            m_reduced = std::make_unique<QOpenGLFramebufferObject>(size);
        target = m_reduced->handle();
    }
    render::FrameSettings frame;
    frame.width = size.width();
    frame.height = size.height();
    frame.samples = std::min(m_pacing.samples(), m_context->info().maxSamples);
    frame.camera = m_controller.document().view.camera;
    frame.showOverlays = m_overlays;
    frame.selectedMesh = m_selection.mesh();
    frame.dither = true;
    // The eye does not wait for what nobody looks at; while the hand moves there is no time for it.
    frame.measureLuminance = m_luminanceWanted && !m_pacing.moving();
    frame.adaptSeconds =
        m_adaptation.beginFrame(static_cast<double>(m_clock.nsecsElapsed()) * 1e-9);
    frame.reuseScene = std::exchange(m_onlyExposure, false) && frame.camera == m_lastCamera;
    m_lastCamera = frame.camera;
    frame.selectedLight = m_selection.light();
    frame.overlayScale = m_pacing.scale();
    if (const Result<void> drawn = m_renderer->render(frame, target); !drawn)
        logError("the frame could not be drawn: {}", drawn.error().text());
    if (size != full)
        QOpenGLFramebufferObject::blitFramebuffer(nullptr, QRect(QPoint(), full), m_reduced.get(),
                                                  QRect(QPoint(), size), GL_COLOR_BUFFER_BIT,
                                                  GL_LINEAR);
    gl->glFinish(); // so that the time below is the frame's, not that of the call
    m_lastFrameSize = size;

    const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    if (!frame.reuseScene) // says nothing about what the scene costs
        m_pacing.frameTook(milliseconds);
    m_slowestFrameMs = std::max(m_slowestFrameMs, milliseconds);
    Q_EMIT frameRendered(milliseconds);
    followLuminance();
}

void ViewportWidget::takeDisplay() {
    if (!m_displayPending || !m_displays)
        return;
    m_displayPending = false;
    if (const Result<void> set = m_renderer->setDisplay(m_displays->transform()); !set)
        Q_EMIT displayRefused(set.error());
}

// Draws on while the eye adapts, or while its state is still on its way here; then rests.
void ViewportWidget::followLuminance() {
    const std::optional<Luminance> luminance = m_renderer->luminance();
    const bool automatic = m_controller.document().view.exposureMode == ExposureMode::Automatic;
    if (m_adaptation.endFrame(luminance, automatic) || m_renderer->luminancePending())
        m_adaptationTimer.start();
    if (luminance && luminance != m_luminance) {
        m_luminance = luminance;
        Q_EMIT luminanceMeasured(*luminance);
    }
}

double ViewportWidget::takeSlowestFrameMs() {
    return std::exchange(m_slowestFrameMs, 0.0);
}

void ViewportWidget::applyChange(const Change& change) {
    // Another document: a project brings its own view, anything else is framed for this widget.
    if (change.affects == Affects::Everything && m_controller.filePath().isEmpty()) {
        const Document& document = m_controller.document();
        m_controller.setCamera(frameBounds(document.view.camera, document.bounds(), viewAspect()));
    }
    if (touches(change.affects, Affects::EnvironmentMap))
        m_ibl->request(m_controller.document().environment.image);
    // Camera moves affect nothing: the camera travels with each frame.
    if (m_renderer && change.affects != Affects::Nothing) {
        makeCurrent();
        m_renderer->setDocument(m_controller.document(), change);
        doneCurrent();
    }
    touch();
}

// Each complete pass is a usable picture. Showing unfinished ones would redraw all the time and
// take the cores from the bake.
void ViewportWidget::pollPreview() {
    const std::shared_ptr<LivePreview> preview = m_jobs->preview();
    if (!preview || preview->samplesDone() == m_previewSamples)
        return;
    m_previewSamples = preview->samplesDone();
    m_previewPending = true;
    update();
}

// --- Camera ----------------------------------------------------------------------------------

void ViewportWidget::touch() {
    m_pacing.beginMoving();
    m_restTimer.start();
    update();
}

void ViewportWidget::setCamera(const Camera& camera) {
    m_controller.setCamera(camera);
    touch();
}

void ViewportWidget::frameSelection() {
    const Document& document = m_controller.document();
    Bounds bounds = document.bounds();
    if (const MeshInstance* mesh = document.mesh(m_selection.mesh()); mesh && mesh->mesh)
        bounds = mesh->mesh->bounds().transformed(mesh->transform);
    setCamera(frameBounds(document.view.camera, bounds, viewAspect()));
}

void ViewportWidget::resetCamera() {
    const Document& document = m_controller.document();
    Camera camera; // default yaw and pitch; the field of view is the user's
    camera.fovDeg = document.view.camera.fovDeg;
    setCamera(frameBounds(camera, document.bounds(), viewAspect()));
}

void ViewportWidget::setOverlaysVisible(bool visible) {
    m_overlays = visible;
    update();
}

void ViewportWidget::flyStep() {
    const double seconds = static_cast<double>(m_flyClock.restart()) * 1e-3;
    glm::vec3 direction(0.0f);
    const auto held = [this](int key) { return m_flyKeys.count(key) ? 1.0f : 0.0f; };
    direction.x = held(Qt::Key_D) - held(Qt::Key_A);
    direction.y = held(Qt::Key_E) - held(Qt::Key_Q);
    direction.z = held(Qt::Key_W) - held(Qt::Key_S);
    const float radius = std::max(m_controller.document().bounds().radius(), 1e-3f);
    // A stalled event loop must not catapult the camera.
    const float step = m_flySpeed * radius * static_cast<float>(std::min(seconds, 0.1));
    setCamera(fly(m_controller.document().view.camera, step * direction));
}

void ViewportWidget::turnEnvironment(float pixels) {
    const ParameterInfo* rotation = findParameter("environment.rotationDeg");
    const float now = m_controller.document().environment.rotationDeg;
    // The surroundings follow the pointer: dragging right turns them right.
    const float next = std::remainder(now + kTurnDegrees * pixels, 360.0f);
    m_controller.setParameter(*rotation, Target{Scope::Environment, 0}, next, m_dragSession);
}

// --- Lights ----------------------------------------------------------------------------------

render::GizmoView ViewportWidget::gizmoView() const {
    // As the renderer sees it, in widget pixels: the marks of a dense screen have the same size.
    const Camera& camera = m_controller.document().view.camera;
    render::GizmoView view;
    view.worldToClip = camera.projectionMatrix(viewAspect(), m_controller.document().bounds()) *
                       camera.viewMatrix();
    view.viewport = {static_cast<float>(width()), static_cast<float>(height())};
    view.scale = std::max(static_cast<float>(1.0 / devicePixelRatioF()), view.viewport.y / 1000.0f);
    return view;
}

render::GizmoHit ViewportWidget::gizmoAt(const QPointF& position) const {
    if (!m_overlays)
        return {};
    const Document& document = m_controller.document();
    const glm::vec2 pixel(static_cast<float>(position.x()),
                          static_cast<float>(height() - position.y()));
    return render::pickGizmo(document, document.bounds(), gizmoView(), m_selection.light(), pixel);
}

void ViewportWidget::dragGizmo(const QPointF& pixels) {
    const Document& document = m_controller.document();
    const Light* light = document.light(m_lightBefore.id);
    if (!light)
        return;
    const Camera& camera = document.view.camera;
    const Light dragged = render::draggedLight(
        *light, m_handle, document.bounds(), gizmoView(), camera.right(), camera.up(),
        {static_cast<float>(pixels.x()), static_cast<float>(-pixels.y())});
    const bool turns = m_handle == render::GizmoHandle::Aim || !hasPosition(light->type);
    m_controller.changeLight(
        dragged, m_dragSession,
        (turns ? tr("Turn %1") : tr("Move %1")).arg(QString::fromStdString(light->name)));
    if (turns)
        showHint(tr("Azimuth %1°, elevation %2° (Esc takes it back)")
                     .arg(static_cast<double>(dragged.azimuthDeg), 0, 'f', 1)
                     .arg(static_cast<double>(dragged.elevationDeg), 0, 'f', 1));
    else
        showHint(tr("X %1 m, Y %2 m, Z %3 m (Esc takes it back)")
                     .arg(static_cast<double>(dragged.position.x), 0, 'f', 3)
                     .arg(static_cast<double>(dragged.position.y), 0, 'f', 3)
                     .arg(static_cast<double>(dragged.position.z), 0, 'f', 3));
}

void ViewportWidget::turnLight(const QPointF& pixels) {
    const Document& document = m_controller.document();
    const Light* light = document.light(m_lightBefore.id);
    if (!light)
        return;
    // The side that faces the camera follows the pointer: dragging right takes the light to the
    // right, dragging up takes it up.
    const Light turned = turnedLight(*light, document.bounds().center(),
                                     kTurnDegrees * static_cast<float>(pixels.x()),
                                     -kTurnDegrees * static_cast<float>(pixels.y()));
    m_controller.changeLight(turned, m_dragSession,
                             tr("Turn %1").arg(QString::fromStdString(light->name)));
    showHint(tr("%1 turns about the scene (Esc takes it back)")
                 .arg(QString::fromStdString(light->name)));
}

// Back to where the drag began; a session that returns to its start leaves no step behind.
void ViewportWidget::cancelLightDrag() {
    m_controller.changeLight(m_lightBefore, m_dragSession, {});
    m_drag = Drag::None;
    m_pressIsClick = false;
    showHint({});
}

void ViewportWidget::showHint(const QString& text) {
    QStatusTipEvent event(text);
    QApplication::sendEvent(this, &event);
}

void ViewportWidget::pickAt(const QPointF& position) {
    if (!m_renderer || m_lastFrameSize.isEmpty())
        return;
    makeCurrent();
    const Id mesh = m_renderer->pick(
        static_cast<int>(position.x() * m_lastFrameSize.width() / std::max(width(), 1)),
        static_cast<int>(position.y() * m_lastFrameSize.height() / std::max(height(), 1)));
    doneCurrent();
    m_selection.selectMesh(mesh);
    if (mesh == 0) // nothing at all: the light's handles go, too
        m_selection.selectLight(0);
}

// --- Events ----------------------------------------------------------------------------------

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
    if (m_drag != Drag::None)
        return; // a second button changes nothing
    const bool shift = event->modifiers() & Qt::ShiftModifier;
    const bool ctrl = event->modifiers() & Qt::ControlModifier;
    switch (event->button()) {
    case Qt::LeftButton:
        m_drag = shift ? Drag::Pan : Drag::Orbit;
        if (const render::GizmoHit hit = gizmoAt(event->position()); hit.light != 0 && !shift) {
            m_drag = Drag::Gizmo;
            m_handle = hit.handle;
            m_selection.selectLight(hit.light);
            m_lightBefore = *m_controller.document().light(hit.light);
            m_dragSession = m_controller.newDragSession();
        }
        break;
    case Qt::MiddleButton:
        m_drag = Drag::Pan;
        break;
    case Qt::RightButton:
        m_drag = shift ? Drag::TurnEnvironment : Drag::Look;
        if (ctrl) {
            const Light* light = m_controller.document().light(m_selection.light());
            m_drag = light ? Drag::TurnLight : Drag::TurnEnvironment;
            if (light)
                m_lightBefore = *light;
            else
                showHint(tr("No light is selected: turning the environment"));
        }
        m_dragSession = m_controller.newDragSession();
        break;
    default:
        return;
    }
    m_pressPosition = m_lastPosition = event->position();
    m_pressIsClick = true;
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
    if (m_drag == Drag::None) {
        // The hand says what can be taken hold of.
        if (gizmoAt(event->position()).light != 0)
            setCursor(Qt::OpenHandCursor);
        else
            unsetCursor();
        return;
    }
    const QPointF moved = event->position() - m_lastPosition;
    if (m_pressIsClick) {
        const QPointF total = event->position() - m_pressPosition;
        if (std::hypot(total.x(), total.y()) < kClickPixels)
            return;
        m_pressIsClick = false;
    }
    m_lastPosition = event->position();
    const Camera& camera = m_controller.document().view.camera;
    switch (m_drag) {
    case Drag::Orbit:
        setCamera(orbit(camera, toGlm(moved)));
        break;
    case Drag::Pan:
        setCamera(pan(camera, toGlm(moved), static_cast<float>(height())));
        break;
    case Drag::Look:
        setCamera(look(camera, toGlm(moved)));
        break;
    case Drag::TurnEnvironment:
        turnEnvironment(static_cast<float>(moved.x()));
        break;
    case Drag::TurnLight:
        turnLight(moved);
        break;
    case Drag::Gizmo:
        setCursor(Qt::ClosedHandCursor);
        dragGizmo(moved);
        break;
    case Drag::None:
        break;
    }
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
    if (m_pressIsClick && event->button() == Qt::LeftButton && m_drag == Drag::Orbit)
        pickAt(event->position());
    if (m_drag == Drag::Gizmo || m_drag == Drag::TurnLight) {
        unsetCursor();
        showHint({});
    }
    m_drag = Drag::None;
    m_pressIsClick = false;
    m_flyKeys.clear();
    m_flyTimer.stop();
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
    const float steps = static_cast<float>(event->angleDelta().y()) / 120.0f;
    if (m_drag == Drag::Look)
        m_flySpeed = std::clamp(m_flySpeed * std::pow(1.25f, steps), 0.02f, 50.0f);
    else
        setCamera(dolly(m_controller.document().view.camera, steps,
                        m_controller.document().bounds().radius()));
    event->accept();
}

void ViewportWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && (m_drag == Drag::Gizmo || m_drag == Drag::TurnLight)) {
        cancelLightDrag();
        return;
    }
    const bool flyKey = event->key() == Qt::Key_W || event->key() == Qt::Key_A ||
                        event->key() == Qt::Key_S || event->key() == Qt::Key_D ||
                        event->key() == Qt::Key_Q || event->key() == Qt::Key_E;
    if (!flyKey || m_drag != Drag::Look) {
        QOpenGLWidget::keyPressEvent(event);
        return;
    }
    m_pressIsClick = false;
    if (m_flyKeys.empty()) {
        m_flyClock.start();
        m_flyTimer.start();
    }
    m_flyKeys.insert(event->key());
}

void ViewportWidget::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat())
        return;
    m_flyKeys.erase(event->key());
    if (m_flyKeys.empty())
        m_flyTimer.stop();
    QOpenGLWidget::keyReleaseEvent(event);
}

void ViewportWidget::focusOutEvent(QFocusEvent* event) {
    m_flyKeys.clear();
    m_flyTimer.stop();
    QOpenGLWidget::focusOutEvent(event);
}

bool ViewportWidget::event(QEvent* event) {
    // While flying, letters belong to the camera, not to shortcuts; so does Esc to a drag.
    if (event->type() == QEvent::ShortcutOverride &&
        (m_drag == Drag::Look || m_drag == Drag::Gizmo || m_drag == Drag::TurnLight)) {
        event->accept();
        return true;
    }
    return QOpenGLWidget::event(event);
}

} // namespace patina::editor
