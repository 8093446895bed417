// The picture of the document: draws it as fast as the hand moves and as fine as rest allows.
#pragma once

#include "app/editor/radiosity/RadiosityFeed.h"
#include "app/editor/viewport/AdaptationClock.h"
#include "app/editor/viewport/BounceFeed.h"
#include "app/editor/viewport/FramePacing.h"
#include "app/editor/viewport/FrameSchedule.h"
#include "app/editor/viewport/NearShadowFeed.h"
#include "app/editor/viewport/PictureFade.h"
#include "app/editor/viewport/PixelPicker.h"
#include "app/editor/viewport/PreviewFeed.h"
#include "app/editor/viewport/ProjectionFeed.h"
#include "app/editor/viewport/ScheduleTimer.h"
#include "app/editor/viewport/SheetScheduler.h"
#include "app/editor/viewport/ViewFeed.h"
#include "app/editor/viewport/ViewGate.h"
#include "app/editor/viewport/ViewportHand.h"
#include "app/editor/wall/WallLayout.h"
#include "app/editor/wall/WallPainter.h"
#include "core/document/Document.h"
#include "core/math/Camera.h"
#include "render/SceneRenderer.h"
#include "render/SheetRenderer.h"
#include "render/ViewRenderer.h"

#include <QElapsedTimer>
#include <QImage>
#include <QOpenGLWidget>
#include <memory>
#include <utility>

class QAction;

namespace patina {
class WorkGate;
struct Change;
struct Error;
} // namespace patina
namespace patina::gl {
class Context;
}

namespace patina::editor {

class DisplayLoader;
class DocumentController;
class EnvironmentLibrary;
class EnvironmentPreview;
class IblUpdater;
class BakeService;
class JobManager;
class LobeOnSurface;
class PathBlame;
class PathError;
class PathView;
class SelectionModel;
class TermDrawing;
class TracedCells;
class TracedSide;
class ViewState;
class WallComparison;
class WallState;

// How far the picture of the scene has come: drawn for speed, on its way to be as fine as it gets,
// or there.
enum class PictureState { Moving, Refining, Refined };

// What the picture still waits for. Of several the one that is named first here.
enum class Awaited {
    Nothing,
    OpenGl,       // there is none, or not yet
    Programs,     // of the view that was asked for
    Light,        // of the environment: it is prepared, or uploaded
    Coefficients, // of light that bounces, shadows that are traced, a cross-fade
    Input,        // which has not ended: frames are drawn for speed
    Frame,        // something that is set has not been drawn yet
    FinerFrame,   // more pixels, slices, frames that are added up, passes of a tracer
    Eye,          // which adapts
    Preview,      // its end: another picture is shown meanwhile
    Fade,         // its end
};

class ViewportWidget : public QOpenGLWidget {
    Q_OBJECT
  public:
    // `ibl`: prepares the light of what is shown.
    ViewportWidget(DocumentController& controller, SelectionModel& selection, IblUpdater& ibl,
                   QWidget* parent = nullptr);
    ~ViewportWidget() override;

    void setBakes(BakeService& bakes);       // whose live preview is shown
    void setJobs(JobManager& jobs);          // who wait while frames are drawn
    void setBounces(BounceUpdater& bounces); // whose light is shown
    void setNearShadows(NearShadowUpdater& shadows);
    void setRadiosity(RadiosityUpdater& radiosity);
    void setDisplays(DisplayLoader& displays); // whose view of OpenColorIO is shown
    void setViews(ViewState& views);           // what of the scene is shown
    void setLobe(LobeOnSurface& lobe);         // which is drawn with the overlays
    // Whether many of it are shown beside each other, and which of them are traced.
    void setWall(WallState& wall, WallComparison& comparison, TracedCells& traced);
    // Whose picture is shown while it is on, and who measures the drawn one against it.
    // `side`: where it is shown.
    void setPaths(PathView& paths, PathError& error, PathBlame& blame, TracedSide& side);
    // What the library lights the scene with is faded to while `wanted` is checked.
    void setFade(EnvironmentLibrary& library, QAction& wanted);
    // What is looked at before it is used is shown in the picture, or in the wall's current cell.
    void setEnvironmentPreview(EnvironmentPreview& preview);
    [[nodiscard]] bool showsPreviews() const; // there is a place for them
    [[nodiscard]] QRect previewArea() const;  // that place
    // It is shown in place of the picture.
    [[nodiscard]] bool previews() const { return m_documentPicture != nullptr; }
    void setProbe(PixelProbe& probe);     // who is told what pixels are made of
    void setLuminanceWanted(bool wanted); // even where the picture does not depend on it

