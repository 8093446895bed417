// The small pictures of two looks and what is seen to differ between them (FLIP), side by side.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "core/image/Image.h"

#include <QImage>
#include <QWidget>
#include <utility>

namespace patina::editor {

[[nodiscard]] QImage qImageOf(const Image& image); // U8, three channels
[[nodiscard]] ImagePtr imageOf(const QImage& picture);

class LookPictures : public QWidget {
    Q_OBJECT
  public:
    explicit LookPictures(TaskRunner& runner, QWidget* parent = nullptr);

    struct Side {
        QString name;
        ImagePtr picture; // null: there is none
        QString absence;  // why
    };
    // `note`: what keeps the two from being comparable ("the camera has moved"); may be empty.
    void setSides(const Side& a, const Side& b, const QString& note);
    void clear();

    [[nodiscard]] const QImage& difference() const { return m_difference; } // null: none yet
    [[nodiscard]] double meanFlip() const { return m_mean; }
    [[nodiscard]] bool isMeasuring() const { return m_job.busy(); }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void measured();

  protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override;

  private:
    void measure();
    [[nodiscard]] static std::pair<QImage, QImage> commonMiddle(const QImage& a, const QImage& b);
    void say(const QString& text);
    [[nodiscard]] QString note() const;
    [[nodiscard]] QRect tile(int index) const;

    Side m_a, m_b;
    QString m_note, m_problem; // why there is no difference
    QImage m_pictureA, m_pictureB, m_difference;
    bool m_cropped = false; // m_difference, to what both show
    double m_mean = 0.0;
    LatestJob m_job; // last: it ends first
};

} // namespace patina::editor
