// The picture of the document, and the hand's way into it: orbit, pan, zoom, fly, pick.
//
//  left drag            orbit            wheel          zoom
//  middle / Shift+left  pan              click          select
//  right drag           look around, with W A S D Q E to fly; the wheel then sets the speed
//  Shift+right drag     turn the environment (one undo step)
//  Ctrl+right drag      turn the selected light about the scene, or the environment when none is
//  drag a light's mark or handles to move and aim it; Esc takes the drag back
#pragma once

#include "app/editor/viewport/AdaptationClock.h"
#include "app/editor/viewport/FramePacing.h"
#include "core/document/Document.h"
#include "core/math/Camera.h"
#include "render/scene/LightGizmo.h"

#include <QElapsedTimer>
#include <QOpenGLWidget>
#include <QTimer>
#include <memory>
#include <set>

class QOpenGLFramebufferObject;

namespace patina {
struct Change;
struct Error;
} // namespace patina
namespace patina::gl {
class Context;
}
namespace patina::render {
class Renderer;
}

namespace patina::editor {

class DisplayLoader;
class DocumentController;
class IblUpdater;
class JobManager;
class SelectionModel;

class ViewportWidget : public QOpenGLWidget {
    Q_OBJECT
  public:
    ViewportWidget(DocumentController& controller, SelectionModel& selection,
                   QWidget* parent = nullptr);
    ~ViewportWidget() override;

    void setJobs(JobManager& jobs);            // whose live preview is shown
    void setDisplays(DisplayLoader& displays); // whose view of OpenColorIO is shown
    void setLuminanceWanted(bool wanted);      // even where the picture does not depend on it

    void frameSelection();                 // the selected mesh, or everything
    void resetCamera();                    // Home: the whole scene from the default side
    void setOverlaysVisible(bool visible); // ground grid, selection outline, light icons
    [[nodiscard]] bool overlaysVisible() const { return m_overlays; }

    // Of the next frame in device pixels: the widget's, or less while the hand moves.
    [[nodiscard]] QSize frameSize() const;

    // Milliseconds of the slowest frame since the last call (tests and the status bar).
    double takeSlowestFrameMs();

  Q_SIGNALS:
    void contextReady(const QString& gpu, const QString& glVersion); // after initializeGL
    void contextFailed(const QString& reason); // no OpenGL 4.5: the widget stays grey
    void frameRendered(double milliseconds);
    void luminanceMeasured(const patina::Luminance& luminance); // when it has changed
    void displayRefused(const patina::Error& error);            // by the graphics driver
    void shaderProblems(const QStringList& messages); // a reload failed; the last good ones stay

  protected:
    void initializeGL() override;
    void paintGL() override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    bool event(QEvent* event) override;

  private:
    enum class Drag { None, Orbit, Pan, Look, TurnEnvironment, TurnLight, Gizmo };

    void releaseGl();
    void applyChange(const Change& change);
    void setCamera(const Camera& camera);
    void touch(); // the hand moved something: draw fast now, refine when it rests
    void flyStep();
    void pollPreview();
    void takeDisplay();
    void followLuminance();
    void turnEnvironment(float pixels);
    void pickAt(const QPointF& position);
    void turnLight(const QPointF& pixels);
    void dragGizmo(const QPointF& pixels);
    void cancelLightDrag();
    void showHint(const QString& text); // in the status bar
    [[nodiscard]] render::GizmoView gizmoView() const;
    [[nodiscard]] render::GizmoHit gizmoAt(const QPointF& position) const;
    [[nodiscard]] float viewAspect() const;

    DocumentController& m_controller;
    SelectionModel& m_selection;
    JobManager* m_jobs = nullptr;
    DisplayLoader* m_displays = nullptr;
    IblUpdater* m_ibl;

    std::unique_ptr<gl::Context> m_context;
    std::unique_ptr<render::Renderer> m_renderer;
    std::unique_ptr<QOpenGLFramebufferObject> m_reduced; // target of reduced frames
    bool m_iblPending = true;                            // m_ibl->maps() is not in the renderer yet
    bool m_previewShown = false;
    bool m_previewPending = false; // a new pass is to be uploaded
    int m_previewSamples = 0;      // of the pass seen last

    bool m_displayPending = true; // m_displays->transform() is not in the renderer yet
    bool m_luminanceWanted = false;
    std::optional<Luminance> m_luminance; // as announced last
    AdaptationClock m_adaptation;
    QElapsedTimer m_clock;       // since the viewport was made
    bool m_onlyExposure = false; // the next frame is drawn for adaptation alone
    Camera m_lastCamera;         // of the last frame

    FramePacing m_pacing;
    QTimer m_restTimer, m_flyTimer, m_previewTimer, m_shaderTimer, m_adaptationTimer;
    QElapsedTimer m_flyClock;
    double m_slowestFrameMs = 0.0;
    QSize m_lastFrameSize;

    Drag m_drag = Drag::None;
    QPointF m_pressPosition, m_lastPosition;
    bool m_pressIsClick = false; // no movement since the press
    quint64 m_dragSession = 0;
    render::GizmoHandle m_handle = render::GizmoHandle::None; // that is dragged
    Light m_lightBefore;                                      // the dragged light, for Esc
    std::set<int> m_flyKeys;
    float m_flySpeed = 1.0f; // scene radii per second
    bool m_overlays = true;
};

} // namespace patina::editor
