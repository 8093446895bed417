// The softboxes of the Environment dock: buttons, the list with a switch for each, and the
// parameters of the selected one.
#pragma once

#include "core/document/Document.h"

#include <QWidget>

class QListWidget;
class QListWidgetItem;
class QToolButton;

namespace patina::editor {

class DocumentController;
class ParameterList;
class Thumbnails;

class SoftboxList : public QWidget {
    Q_OBJECT
  public:
    SoftboxList(DocumentController& controller, Thumbnails& thumbnails, QWidget* parent = nullptr);

    [[nodiscard]] Id selected() const { return m_selected; } // 0: none
    void select(Id softbox);
    void selectFirst();
    void remove(Id softbox); // and selects its neighbour
    [[nodiscard]] QListWidget* list() { return m_list; }

  Q_SIGNALS:
    void selectionChanged();

  private:
    [[nodiscard]] QWidget* makeButtons();
    void refresh();

    DocumentController& m_controller;
    Id m_selected = 0;
    QListWidget* m_list;
    QToolButton *m_duplicate, *m_remove;
    ParameterList* m_parameters;
    bool m_refreshing = false;
};

} // namespace patina::editor
