// The Material dock: which material is edited, the library to start from, and its parameters.
#pragma once

#include <QWidget>

class QComboBox;
class QToolButton;

namespace patina::editor {

class DocumentController;
class ParameterList;
class SelectionModel;
class Thumbnails;

class MaterialPanel : public QWidget {
    Q_OBJECT
  public:
    MaterialPanel(DocumentController& controller, SelectionModel& selection, Thumbnails& thumbnails,
                  QWidget* parent = nullptr);

    [[nodiscard]] ParameterList* parameters() { return m_parameters; }

  private:
    void refreshChoice();

    DocumentController& m_controller;
    SelectionModel& m_selection;
    QComboBox* m_choice;
    QToolButton* m_library;
    ParameterList* m_parameters;
};

} // namespace patina::editor
