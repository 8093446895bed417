// Where a frame is drawn: straight into the widget's buffer, or, when it has fewer pixels, into one
// of its own that is then stretched.
#pragma once

#include <QSize>
#include <memory>

class QOpenGLFramebufferObject;

namespace patina::editor {

class ScaledTarget {
  public:
    ScaledTarget();
    ~ScaledTarget();

    // The buffer for a frame of `size`, in device pixels; `widget` is one of `full` pixels.
    [[nodiscard]] unsigned begin(const QSize& size, const QSize& full, unsigned widget);
    void end();   // stretches what was drawn into the widget's buffer
    void reset(); // with the context current that made it

  private:
    std::unique_ptr<QOpenGLFramebufferObject> m_buffer;
    QSize m_size, m_full;
};

} // namespace patina::editor