    // Thumbnails of views with this viewport's camera, drawn while it rests.
    [[nodiscard]] SheetScheduler& sheets() { return m_sheets; }
    [[nodiscard]] PixelPicker& picker() { return m_picker; }

    void frameSelection();                 // the selected mesh, or everything
    void resetCamera();                    // Home: the whole scene from the default side
    void setMeshHandlesOn(bool on);        // the tool that moves, rotates and scales
    void setOverlaysVisible(bool visible); // ground grid, selection outline, light icons
    [[nodiscard]] bool overlaysVisible() const { return m_overlays; }

    // The wall's cells for a sheet, drawn one frame at a time: see WallPainter.
    [[nodiscard]] const WallPainter& wallPainter() const { return m_wall; }
    Result<std::optional<Image>> drawSheetFrame(const render::CellView& cell, bool begins,
                                                bool linear);
    void endSheet();

    // Of the single picture, under a position in the widget; 0: none.
    [[nodiscard]] Id meshAt(const QPointF& position);
    // In the world; nothing: the background. The document's picture alone (showsWall()).
    [[nodiscard]] Result<std::optional<glm::vec3>> surfaceAt(const QPointF& position);
    [[nodiscard]] bool showsWall() const { return m_wall.isOn(); }
    // Under the pointer or, in a gap, closest to it; of a caption all that it is of. None: the
    // pointer is elsewhere.
    [[nodiscard]] std::vector<std::size_t> cellsUnderPointer() const;

    // The picture of the document, reduced to fit, without what fades over it; null while nothing
    // was drawn. Draws nothing of the scene.
    [[nodiscard]] QImage smallPicture(const QSize& largest);

    // Of the next frame in device pixels: the widget's, or less while the hand moves; until a frame
    // that is drawn in slices is complete, of the one that is shown.
    [[nodiscard]] QSize frameSize() const;

    // Whether the view asked for is not drawn yet, because what draws it is being compiled.
    [[nodiscard]] bool waitsForPrograms() const { return m_gate.waiting(); }
    [[nodiscard]] bool compilesPrograms() const { return m_gate.compiling(); } // or nobody waits

    // Found from what is there and what is under way, not kept.
    [[nodiscard]] Awaited awaited() const;
    // The picture is as fine as it gets, in the light and with the programs it asks for: without
    // an edit, or a bake that ends, the next frame is the same.
    [[nodiscard]] bool isSettled() const { return awaited() == Awaited::Nothing; }
    // Who is next between events: others that work with its context take turns with it.
    [[nodiscard]] FrameSchedule& schedule() { return m_schedule; }
    void setAddsSlowFrames(bool adds) { m_pacing.setAddsSlowFrames(adds); } // see FramePacing
    // Whether what may be looked at next is compiled at rest, which keeps a core busy for a while:
    // by default. Without, it is compiled when it is asked for, in the background, too.
    void setCompilesAhead(bool compiles);

    [[nodiscard]] PictureFade& fade() { return m_fade; } // between environments
    // What has been drawn so far; nothing while there is no scene.
    [[nodiscard]] render::SceneRenderer::Counts counts() const {
        return m_scene ? m_scene->counts() : render::SceneRenderer::Counts();
    }

    // What draws it; null while there is none.
    [[nodiscard]] const gl::ContextInfo* glInfo() const {
        return m_context ? &m_context->info() : nullptr;
    }

    // Milliseconds of the slowest frame since the last call (tests and the status bar).
    double takeSlowestFrameMs();

