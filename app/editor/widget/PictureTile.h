// A lat-long picture with a title and a line below it.
#pragma once

#include <QImage>
#include <QWidget>

namespace patina::editor {

class PictureTile : public QWidget {
    Q_OBJECT
  public:
    explicit PictureTile(const QString& title, QWidget* parent = nullptr);

    void setTitle(const QString& title);
    void setPicture(const QImage& picture, const QString& note);
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    [[nodiscard]] QString note() const { return m_note; }
    [[nodiscard]] QSize sizeHint() const override { return {340, 200}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 116}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QString m_title, m_note;
    QImage m_picture;
};

} // namespace patina::editor
