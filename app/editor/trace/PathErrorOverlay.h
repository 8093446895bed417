// Over the viewport: how far the drawn picture is from the traced one, in colours with their
// legend, as scores of the picture and its materials, and under the pointer.
#pragma once

#include "app/editor/trace/BlameBars.h"

#include <QStringList>
#include <QWidget>
#include <optional>

namespace patina::editor {

class PathBlame;
class PathError;

class PathErrorOverlay : public QWidget {
    Q_OBJECT
  public:
    PathErrorOverlay(PathError& error, PathBlame& blame, QWidget& viewport);
    // A line each, as it is shown.
    [[nodiscard]] QStringList lines() const;

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] QString pointedLine() const; // of the pixel under the pointer
    // Of the material under the pointer or of the picture; without a title: there are none.
    [[nodiscard]] BlameBars causes() const;
    int paintLegend(QPainter& painter, const QRect& box, int y) const; // returns what is below

    PathError& m_error;
    PathBlame& m_blame;
    QWidget& m_viewport;
    std::optional<QPointF> m_pointer; // in the viewport
};

} // namespace patina::editor
