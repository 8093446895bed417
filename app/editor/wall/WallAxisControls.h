// What the columns or rows of the wall compare: environments, materials, lighting modes, tone
// curves, snapshots, which of them, or the values of a parameter.
#pragma once

#include "core/cells/WallPlan.h"

#include <QWidget>

class QComboBox;
class QLabel;
class QMenu;
class QToolButton;

namespace patina::editor {

class DocumentController;
class NumberField;
class SelectionModel;
class WallState;

class WallAxisControls : public QWidget {
    Q_OBJECT
  public:
    enum class Axis { Columns, Rows };
    WallAxisControls(Axis axis, WallState& wall, DocumentController& controller,
                     SelectionModel& selection, QWidget* parent = nullptr);

    void refresh(); // of the wall's plan and the document

  private:
    [[nodiscard]] AxisPlan plan() const;
    void setPlan(const AxisPlan& plan);
    void compare(Compared compared);
    [[nodiscard]] AxisPlan firstValues() const; // of the roughness of all materials
    void fillChoices();
    void fillChoice(const AxisChoice& choice);
    void fillMeshes();
    void fillBuiltin();
    void fillParameters();
    void addParameters(QMenu& menu, const QString& title, Target target);
    void setValues(); // from the fields

    const Axis m_axis;
    WallState& m_wall;
    DocumentController& m_controller;
    SelectionModel& m_selection;
    QComboBox* m_compared;
    QToolButton *m_choices, *m_parameter; // what is compared; whose values
    QMenu *m_choiceMenu, *m_parameterMenu;
    NumberField *m_from, *m_to, *m_count;
    QList<QWidget*> m_valueWidgets;
};

} // namespace patina::editor
