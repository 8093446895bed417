// The Ray Tree dock: the rays of a pixel of the classical ray tracer's picture, with what each
// adds to it and why each branch ended.
#pragma once

#include <QList>
#include <QWidget>

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QStackedWidget;
class QTreeWidget;
class QTreeWidgetItem;

namespace patina::editor {

class DocumentController;
class ElidedLabel;
class PathView;
class RayTreeProbe;

class RayTreePanel : public QWidget {
    Q_OBJECT
  public:
    RayTreePanel(RayTreeProbe& probe, PathView& paths, DocumentController& controller,
                 QWidget* parent = nullptr);
    ~RayTreePanel() override;

    [[nodiscard]] QSize sizeHint() const override { return {780, 280}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {240, 160}; }

  Q_SIGNALS:
    void pictureWanted(); // the classical one, in the viewport

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeEmpty();
    [[nodiscard]] QWidget* makeHeader();
    void makeTree();
    void refresh();
    void fill();
    void select(); // the probe's node
    void edit();   // the settings of the picture

    RayTreeProbe& m_probe;
    PathView& m_paths;
    DocumentController& m_controller;
    QStackedWidget* m_pages;
    QLabel* m_message;
    QPushButton* m_show;
    ElidedLabel* m_title;
    QComboBox* m_model;
    QSpinBox* m_depth;
    QTreeWidget* m_tree;
    QList<QTreeWidgetItem*> m_items; // of the nodes
    const void* m_filled = nullptr;  // the tree that they are of
    bool m_filling = false;
};

} // namespace patina::editor
