// The part of ViewportWidget that shows what paths bring, in place of its own frames.
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/Log.h"

#include <QElapsedTimer>
#include <QOpenGLContext>
#include <QOpenGLFunctions>

namespace patina::editor {

void ViewportWidget::setPaths(PathView& paths) {
    m_paths = &paths;
    connect(&paths, &PathView::changed, this, [this] {
        if (!m_paths->isOn())
            hurry(); // the viewport's own picture again
        update();
    });
}

// It has no depth: overlays and looks at pixels are for the other pictures.
bool ViewportWidget::paintPaths(render::FrameSettings frame) {
    const bool wanted = m_paths != nullptr && m_paths->isOn() && !frame.view.split &&
                        frame.view.isOrdinary(frame.view.shown);
    if (!wanted)
        return false;
    m_paths->want(frame.camera, sizeAt(1.0f));
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

} // namespace patina::editor
