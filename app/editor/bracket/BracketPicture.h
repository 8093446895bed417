// The merged photos as a picture, at a chosen exposure, with what is doubtful in colours.
#pragma once

#include "core/bracket/BracketPreview.h"

#include <QImage>
#include <QWidget>
#include <memory>

namespace patina::editor {

class BracketPicture : public QWidget {
    Q_OBJECT
  public:
    explicit BracketPicture(QWidget* parent = nullptr);

    void setPreview(std::shared_ptr<const BracketPreview> preview); // null: none
    void setExposure(double ev);
    void setMarks(bool on);
    void setMessage(const QString& message,
                    bool isError = false); // in place of a picture, or over it
    [[nodiscard]] const QString& message() const { return m_message; }
    [[nodiscard]] const QImage& image() const { return m_image; }

    [[nodiscard]] QSize sizeHint() const override { return {560, 300}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {320, 170}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void draw();

    std::shared_ptr<const BracketPreview> m_preview;
    QImage m_image;
    QString m_message;
    float m_ev = 0.0f;
    bool m_marks = true, m_isError = false;
};

} // namespace patina::editor
