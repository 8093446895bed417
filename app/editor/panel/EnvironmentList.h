// The environments of the scene in the Environment dock: buttons, and, where there are several, the
// list of them. The current one lights the scene, and the dock edits it.
#pragma once

#include "core/document/Document.h"

#include <QWidget>

class QListWidget;
class QListWidgetItem;
class QMenu;
class QToolButton;

namespace patina::editor {

class DocumentController;

class EnvironmentList : public QWidget {
    Q_OBJECT
  public:
    explicit EnvironmentList(DocumentController& controller, QWidget* parent = nullptr);

    [[nodiscard]] QListWidget* list() { return m_list; }
    // What an environment is called in the editor: by its name, or by what it shows.
    [[nodiscard]] static QString titleOf(const Environment& environment);

  private:
    [[nodiscard]] QWidget* makeButtons();
    void fillAdd(QMenu& menu);
    void openImage();
    void refresh();

    DocumentController& m_controller;
    QListWidget* m_list;
    QToolButton *m_duplicate, *m_remove;
    bool m_refreshing = false;
};

} // namespace patina::editor
