// Says over the viewport how far the traced picture has come, and how certain it is; pauses it, and
// chooses what of it and of its difference from the drawn one is shown.
#pragma once

#include <QFrame>

class QBoxLayout;
class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace patina::editor {

class PathError;
class PathView;
class TracedSide;
class WhittedHeat;

class PathBadge : public QFrame {
    Q_OBJECT
  public:
    // `remedy`: for its row.
    PathBadge(PathView& paths, PathError& error, WhittedHeat& heat, TracedSide& side,
              QPushButton* remedy, QWidget& viewport);

  Q_SIGNALS:
    void saveWanted(); // of the picture as it is now

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void addWhitted(QBoxLayout& row); // what of a classical picture is shown
    void refresh();
    void place();
    [[nodiscard]] QString text() const;

    PathView& m_paths;
    PathError& m_error;
    WhittedHeat& m_heat;
    TracedSide& m_side;
    QWidget& m_viewport;
    QLabel* m_text;
    QComboBox *m_shown, *m_whittedShown;
    QSpinBox* m_boxes;
    QPushButton *m_save, *m_pause;
};

} // namespace patina::editor
