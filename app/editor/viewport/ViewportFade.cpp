// The part of ViewportWidget that fades from the picture in one environment's light to that in
// another's, and keeps what is read from the viewport free of it.
#include "app/editor/document/DocumentController.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/Log.h"
#include "core/mix/LightMix.h"

#include <QAction>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QSettings>
#include <QStyle>

namespace patina::editor {
namespace {

const char* const kFadeKey = "viewport/fadeBetweenEnvironments";

} // namespace

void ViewportWidget::setFade(EnvironmentLibrary& library, QAction& wanted) {
    wanted.setChecked(QSettings().value(QLatin1String(kFadeKey), true).toBool());
    m_fades = wanted.isChecked();
    connect(&wanted, &QAction::toggled, this, [this](bool on) {
        QSettings().setValue(QLatin1String(kFadeKey), on);
        m_fades = on;
        if (!on)
            m_fade.end();
    });
    connect(&library, &EnvironmentLibrary::arrived, this, &ViewportWidget::keepForFade);
    connect(&m_viewFeed, &ViewFeed::changed, &m_fade, &PictureFade::end);
    connect(&m_fade, &PictureFade::ended, this, [this] {
        m_fading.stop();
        redraw();
    });
}

// Painted anew only where its clock has moved: while it stands, what is below can become finer.
bool ViewportWidget::stepFade() {
    // The light that it waits for may never come.
    if (m_fade.waits() && m_ibl->finished() && !m_environmentUpload.isWanted())
        m_fade.end();
    if (!m_fade.hasMoved() || !m_renderer)
        return false;
    // Frames that are added up go on: they take the fade along.
    m_onlyDisplay = !(m_pacing.accumulating() &&
                      m_renderer->accumulatedFrames() <
                          render::ViewRenderer::steadyFrames(m_controller.document().view.camera));
    redraw();
    return true;
}

// Before anything of the new environment is drawn.
void ViewportWidget::keepForFade() {
    const bool animates =
        style()->styleHint(QStyle::SH_Widget_Animation_Duration, nullptr, this) > 0;
    if (!m_fades || !animates || !m_renderer || m_lastFrameSize.isEmpty() || !isVisible() ||
        (m_paths != nullptr && m_paths->isOn()))
        return;
    makeCurrent();
    m_fade.keep(defaultFramebufferObject(), sizeAt(1.0f));
    doneCurrent();
    m_fading.start();
    m_fadeCamera = m_controller.document().view.camera;
}

// To what is drawn next, unless a light is on its way that it waits for.
void ViewportWidget::fadeFromHere() {
    if (m_fade.waits())
        return;
    keepForFade();
    m_fade.begin();
}

void ViewportWidget::paintGL() {
    m_frameClock.start();
    m_frameShown = m_redraws = false;
    paintPicture();
    paintTracedSide();
    if (m_renderer && m_fade.isOn()) {
        if (m_controller.document().view.camera != m_fadeCamera)
            m_fade.end(); // two pictures from two places would be a blur
        m_fade.blend(defaultFramebufferObject(), sizeAt(1.0f));
        if (m_fade.isOn())
            m_fading.start();
    }
    if (m_viewFeed.blink().isActive())
        m_marks.start();
    else
        m_marks.stop();
    m_schedule.framePainted(static_cast<double>(m_frameClock.nsecsElapsed()) * 1e-6);
}

// The picture of the document, whatever lies over it or is previewed.
Result<void> ViewportWidget::presentPlain(unsigned framebuffer, const QSize& size) {
    if (m_wallShown)
        return m_wall.present(framebuffer, size);
    const render::ViewRenderer& picture = m_documentPicture ? *m_documentPicture : *m_renderer;
    return picture.present(framebuffer, {{0, 0, size.width(), size.height()}, std::nullopt});
}

Result<void> ViewportWidget::renderPainted(unsigned framebuffer, const QSize& size, bool overlays) {
    render::FrameSettings frame = m_documentPicture ? m_documentPainted : m_painted;
    frame.keepPicture = true;
    frame.shownWidth = size.width();
    frame.shownHeight = size.height();
    frame.adaptSeconds = 0.0f;
    frame.measureLuminance = false;
    frame.showOverlays = overlays;
    return (m_documentPicture ? *m_documentPicture : *m_renderer).render(frame, framebuffer);
}

QImage ViewportWidget::smallPicture(const QSize& largest) {
    if (!m_renderer || m_lastFrameSize.isEmpty())
        return {};
    const bool previews = m_lookAhead != nullptr && m_lookAhead->isOn();
    if (m_wallShown && previews)
        return {}; // in one of its cells
    const QSize full = sizeAt(1.0f);
    const QSize size = full.scaled(largest, Qt::KeepAspectRatio).expandedTo({1, 1});
    makeCurrent();
    QImage picture;
    {
        QOpenGLFramebufferObject target(size);
        unsigned shown = defaultFramebufferObject();
        std::unique_ptr<QOpenGLFramebufferObject> plain;
        const bool covered = m_fade.isOn() || m_documentPicture != nullptr;
        // Grid, outline and handles are no part of what the scene looks like.
        const bool marked =
            !m_wallShown && (m_documentPicture ? m_documentPainted : m_painted).showOverlays;
        if (covered || marked) {
            plain = std::make_unique<QOpenGLFramebufferObject>(full);
            shown = plain->handle();
            const Result<void> done =
                marked ? renderPainted(shown, full, false) : presentPlain(shown, full);
            if (!done)
                logError("the picture could not be read: {}", done.error().text());
        }
        QOpenGLExtraFunctions* gl = context()->extraFunctions();
        gl->glBindFramebuffer(GL_READ_FRAMEBUFFER, shown);
        gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.handle());
        gl->glBlitFramebuffer(0, 0, full.width(), full.height(), 0, 0, size.width(), size.height(),
                              GL_COLOR_BUFFER_BIT, GL_LINEAR);
        gl->glBindFramebuffer(GL_FRAMEBUFFER, target.handle()); // which is read from, too
        picture = target.toImage().convertToFormat(QImage::Format_RGB32);
        if (marked) // as it was, for the next frame
            if (const Result<void> done = renderPainted(shown, full, true); !done)
                logError("the picture could not be drawn: {}", done.error().text());
    }
    doneCurrent();
    return picture;
}

} // namespace patina::editor
