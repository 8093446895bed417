#include "app/editor/viewport/PictureFade.h"

#include <QMatrix4x4>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QOpenGLTextureBlitter>
#include <algorithm>
#include <utility>

namespace patina::editor {

PictureFade::PictureFade(QObject* parent)
    : QObject(parent) {
    m_since.start();
}

PictureFade::~PictureFade() = default;

void PictureFade::keep(unsigned framebuffer, const QSize& size) {
    if (!m_picture || m_picture->size() != size)
        m_picture = std::make_unique<QOpenGLFramebufferObject>(size);
    QOpenGLExtraFunctions* gl = QOpenGLContext::currentContext()->extraFunctions();
    gl->glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_picture->handle());
    gl->glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    m_on = true;
    m_shown = 1.0f;
    m_startMs = -1;
}

void PictureFade::begin() {
    if (waits())
        m_startMs = now();
}

void PictureFade::end() {
    if (std::exchange(m_on, false))
        Q_EMIT ended();
}

// Slow at both ends, as an eye expects of what moves by itself.
float PictureFade::opacity() const {
    if (m_startMs < 0)
        return 1.0f;
    const float t =
        std::clamp(static_cast<float>(now() - m_startMs) / static_cast<float>(kFadeMs), 0.0f, 1.0f);
    return 1.0f - t * t * (3.0f - 2.0f * t);
}

void PictureFade::blend(unsigned framebuffer, const QSize& size) {
    if (!m_on)
        return;
    m_shown = opacity();
    if (m_shown <= 0.0f || m_picture->size() != size) {
        end();
        return;
    }
    if (!m_blitter) {
        m_blitter = std::make_unique<QOpenGLTextureBlitter>();
        m_blitter->create();
    }
    QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->glViewport(0, 0, size.width(), size.height());
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDisable(GL_CULL_FACE);
    gl->glEnable(GL_BLEND);
    gl->glBlendColor(0.0f, 0.0f, 0.0f, m_shown);
    gl->glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    m_blitter->bind();
    m_blitter->blit(m_picture->texture(), QMatrix4x4(), QOpenGLTextureBlitter::OriginBottomLeft);
    m_blitter->release();
    gl->glDisable(GL_BLEND);
}

void PictureFade::release() {
    end();
    m_picture.reset();
    if (m_blitter)
        m_blitter->destroy();
    m_blitter.reset();
}

} // namespace patina::editor
