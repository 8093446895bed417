// The picture that was shown before another environment lights the scene: it lies over the new one
// and fades out. It is displayed and nothing else: the frames below it, and whoever reads them, do
// not contain it. Drawn with the viewport's context current.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QSize>
#include <functional>
#include <memory>
#include <utility>

class QOpenGLFramebufferObject;
class QOpenGLTextureBlitter;

namespace patina::editor {

class PictureFade : public QObject {
    Q_OBJECT
  public:
    static constexpr qint64 kFadeMs = 300;

    explicit PictureFade(QObject* parent = nullptr);
    ~PictureFade() override;

    // Keeps what the framebuffer shows, also where that is a picture that fades: shown in full
    // until begin().
    void keep(unsigned framebuffer, const QSize& size);
    void begin(); // the picture below it is the new one from now on
    void end();   // at once
    [[nodiscard]] bool isOn() const { return m_on; }
    [[nodiscard]] bool waits() const { return m_on && m_startMs < 0; } // for begin()
    // Lays it over what the framebuffer shows; a picture of another size ends it.
    void blend(unsigned framebuffer, const QSize& size);
    // Whether blend() would show something else than it did last: its clock has moved.
    [[nodiscard]] bool hasMoved() const { return m_on && opacity() != m_shown; }
    void release(); // what it has in the context

    // Milliseconds that pass, in place of those that do (tests stop it); empty: those that do.
    void setClock(std::function<qint64()> clock) { m_clock = std::move(clock); }

  Q_SIGNALS:
    void ended();

  private:
    [[nodiscard]] float opacity() const;
    [[nodiscard]] qint64 now() const { return m_clock ? m_clock() : m_since.elapsed(); }

    std::function<qint64()> m_clock;
    QElapsedTimer m_since;
    bool m_on = false;
    float m_shown = 1.0f;  // by the last blend()
    qint64 m_startMs = -1; // below 0: it has not begun to fade
    std::unique_ptr<QOpenGLFramebufferObject> m_picture;
    std::unique_ptr<QOpenGLTextureBlitter> m_blitter;
};

} // namespace patina::editor