  Q_SIGNALS:
    void contextReady(const QString& gpu, const QString& glVersion); // after initializeGL
    void contextFailed(const QString& reason); // no OpenGL 4.5: the widget stays grey
    void frameRendered(double milliseconds, patina::editor::PictureState state);
    void luminanceMeasured(const patina::Luminance& luminance); // when it has changed
    void displayRefused(const patina::Error& error);            // by the graphics driver
    void shaderProblems(const QStringList& messages); // a reload failed; the last good ones stay

  protected:
    void initializeGL() override;
    void resizeGL(int width, int height) override;
    void paintGL() override;

  private:
    void releaseGl();
    void applyChange(const Change& change);
    void gateOpened();
    // Thumbnails and looks at pixels, where nothing need be compiled for them.
    void letOthersDraw();
    void compileAhead(); // nobody needs the processor
    void setCamera(const Camera& camera);
    void touch();       // the hand moved something: draw fast now, refine when it rests
    void lookChanged(); // of the scene, other than by the hand: its thumbnails are old, too
    void redraw();      // update(), until when something is awaited
    void redrawSoon();  // after the panels where they go first
    void hurry();       // the next frames must be fast
    void holdJobs();    // until the frame is shown
    [[nodiscard]] Result<render::Inspection> inspect(const QPoint& pixel);
    [[nodiscard]] Result<std::vector<Image>> drawSheet(const render::ViewSheet& sheet);
    [[nodiscard]] render::FrameSettings nextFrame();
    // The traced picture in place of the frame's; false: there is none of what it shows.
    [[nodiscard]] bool paintPaths(render::FrameSettings frame);
    void paintTracedSide(); // over what was drawn
    void drawForError(render::FrameSettings frame);
    void drawForBlame(const render::FrameSettings& frame);
    [[nodiscard]] QSize sizeAt(float scale) const; // in device pixels
    void bringIn(); // what the background has prepared since the last frame
    // The rest of the frame that is shown next, in slices that input does not wait for.
    [[nodiscard]] bool drawsInSlices(const render::ViewSettings& view) const;
    void wantFrame(const render::FrameSettings& frame); // in slices
    void startSlices();
    void stopSlices();
    void drawSlice();
    void refineLater(); // once nothing has moved for a while
    void refineAtRest();
    void drawNextAdded(); // frame of those that are added up
    void reloadShaders();
    [[nodiscard]] bool stepFade();
    [[nodiscard]] bool stepEye();
    [[nodiscard]] bool stepMarks();
    void feedEnvironment();
    void takeDisplay();
    void followLuminance();
    [[nodiscard]] bool isEyeDue(); // another frame, or another look at what was measured
    void pickAt(const QPointF& position);
    void paintPicture(); // without what fades over it
    void keepForFade();
    void fadeFromHere();
    void previewChanged();
    void feedPreview();
    void enterPreview();
    void leavePreview();
    [[nodiscard]] Result<void> presentPlain(unsigned framebuffer, const QSize& size);
    // The document's last frame once more, with what lies over it or without.
    [[nodiscard]] Result<void> renderPainted(unsigned framebuffer, const QSize& size,
                                             bool overlays);
    // --- ViewportWall.cpp
    void wallChanged();
    void drawTracedCells(); // whose pictures are others
    void setWallLayout();
    void leaveWall(); // the scene is the document's again
    void paintWall();
    void prepareWall(); // what its cells are to show
    void drawWallSlice();
    void wallDrawn(const Result<bool>& drawn, std::size_t due, double milliseconds);
    [[nodiscard]] float viewAspect() const;
    [[nodiscard]] bool showsWhatIsSet() const;
    [[nodiscard]] PictureState pictureState() const; // of the frame that was drawn last

