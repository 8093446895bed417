// Says over the picture what files, materials or snapshots will do that are held over the window,
// before they are let go, and frames their target. Materials and snapshots it takes itself.
#pragma once

#include "app/editor/viewport/ElementDrop.h"
#include "app/editor/wall/WallDrop.h"

#include <QObject>
#include <QRect>
#include <QStringList>
#include <QWidget>

class QDropEvent;

namespace patina::editor {

class DocumentController;
class SelectionModel;

class DropHint : public QWidget {
    Q_OBJECT
  public:
    explicit DropHint(QWidget& viewport);
    // Covers the viewport; no lines: hides. `target`: what they are dropped onto; null: all of it.
    // `veiled`: the picture is darkened; else what is aimed at in it stays clear.
    void setLines(const QStringList& lines, const QRect& target = {}, bool veiled = true);
    [[nodiscard]] const QStringList& lines() const { return m_lines; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QStringList m_lines;
    QRect m_target;
    bool m_veiled = true;
};

class DropTarget : public QObject {
    Q_OBJECT
  public:
    // Watches `window`, which takes the drops itself; `viewport` shows what they will do.
    DropTarget(QWidget& window, QWidget& viewport, DocumentController& controller,
               SelectionModel& selection, const WallDrop& wall, const ElementDrop& elements);

    // True: cells of the wall take them: draggedSources(). `position` in the window.
    [[nodiscard]] bool drop(const QStringList& files, const QPointF& position);

  protected:
    bool eventFilter(QObject* window, QEvent* event) override;

  private:
    // True: it is a material's or a snapshot's, and has been answered.
    bool takeElements(QDropEvent& event);
    void showHint(const QStringList& files, const QPointF& position);
    [[nodiscard]] QPointF inViewport(const QPointF& position) const; // from the window's

    QWidget& m_window;
    QWidget& m_viewport;
    DocumentController& m_controller;
    SelectionModel& m_selection;
    WallDrop m_wall;
    ElementDrop m_elements;
    DropHint* m_hint; // owned by the viewport
};

} // namespace patina::editor
