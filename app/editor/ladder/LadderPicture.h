// Two pictures of a ladder on the two sides of a line that is dragged: a method and what it is
// compared with.
#pragma once

#include <QImage>
#include <QString>
#include <QWidget>

namespace patina::editor {

class LadderPicture : public QWidget {
    Q_OBJECT
  public:
    explicit LadderPicture(QWidget* parent = nullptr);

    struct Side {
        QString name;
        QImage picture; // null: `note` in its place
        QString note;
        friend bool operator==(const Side&, const Side&) = default;
    };
    // Left of the line and right of it.
    void setSides(const Side& left, const Side& right);
    [[nodiscard]] const Side& left() const { return m_left; }
    [[nodiscard]] const Side& right() const { return m_right; }

    // 0: all of the right one is seen, 1: all of the left one.
    [[nodiscard]] double line() const { return m_line; }
    void setLine(double line);

    [[nodiscard]] QSize sizeHint() const override { return {420, 236}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 90}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    [[nodiscard]] QRect area() const; // of the pictures
    void paintSide(QPainter& painter, const Side& side, const QRect& clip, bool left) const;

    Side m_left, m_right;
    double m_line = 0.5;
};

} // namespace patina::editor
