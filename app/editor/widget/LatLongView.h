// The environment as a lat-long picture to light with: the sun and softboxes are dragged in it, an
// image is turned. It changes nothing itself: it says what is wanted and shows what it is given.
#pragma once

#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/LatLongMap.h"
#include "core/document/Document.h"

#include <QImage>
#include <QWidget>

namespace patina::editor {

class LatLongView : public QWidget, public EditControl {
    Q_OBJECT
  public:
    explicit LatLongView(QWidget* parent = nullptr);

    void setEnvironment(const Environment& environment); // payloads are not looked at
    void setPicture(const QImage& picture);              // of the environment as it is, unturned
    void setSelected(Id softbox);                        // 0: none
    [[nodiscard]] Id selected() const { return m_selected; }
    void abandonEdit() override { m_pressed = m_dragging = false; }

    // Of the picture as it is shown: an image with its own middle (behind the model), what is
    // edited with the model's front in the middle, where most lights are.
    [[nodiscard]] LatLongMap map() const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    // What follows until dragFinished() is one edit; after dragCancelled() nothing follows, and all
    // is to be as it was. The three below come alone from the keyboard.
    void dragStarted();
    void dragFinished();
    void dragCancelled();
    void sunMoved(double azimuthDeg, double elevationDeg);
    void turned(double rotationDeg);
    void softboxShaped(const patina::Softbox& softbox);

    void softboxSelected(patina::Id softbox);
    void addRequested(double azimuthDeg, double elevationDeg);
    void removeRequested(patina::Id softbox);
    void resized(); // another picture size is wanted

  protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

  private:
    [[nodiscard]] const Softbox* selectedSoftbox() const;
    [[nodiscard]] const Softbox* softboxAt(const QPointF& point) const;
    [[nodiscard]] QPointF sunPoint() const;
    void hover(const QPointF& point);
    void follow(); // applies the drag at m_at
    void endDrag(bool cancel);
    bool nudge(const QPointF& degrees);
    void paintCompass(QPainter& painter) const;
    void paintSun(QPainter& painter) const;
    void paintSoftboxes(QPainter& painter) const;
    void paintHint(QPainter& painter, const QString& text) const;
    void updateHelp();

    Environment m_environment; // without images
    QImage m_picture;
    Id m_selected = 0, m_hovered = 0;
    bool m_overSun = false;

    // A drag: the mouse's way is followed as a point of its own, which Shift makes slow.
    bool m_pressed = false, m_dragging = false, m_shift = false;
    SoftboxHandle m_handle = SoftboxHandle::None;
    QPointF m_from, m_at, m_mouse;
    Environment m_start; // when the drag began
    LatLongMap m_startMap;
};

} // namespace patina::editor
