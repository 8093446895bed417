// The part of ViewportWidget that shows what paths bring, in place of its own frames.
#include "app/editor/trace/PathBlame.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/viewport/TermDrawing.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/Log.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"

#include <QElapsedTimer>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <cmath>

namespace patina::editor {
namespace {

// A frame as the viewport's own, in pixels of that size, of which several make the picture.
render::FrameSettings accumulating(render::FrameSettings frame, const QSize& size) {
    frame.width = size.width();
    frame.height = size.height();
    frame.shownWidth = frame.shownHeight = 0;
    frame.samples = 1;
    frame.accumulate = frame.floats = true;
    frame.coarse = frame.dither = frame.showOverlays = frame.reuseScene = frame.keepPicture = false;
    frame.radiance = nullptr;
    return frame;
}

} // namespace

void ViewportWidget::setPaths(PathView& paths, PathError& error, PathBlame& blame,
                              TracedSide& side) {
    m_paths = &paths;
    m_pathError = &error;
    m_pathBlame = &blame;
    m_tracedSide = &side;
    m_viewFeed.setTraced(side);
    side.setViewport(*this);
    connect(&side, &TracedSide::changed, this, [this] {
        hurry(); // the viewport's own picture is another one
        redraw();
    });
    connect(&blame, &PathBlame::termsWanted, this, &ViewportWidget::redraw);
    connect(&error, &PathError::drawnWanted, this, &ViewportWidget::redraw);
    connect(&paths, &PathView::changed, this, [this] {
        if (!m_paths->isOn())
            hurry(); // the viewport's own picture again
        redraw();
    });
}

// The scene as the viewport draws it, a frame at a time: those of a moving hand are not waited for.
void ViewportWidget::drawForError(render::FrameSettings frame) {
    if (!m_pathError->wantsDrawn()) {
        m_drawn.reset();
        return;
    }
    if (m_pacing.moving() || m_gate.waiting())
        return;
    const bool begins = !m_drawn || m_drawnWanted != m_pathError->wantedDrawn();
    if (begins) {
        bringIn();
        m_drawn = std::make_unique<render::ViewRenderer>(*m_scene);
        m_drawnWanted = m_pathError->wantedDrawn();
    } else {
        m_drawn->resume();
    }
    frame = accumulating(frame, sizeAt(1.0f));
    if (const Result<void> drawn = m_drawn->render(frame, render::ViewRenderer::kNowhere); !drawn) {
        logError("the picture to compare with could not be drawn: {}", drawn.error().text());
        m_drawn.reset();
        return;
    }
    if (m_drawn->isSteady()) {
        m_pathError->setDrawn(m_drawn->readLinear());
        m_drawn.reset();
    } else {
        redraw();
    }
}

// The terms of the picture, once the picture itself is there.
void ViewportWidget::drawForBlame(const render::FrameSettings& frame) {
    if (!m_pathBlame->wantsTerms()) {
        m_terms.reset();
        return;
    }
    if (m_pathError->wantsDrawn() || m_pacing.moving() || m_gate.waiting())
        return;
    if (!m_terms || m_termsWanted != m_pathBlame->wantedTerms()) {
        bringIn();
        m_terms = std::make_unique<TermDrawing>(*m_scene, accumulating(frame, m_pathBlame->size()));
        m_termsWanted = m_pathBlame->wantedTerms();
    }
    const Result<bool> complete = m_terms->drawFrame();
    if (!complete) {
        logError("the terms of the picture could not be drawn: {}", complete.error().text());
        m_terms.reset();
    } else if (*complete) {
        m_pathBlame->setTerms(m_terms->take());
        m_terms.reset();
    } else {
        redraw();
    }
}

// It has no depth: overlays and looks at pixels are for the other pictures.
bool ViewportWidget::paintPaths(render::FrameSettings frame) {
    const bool wanted = m_paths != nullptr && m_paths->isOn() && !m_tracedSide->side() &&
                        !frame.view.split && frame.view.isOrdinary(frame.view.shown);
    if (!wanted)
        return false;
    m_paths->want(frame.camera, sizeAt(1.0f));
    const render::FrameSettings ordinary = frame;
    frame.radiance = m_paths->picture();
    if (!frame.radiance)
        return false;
    QElapsedTimer clock;
    clock.start();
    frame.width = frame.radiance->width();
    frame.height = frame.radiance->height();
    frame.samples = 1;
    frame.accumulate = frame.coarse = frame.showOverlays = false;
    stopSlices();
    if (const Result<void> drawn = m_renderer->render(frame, defaultFramebufferObject()); !drawn)
        logError("the traced picture could not be shown: {}", drawn.error().text());
    m_viewFeed.endFrame(*m_renderer);
    drawForError(ordinary);
    drawForBlame(ordinary);
    context()->functions()->glFinish();
    const double milliseconds = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    m_slowestFrameMs = std::max(m_slowestFrameMs, milliseconds);
    m_lastFrameSize = {frame.width, frame.height};
    m_eyeSeconds = 0.0f;
    Q_EMIT frameRendered(milliseconds, m_paths->progress().refined ? PictureState::Refined
                                                                   : PictureState::Refining);
    followLuminance();
    letOthersDraw();
    m_picker.frameDrawn({}, false);
    return true;
}

// Exposed as what is drawn beside it, so that only light differs; the photographic operator, which
// exposes by the picture itself, is given each side's own.
void ViewportWidget::paintTracedSide() {
    const bool wanted = m_paths != nullptr && m_tracedSide->side() && !m_wall.isOn() &&
                        !m_documentPicture && m_renderer != nullptr;
    if (!wanted) {
        m_traced.reset();
        m_tracedPicture = nullptr;
        return;
    }
    const View& view = m_controller.document().view;
    m_paths->want(view.camera, sizeAt(1.0f));
    if (!m_tracedSide->isShown())
        return;
    if (!m_traced)
        m_traced = std::make_unique<render::ViewRenderer>(*m_scene);
    render::FrameSettings frame;
    frame.radiance = m_paths->picture();
    frame.width = frame.radiance->width();
    frame.height = frame.radiance->height();
    frame.samples = 1;
    frame.camera = view.camera;
    frame.dither = true;
    frame.reuseScene = frame.radiance == m_tracedPicture;
    m_tracedPicture = frame.radiance;
    if (view.exposureMode == ExposureMode::Automatic && m_luminance) {
        frame.look = view;
        frame.look->exposureMode = ExposureMode::Fixed;
        frame.look->exposureEv = std::log2(exposureScale(view, *m_luminance));
    }
    const QSize size = sizeAt(1.0f);
    Result<void> shown = m_traced->render(frame, render::ViewRenderer::kNowhere);
    if (shown)
        shown = m_traced->present(defaultFramebufferObject(),
                                  {{0, 0, size.width(), size.height()}, m_tracedSide->line()});
    if (!shown)
        logError("the traced side could not be shown: {}", shown.error().text());
}

} // namespace patina::editor
