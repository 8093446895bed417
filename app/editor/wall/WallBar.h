// Above the viewport while it shows a wall: what that compares, and what to do with the current
// cell.
#pragma once

#include <QFrame>

class QPushButton;
class QToolButton;

namespace patina::editor {

class DocumentController;
class SelectionModel;
class WallAxisControls;
class WallComparison;
class WallState;

class WallBar : public QFrame {
    Q_OBJECT
  public:
    WallBar(WallState& wall, WallComparison& comparison, DocumentController& controller,
            SelectionModel& selection, QWidget* parent = nullptr);

  Q_SIGNALS:
    void sheetWanted(); // the wall is to be saved

  private:
    void refresh();

    WallState& m_wall;
    WallAxisControls *m_columns, *m_rows;
    QPushButton* m_use;
    QToolButton *m_enlarge, *m_save;
};

} // namespace patina::editor
