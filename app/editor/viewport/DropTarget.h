// Says over the picture what files will do that are held over the window, before they are let go,
// and frames the picture as their target.
#pragma once

#include "app/editor/wall/WallDrop.h"

#include <QObject>
#include <QRect>
#include <QStringList>
#include <QWidget>

namespace patina::editor {

class DocumentController;
class SelectionModel;

class DropHint : public QWidget {
    Q_OBJECT
  public:
    explicit DropHint(QWidget& viewport);
    // Covers the viewport; no lines: hides. `target`: what they are dropped onto; null: all of it.
    void setLines(const QStringList& lines, const QRect& target = {});
    [[nodiscard]] const QStringList& lines() const { return m_lines; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QStringList m_lines;
    QRect m_target;
};

class DropTarget : public QObject {
    Q_OBJECT
  public:
    // Watches `window`, which takes the drops itself; `viewport` shows what they will do.
    DropTarget(QWidget& window, QWidget& viewport, DocumentController& controller,
               SelectionModel& selection, const WallDrop& wall);

    // True: cells of the wall take them: draggedSources(). `position` in the window.
    [[nodiscard]] bool drop(const QStringList& files, const QPointF& position);

  protected:
    bool eventFilter(QObject* window, QEvent* event) override;

  private:
    void showHint(const QStringList& files, const QPointF& position);
    [[nodiscard]] QPointF inViewport(const QPointF& position) const; // from the window's

    QWidget& m_window;
    QWidget& m_viewport;
    DocumentController& m_controller;
    SelectionModel& m_selection;
    WallDrop m_wall;
    DropHint* m_hint; // owned by the viewport
};

} // namespace patina::editor
