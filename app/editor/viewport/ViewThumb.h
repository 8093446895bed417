// One view of the strip or the equation bar: a small picture of it with its name.
#pragma once

#include "core/document/Views.h"

#include <QAbstractButton>
#include <QImage>

namespace patina::editor {

class ViewThumb : public QAbstractButton {
    Q_OBJECT
  public:
    static constexpr QSize kPicture{104, 65}, kSmallPicture{84, 52};

    explicit ViewThumb(ViewKind kind, QWidget* parent = nullptr);

    [[nodiscard]] ViewKind kind() const { return m_kind; }
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    void setPicture(const QImage& picture);  // in device pixels
    void setCurrent(bool shown, bool other); // on which side of the split
    void setWhyEmpty(const QString& why);    // not empty: there is nothing to draw
    void setMuted(bool muted);               // switched off in the picture
    void makeSmall();                        // and without its name, which stands elsewhere
    [[nodiscard]] QSize pictureSize() const { return m_size; }
    [[nodiscard]] bool isEmpty() const { return !m_why.isEmpty(); }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

  Q_SIGNALS:
    void doubleClicked();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    void paintPicture(QPainter& painter, const QRect& place) const;

    ViewKind m_kind;
    QSize m_size = kPicture;
    QImage m_picture; // null: none yet
    QString m_why;
    bool m_shown = false, m_other = false, m_muted = false;
};

} // namespace patina::editor
