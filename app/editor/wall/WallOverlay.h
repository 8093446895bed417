// Captions of the wall over the viewport, the frame of the current cell, badges of traced ones,
// what stands in the place of pictures that are not there, the difference of two that are compared.
// Keys: the arrows choose a cell, Enter enlarges it, Space shows the other one of two.
#pragma once

#include "app/editor/wall/WallLayout.h"

#include <QWidget>

namespace patina::editor {

class TracedCells;
class WallComparison;
class WallState;

class WallOverlay : public QWidget {
    Q_OBJECT
  public:
    // Covers `viewport` while the wall is on.
    WallOverlay(WallState& wall, WallComparison& comparison, const TracedCells& traced,
                QWidget& viewport);

    [[nodiscard]] const WallLayout& layoutOfWall() const { return m_layout; }
    // By what a cell is traced, and how far that is; empty: it is drawn.
    struct Badge {
        QRect place;
        QString text; // as it fits
        QString help; // all of it, and what it means
    };
    [[nodiscard]] Badge badgeOf(std::size_t cell) const;

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] bool pressKey(int key);
    void showHelp(const QPoint& position, const QPoint& onScreen) const;
    void paintOwnValues(QPainter& painter) const;
    void paintBadges(QPainter& painter) const;
    void paintFile(QPainter& painter, const QRect& area) const;
    void paintDifference(QPainter& painter, const QRect& area) const;

    WallState& m_wall;
    WallComparison& m_comparison;
    const TracedCells& m_traced;
    QWidget& m_viewport;
    WallLayout m_layout;
};

} // namespace patina::editor
