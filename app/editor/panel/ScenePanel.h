// The Scene dock: meshes with their visibility and material, and the materials; below them where
// the selected mesh stands.
#pragma once

#include <QWidget>

class QTreeView;

namespace patina::editor {

class Actions;
class DocumentController;
class SceneModel;
class SelectionModel;
class Thumbnails;

class ScenePanel : public QWidget {
    Q_OBJECT
  public:
    ScenePanel(DocumentController& controller, SelectionModel& selection, Thumbnails& thumbnails,
               const Actions& actions, QWidget* parent = nullptr);

    [[nodiscard]] QTreeView* tree() { return m_tree; }

  Q_SIGNALS:
    void frameRequested(); // the selected mesh

  private:
    void showSelection();
    void takeSelection();
    void clicked(const QModelIndex& index);
    void openMenu(const QPoint& at);

    DocumentController& m_controller;
    SelectionModel& m_selection;
    const Actions& m_actions;
    SceneModel* m_model;
    QTreeView* m_tree;
    bool m_showing = false; // the tree follows the selection, not the other way round
};

} // namespace patina::editor
