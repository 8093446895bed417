// Captions of the wall over the viewport, the frame of the current cell, and what stands in the
// place of pictures that are not there. Keys: the arrows choose a cell, Enter enlarges it.
#pragma once

#include "app/editor/wall/WallLayout.h"

#include <QWidget>

namespace patina::editor {

class WallState;

class WallOverlay : public QWidget {
    Q_OBJECT
  public:
    // Covers `viewport` while the wall is on.
    WallOverlay(WallState& wall, QWidget& viewport);

    [[nodiscard]] const WallLayout& layoutOfWall() const { return m_layout; }

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] bool pressKey(int key);

    WallState& m_wall;
    QWidget& m_viewport;
    WallLayout m_layout;
};

} // namespace patina::editor
