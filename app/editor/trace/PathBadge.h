// Says over the viewport how far the traced picture has come, and how certain it is; pauses it.
#pragma once

#include <QFrame>

class QLabel;
class QPushButton;

namespace patina::editor {

class PathView;
class ViewState;

class PathBadge : public QFrame {
    Q_OBJECT
  public:
    PathBadge(PathView& paths, ViewState& views, QWidget& viewport);

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void refresh();
    void place();
    [[nodiscard]] QString text() const;

    PathView& m_paths;
    ViewState& m_views;
    QWidget& m_viewport;
    QLabel* m_text;
    QPushButton* m_pause;
};

} // namespace patina::editor
