// A board of plots: as many columns as make them largest, all in view when they fit and scrolled
// when they would become too small to read.
#pragma once

#include <QList>
#include <QScrollArea>

namespace patina::editor {

class TileArea : public QScrollArea {
    Q_OBJECT
  public:
    explicit TileArea(QSize smallestTile, QWidget* parent = nullptr);

    void add(QWidget* tile);                     // takes ownership
    void setShown(const QList<QWidget*>& tiles); // of those added; the others are hidden
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void arrange();

    QSize m_smallest;
    QList<QWidget*> m_tiles, m_shown;
};

} // namespace patina::editor
