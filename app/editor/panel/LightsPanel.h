// The Lights dock: the list with two switches for each, on and solo, and the parameters of the
// selected one.
#pragma once

#include "core/document/Document.h"

#include <QWidget>

class QLabel;
class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace patina::editor {

class DocumentController;
class ParameterList;
class SelectionModel;
class Thumbnails;

class LightsPanel : public QWidget {
    Q_OBJECT
  public:
    LightsPanel(DocumentController& controller, SelectionModel& selection, Thumbnails& thumbnails,
                QWidget* parent = nullptr);

    [[nodiscard]] QTreeWidget* list() { return m_list; }

  private:
    void refreshList();
    [[nodiscard]] QTreeWidgetItem* placed(Id light, int row);

    DocumentController& m_controller;
    SelectionModel& m_selection;
    QTreeWidget* m_list;
    QLabel* m_empty;
    QToolButton *m_duplicate, *m_remove;
    ParameterList* m_parameters;
    bool m_refreshing = false;
};

} // namespace patina::editor
