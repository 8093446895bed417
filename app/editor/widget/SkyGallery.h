// The built-in skies as a grid of small pictures.
#pragma once

#include <QWidget>
#include <vector>

class QToolButton;

namespace patina::editor {

class BackgroundTasks;

class SkyGallery : public QWidget {
    Q_OBJECT
  public:
    explicit SkyGallery(QWidget* parent = nullptr);
    // Pictures are made the first time the gallery is seen.
    void setTasks(BackgroundTasks& tasks) { m_tasks = &tasks; }
    void setCurrent(const QString& source); // "builtin:studio", or a file: none is marked

  Q_SIGNALS:
    void chosen(const QString& source);

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    void makePictures();

    struct Sky {
        QString source;
        QToolButton* button;
    };
    BackgroundTasks* m_tasks = nullptr;
    bool m_requested = false;
    std::vector<Sky> m_skies;
};

} // namespace patina::editor
