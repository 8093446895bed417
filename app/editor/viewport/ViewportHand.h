// The hand in the viewport: mouse and keys become camera moves, a rotated environment and rotated
// lights.
//
//  left drag            orbit            wheel          zoom
//  middle / Shift+left  pan              click          select
//  right drag           look around, with W A S D Q E to fly; the wheel then sets the speed
//  Shift+right drag     turn the environment (one undo step)
//  Ctrl+right drag      turn the selected light about the scene, or the environment when none is
//  drag a light's mark or handles to move and aim it, or the handles of the selected mesh to move,
//  rotate and scale it (Ctrl snaps); Esc takes the drag back
#pragma once

#include "app/editor/viewport/FlyKeys.h"
#include "app/editor/viewport/LightDrag.h"
#include "app/editor/viewport/MeshDrag.h"

#include <QObject>
#include <QPointF>

class QKeyEvent;
class QMouseEvent;
class QWheelEvent;

namespace patina::editor {

class ViewportHand : public QObject {
    Q_OBJECT
  public:
    // Listens to the events of `viewport` and sets its cursor. `schedule`: the viewport's.
    ViewportHand(DocumentController& controller, SelectionModel& selection, QWidget& viewport,
                 FrameSchedule& schedule);

    void setHandlesVisible(bool visible) {
        m_lights.setVisible(visible);
        m_meshes.setVisible(visible);
    }
    [[nodiscard]] MeshDrag& meshes() { return m_meshes; }
    [[nodiscard]] bool holding() const; // a button or a flying key
    // Of the picture, in the viewport's pixels, by which a drag moves the camera; 0: the
    // viewport's.
    void setPictureHeight(int height) { m_pictureHeight = height; }

  Q_SIGNALS:
    void cameraMoved();
    void clicked(const QPointF& position); // pressed and released without moving, on no handle
    void doubleClicked(const QPointF& position);

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    enum class Drag { None, Orbit, Pan, Look, TurnEnvironment, TurnLight, LightHandle, MeshHandle };

    void press(const QMouseEvent& event);
    void move(const QMouseEvent& event);
    void release(const QMouseEvent& event);
    void wheel(const QWheelEvent& event);
    [[nodiscard]] bool pressKey(const QKeyEvent& event); // false: means nothing here
    [[nodiscard]] bool ownsKeys() const;
    void setCamera(const Camera& camera);
    void turnEnvironment(float pixels);
    [[nodiscard]] bool dragsThing() const; // not the camera, nor the environment

    DocumentController& m_controller;
    QWidget& m_viewport;
    LightDrag m_lights;
    MeshDrag m_meshes;
    FlyKeys m_fly;
    Drag m_drag = Drag::None;
    int m_pictureHeight = 0;
    QPointF m_pressPosition, m_lastPosition;
    bool m_pressIsClick = false; // no movement since the press
    quint64 m_turnSession = 0;   // of the environment
};

} // namespace patina::editor
