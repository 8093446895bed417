// Where the selected mesh stands: its position, rotation and scale, with the tools that change
// them.
#pragma once

#include <QWidget>

class QCheckBox;

namespace patina::editor {

class Actions;
class DocumentController;
class ParameterList;
class SelectionModel;
class Thumbnails;

class PlaceSection : public QWidget {
    Q_OBJECT
  public:
    PlaceSection(DocumentController& controller, SelectionModel& selection, Thumbnails& thumbnails,
                 const Actions& actions, QWidget* parent = nullptr);

  private:
    void refresh(); // hidden while no mesh is selected

    DocumentController& m_controller;
    SelectionModel& m_selection;
    ParameterList* m_parameters;
    QCheckBox* m_wholeModel;
};

} // namespace patina::editor
