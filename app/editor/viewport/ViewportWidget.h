// The picture of the document, and the hand's way into it: orbit, pan, zoom, fly, pick.
#pragma once

#include <QOpenGLWidget>

namespace patina::editor {

class DocumentController;
class SelectionModel;

class ViewportWidget : public QOpenGLWidget {
    Q_OBJECT
  public:
    ViewportWidget(DocumentController& controller, SelectionModel& selection,
                   QWidget* parent = nullptr);
    ~ViewportWidget() override;

    void frameSelection(); // the selected mesh, or everything
    void resetCamera();    // Home: the whole scene from the default side

  Q_SIGNALS:
    void contextReady(const QString& gpu, const QString& glVersion); // after initializeGL
    void contextFailed(const QString& reason); // no OpenGL 4.5: the widget stays grey
    void frameRendered(double milliseconds);
};

} // namespace patina::editor
