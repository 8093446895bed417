// The Environment dock: what surrounds and lights the scene.
#pragma once

#include "app/editor/document/DocumentController.h"

#include <QWidget>
#include <array>

class QLabel;
class QToolButton;

namespace patina::editor {

class LatLongPicture;
class LatLongView;
class ParameterList;
class SkyGallery;
class SoftboxList;
class Thumbnails;

class EnvironmentPanel : public QWidget {
    Q_OBJECT
  public:
    EnvironmentPanel(DocumentController& controller, Thumbnails& thumbnails,
                     QWidget* parent = nullptr);

    [[nodiscard]] SkyGallery* gallery() { return m_gallery; }
    [[nodiscard]] LatLongView* view() { return m_view; }
    [[nodiscard]] SoftboxList* softboxes() { return m_softboxes; }

  Q_SIGNALS:
    void saveRequested();

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeOff();
    [[nodiscard]] QWidget* makeKinds();
    [[nodiscard]] QWidget* makeImageControls();
    void connectView();
    // An edit from the view: of the drag that goes on, or a step of the keyboard.
    void edit(Target target, const std::vector<ParameterEdit>& edits, const QString& text);
    void cancelDrag();
    void refresh();
    void refreshPicture();
    void browse();

    DocumentController& m_controller;
    QWidget* m_off; // says that it is
    std::array<QToolButton*, 3> m_kinds{};
    LatLongView* m_view;
    LatLongPicture* m_picture;
    SkyGallery* m_gallery;
    QLabel* m_source;
    QWidget* m_imageControls;
    SoftboxList* m_softboxes;
    ParameterList* m_parameters;

    DragSession m_session = 0, m_stepSession = 0;
    qint64 m_lastStepMs = 0;
    Target m_editTarget; // of the drag, with the values from before it
    std::vector<ParameterEdit> m_before;
};

} // namespace patina::editor
