// The Environment dock: what surrounds and lights the scene.
#pragma once

#include <QWidget>

class QLabel;

namespace patina::editor {

class BackgroundTasks;
class DocumentController;
class ParameterList;
class SkyGallery;
class Thumbnails;

class EnvironmentPanel : public QWidget {
    Q_OBJECT
  public:
    EnvironmentPanel(DocumentController& controller, Thumbnails& thumbnails,
                     QWidget* parent = nullptr);

    [[nodiscard]] SkyGallery* gallery() { return m_gallery; }

  private:
    void refresh();
    void browse();

    DocumentController& m_controller;
    BackgroundTasks* m_previews; // of its own: opening a document must not end it
    SkyGallery* m_gallery;
    QLabel* m_source;
    ParameterList* m_parameters;
};

} // namespace patina::editor
