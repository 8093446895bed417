// The mark of the pinned point over the viewport: a ring, broken while the point is hidden.
#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>

namespace patina::editor {

class PinMarker : public QWidget {
    Q_OBJECT
  public:
    explicit PinMarker(QWidget& viewport); // covers it and lets all events through

    void setPlace(std::optional<QPointF> place); // nothing: no mark
    void setBroken(bool broken);                 // something lies in front of the point
    [[nodiscard]] const std::optional<QPointF>& place() const { return m_place; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void updateMark(); // no more than the mark: the viewport below need not be composed anew

    std::optional<QPointF> m_place;
    bool m_broken = false;
};

} // namespace patina::editor