    DocumentController& m_controller;
    SelectionModel& m_selection;
    DisplayLoader* m_displays = nullptr;
    LobeOnSurface* m_lobe = nullptr;
    PathView* m_paths = nullptr;
    PathError* m_pathError = nullptr;
    PathBlame* m_pathBlame = nullptr;
    TracedSide* m_tracedSide = nullptr;
    std::unique_ptr<render::ViewRenderer> m_traced; // of one side of the split; null: none is
    ImagePtr m_tracedPicture;                       // that it shows
    std::unique_ptr<render::ViewRenderer> m_drawn;  // for it; null: none is under way
    std::uint64_t m_drawnWanted = 0;                // which of PathError's m_drawn is
    std::unique_ptr<TermDrawing> m_terms;           // for PathBlame; null: none is under way
    std::pair<std::uint64_t, std::uint64_t> m_termsWanted; // which of its terms
    IblUpdater* m_ibl;
    FrameSchedule m_schedule; // before all that takes turns
    ScheduleTimer m_turns{m_schedule};
    ViewportHand m_hand;
    PreviewFeed m_preview;
    BounceFeed m_bounces;
    NearShadowFeed m_nearShadows;
    RadiosityFeed m_radiosity;
    ProjectionFeed m_projections;
    WorkGate* m_workGate = nullptr; // closed from an edit until its frame is shown
    ViewFeed m_viewFeed;
    ViewGate m_gate;
    SheetScheduler m_sheets;
    PixelPicker m_picker;
    WallState* m_wallState = nullptr;
    WallLayout m_wallLayout;

    std::unique_ptr<gl::Context> m_context;
    // Null until there is a context.
    std::unique_ptr<render::SceneRenderer> m_scene;
    std::unique_ptr<render::ViewRenderer> m_renderer; // of what is shown
    std::unique_ptr<render::SheetRenderer> m_thumbnails;
    WallPainter m_wall;             // what it has on the GPU goes with the scene
    bool m_wallShown = false;       // by the last frame
    double m_wallMs = 0.0;          // that its cells have taken since they were due
    std::size_t m_wallCells = 0;    // that have been drawn meanwhile
    ImagePtr m_environmentOnItsWay; // whose light the scene is being given
    bool m_displayPending = true;   // m_displays->transform() is not in the renderer yet
    bool m_luminanceWanted = false;
    std::optional<Luminance> m_luminance; // as announced last
    AdaptationClock m_adaptation;
    float m_eyeSeconds = 0.0f;  // that no frame has given the eye yet
    bool m_onlyDisplay = false; // the next frame is drawn for adaptation or marks alone
    Camera m_lastCamera;        // of the last frame

    EnvironmentPreview* m_lookAhead = nullptr;
    render::LightId m_previewLight = render::kDocumentLight; // that: there is none
    // The picture of the document while m_renderer shows the preview, and how fine it is.
    std::unique_ptr<render::ViewRenderer> m_documentPicture;
    FramePacing m_documentPacing;
    QSize m_documentFrameSize, m_documentPixels; // of that picture; of the viewport then
    Camera m_documentCamera;
    PictureFade m_fade;
    Camera m_fadeCamera; // of the picture that fades
    bool m_fades = true;

    FramePacing m_pacing;
    QElapsedTimer m_frameClock;              // since the last frame was begun …
    bool m_frameShown = true;                // … until it is on screen
    bool m_redraws = false;                  // a frame is to be drawn, and is not yet
    FrameSchedule::Task m_rest;              // the picture is refined, by one step
    FrameSchedule::Task m_environmentUpload; // the next piece
    FrameSchedule::Task m_previewUpload;     // likewise
    FrameSchedule::Task m_accumulation;      // the next frame of those that are added up
    FrameSchedule::Task m_slices;            // the next one
    FrameSchedule::Task m_complete;          // the last one has been drawn: it is shown
    FrameSchedule::Task m_panels;            // have shown a change: now the viewport does
    FrameSchedule::Task m_shaderWatch;       // hot reload
    FrameSchedule::Animation m_fading, m_eye, m_marks;
    bool m_slicing = false;         // the next picture is drawn in slices, or waits to be shown
    render::FrameSettings m_sliced; // that picture
    double m_slicesMs = 0.0;        // what it has taken so far
    double m_slowestFrameMs = 0.0;
    QSize m_lastFrameSize;
    // The last frame of m_renderer, of m_documentPicture.
    render::FrameSettings m_painted, m_documentPainted;

    bool m_overlays = true;
    bool m_compilesAhead = true;
};

} // namespace patina::editor
