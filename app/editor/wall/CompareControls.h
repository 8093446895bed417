// With which cell or file the enlarged cell is compared, and how.
#pragma once

#include <QWidget>

class QCheckBox;
class QComboBox;
class QLabel;
class QToolButton;

namespace patina::editor {

class NumberField;
class WallComparison;
class WallState;

class CompareControls : public QWidget {
    Q_OBJECT
  public:
    CompareControls(WallState& wall, WallComparison& comparison, QWidget* parent = nullptr);
    void refresh();

  private:
    void fillOthers();
    void chooseFile();
    void showNumbers();

    WallState& m_wall;
    WallComparison& m_comparison;
    QComboBox *m_other, *m_mode;
    NumberField *m_blend, *m_rate;
    QCheckBox *m_visible, *m_stretch, *m_match;
    QToolButton* m_swap;
    QLabel* m_numbers;
};

} // namespace patina::editor
