// What is being opened, over the picture of the scene that is still there; gone when the first
// picture of the new one is shown.
#pragma once

#include <QFrame>
#include <QString>

class QLabel;
class QOpenGLWidget;

namespace patina::editor {

class DocumentController;

class SceneProgress : public QFrame {
    Q_OBJECT
  public:
    SceneProgress(DocumentController& controller, QOpenGLWidget& viewport);

    void setOpening(const QString& name); // a scene is being read; empty: it has been, or failed

    // A scene has been opened and its picture is not shown yet.
    [[nodiscard]] bool pending() const { return m_state == State::Drawing; }

  Q_SIGNALS:
    void sceneShown();

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    enum class State { Idle, Reading, Drawing };
    void setState(State state, const QString& text = {});
    void place();

    QOpenGLWidget& m_viewport;
    QLabel* m_text;
    State m_state = State::Idle;
};

} // namespace patina::editor
