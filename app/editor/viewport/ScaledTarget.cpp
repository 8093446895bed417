#include "app/editor/viewport/ScaledTarget.h"

#include <QOpenGLFramebufferObject>

namespace patina::editor {

ScaledTarget::ScaledTarget() = default;
ScaledTarget::~ScaledTarget() = default;

unsigned ScaledTarget::begin(const QSize& size, const QSize& full, unsigned widget) {
    m_size = size;
    m_full = full;
    if (size == full)
        return widget;
    if (!m_buffer || m_buffer->size() != size)
        m_buffer = std::make_unique<QOpenGLFramebufferObject>(size);
    return m_buffer->handle();
}

void ScaledTarget::end() {
    if (m_size != m_full)
        QOpenGLFramebufferObject::blitFramebuffer(nullptr, QRect(QPoint(), m_full), m_buffer.get(),
                                                  QRect(QPoint(), m_size), GL_COLOR_BUFFER_BIT,
                                                  GL_LINEAR);
}

void ScaledTarget::reset() {
    m_buffer.reset();
}

} // namespace patina::editor
