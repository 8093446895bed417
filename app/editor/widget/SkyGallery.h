// The built-in skies, and the last ones from files, as a grid of small pictures.
#pragma once

#include "core/image/Image.h"
#include "core/job/TaskRunner.h"

#include <QWidget>
#include <optional>
#include <vector>

class QGridLayout;
class QToolButton;

namespace patina::editor {

class SkyGallery : public QWidget {
    Q_OBJECT
  public:
    explicit SkyGallery(QWidget* parent = nullptr);
    // Pictures are made the first time the gallery is seen.
    void setRunner(TaskRunner& runner) { m_tasks.emplace(runner); }
    void setCurrent(const QString& source); // "builtin:studio", or a file
    // An environment from a file that lights the scene joins the gallery, now and in later
    // sessions, as the first of kMostRecentSkies (widget/RecentSkies.h).
    void addRecent(const QString& file, const ImagePtr& image);

  Q_SIGNALS:
    void chosen(const QString& source);

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    struct Sky {
        QString source;
        QToolButton* button;
    };
    Sky makeSky(const QString& source, const QString& title, const QString& help);
    void makePictures();
    // A small picture of the image, which follows in the background; null: none.
    void makePicture(const std::function<ImagePtr()>& image,
                     const std::function<void(const QImage&)>& show);
    void layOut();

    bool m_requested = false;
    QString m_current;
    QGridLayout* m_grid;
    std::vector<Sky> m_skies, m_recent; // built in; from files, the newest first
    std::optional<TaskGroup> m_tasks;
};

} // namespace patina::editor
