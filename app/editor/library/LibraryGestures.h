// What the pointer and the keys do in the grid beyond choosing: a drag in the thumbnail of the
// environment that lights the scene rotates it, and one that the pointer rests on is previewed.
#pragma once

#include "app/editor/library/EnvironmentTurn.h"

#include <QObject>
#include <QTimer>

class QKeyEvent;
class QMouseEvent;

namespace patina::editor {

class EnvironmentLibrary;
class EnvironmentPreview;
class LibraryView;

class LibraryGestures : public QObject {
    Q_OBJECT
  public:
    static constexpr int kRestMs = 250; // of the pointer, until what it is on is previewed

    // Sees the events of `view` and of `panel` around it.
    LibraryGestures(EnvironmentLibrary& library, EnvironmentPreview& preview, LibraryView& view,
                    QWidget& panel);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    [[nodiscard]] bool canTurnAt(const QPoint& position, Qt::KeyboardModifiers keys) const;
    bool press(const QMouseEvent& event); // these: whether it is the grid's no more
    bool move(const QMouseEvent& event);
    bool release(const QMouseEvent& event);
    bool pressKey(const QKeyEvent& event);
    bool leave(); // Esc: what it ends, if anything

    void hover(const QPoint& position);
    void endHover(const QString& source); // it is not previewed before the pointer leaves it

    EnvironmentLibrary& m_library;
    EnvironmentPreview& m_preview;
    LibraryView& m_view;
    QString m_hovered; // the source that the pointer is on; empty: none
    QTimer m_rest;     // while it moves
    EnvironmentTurn m_turn;
    bool m_turning = false;    // a drag does
    bool m_turnsByKey = false; // the last key did: the next one is part of its undo step
    double m_lastX = 0.0;
};

} // namespace patina::editor
