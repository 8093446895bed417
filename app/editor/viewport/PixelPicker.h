// Looks at the pixel under the pointer and at the pinned point, after frames and between them,
// while somebody listens to the probe. Alt + click pins; the pin stays on the surface.
#pragma once

#include "app/editor/viewport/FrameSchedule.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/viewport/SurfacePin.h"
#include "core/base/Result.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPoint>
#include <QSize>
#include <functional>
#include <optional>

class QMouseEvent;

namespace patina::editor {

class DocumentController;
class PinMarker;

class PixelPicker : public QObject {
    Q_OBJECT
  public:
    // How a pixel of the last frame is looked at; never called while a frame is being drawn.
    using Inspect = std::function<Result<render::Inspection>(const QPoint& pixel)>;

    // Looks in its turn of `schedule`, which outlives it.
    PixelPicker(DocumentController& controller, QWidget& viewport, FrameSchedule& schedule);

    void setProbe(PixelProbe& probe);
    void setInspect(Inspect inspect) { m_inspect = std::move(inspect); }

    // After a frame of `size` device pixels, none when it is gone; `moving`: others will follow
    // soon.
    void frameDrawn(const QSize& size, bool moving);
    // Whether looking costs no more than its frame; else notReady() says that somebody wants to.
    void setReady(bool ready);
    void placeMark(); // before a frame, so that the mark goes along in it

    void togglePin();              // at the pointer, or take the pin away
    void pinAt(const QPointF& at); // beside the model: takes the pin away
    void setPicking(bool picking); // the next click pins
    [[nodiscard]] bool isPicking() const { return m_picking; }

    // Milliseconds that the last look took.
    [[nodiscard]] double lookMs() const { return m_lookMs; }

  Q_SIGNALS:
    void pickingChanged(bool picking);
    void pinned(); // by the user
    void notReady();

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void look(); // at what is wanted
    void lookSoon();
    void lookAtPin();
    void refinePin();
    void unpin();
    [[nodiscard]] std::optional<QPoint> pixelAt(const QPointF& position) const;
    [[nodiscard]] std::optional<render::Inspection> inspect(const QPoint& pixel);

    DocumentController& m_controller;
    QWidget& m_viewport;
    PixelProbe* m_probe = nullptr;
    PinMarker* m_mark;
    Inspect m_inspect;
    QSize m_frame;                    // the last one's, in device pixels
    std::optional<QPointF> m_pointer; // where it was last, inside
    std::optional<SurfacePin> m_pin;
    // A pin of a coarse frame is the middle of a pixel several of the window's wide: it is set
    // again in each finer frame, as long as the same point is under the place that was clicked.
    struct Clicked {
        QPointF at;
        QSize frame;
        Camera camera;
        glm::vec3 position; // the pin's, in the world
    };
    std::optional<Clicked> m_clicked;
    FrameSchedule::Task m_look;
    QElapsedTimer m_sinceLook;
    double m_lookMs = 0.0;
    bool m_ready = true;
    std::optional<QPointF> m_pinLater; // pinned before it was ready
    bool m_moving = false;
    bool m_outdated = false;   // the document has changed since the last frame
    Camera m_camera;           // of the last frame
    bool m_cameraRests = true; // it is that of the frame before
    bool m_picking = false;
    bool m_dragging = false; // a button is down
};

} // namespace patina::editor
