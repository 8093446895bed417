#include "app/editor/panel/ScenePanel.h"

#include "app/editor/Actions.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/PlaceSection.h"
#include "app/editor/panel/SceneModel.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "core/material/Material.h"

#include <QHeaderView>
#include <QMenu>
#include <QTreeView>
#include <QVBoxLayout>

namespace patina::editor {

ScenePanel::ScenePanel(DocumentController& controller, SelectionModel& selection,
                       Thumbnails& thumbnails, const Actions& actions, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_actions(actions)
    , m_model(new SceneModel(controller, thumbnails, this))
    , m_tree(new QTreeView) {
    m_tree->setModel(m_model);
    m_tree->setHeaderHidden(true);
    m_tree->setUniformRowHeights(true); // 100,000 meshes stay fluid
    m_tree->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    m_tree->setIconSize({16, 16});
    m_tree->setIndentation(14);
    m_tree->setDragDropMode(QAbstractItemView::DragDrop);
    m_tree->setAccessibleName(tr("Meshes and materials of the scene"));
    m_tree->setStatusTip(
        tr("Click to select, F2 to rename, right-click for more; drag a material onto a "
           "mesh or a cell of a wall"));
    QHeaderView* header = m_tree->header();
    header->setStretchLastSection(false);
    header->setMinimumSectionSize(20);
    header->setSectionResizeMode(SceneModel::NameColumn, QHeaderView::Stretch);
    header->setSectionResizeMode(SceneModel::MaterialColumn, QHeaderView::Interactive);
    header->setSectionResizeMode(SceneModel::MarkColumn, QHeaderView::Fixed);
    header->resizeSection(SceneModel::MaterialColumn, 96);
    header->resizeSection(SceneModel::MarkColumn, 28);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, 0, tokens::kGap, tokens::kGap);
    layout->addWidget(m_tree, 1);
    layout->addWidget(new PlaceSection(controller, selection, thumbnails, actions));

    connect(m_model, &QAbstractItemModel::modelReset, this, [this] {
        m_tree->expandAll();
        showSelection();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, &ScenePanel::showSelection);
    connect(m_tree->selectionModel(), &QItemSelectionModel::currentChanged, this,
            &ScenePanel::takeSelection);
    connect(m_tree, &QTreeView::clicked, this, &ScenePanel::clicked);
    connect(m_tree, &QTreeView::customContextMenuRequested, this, &ScenePanel::openMenu);
    m_tree->expandAll();
}

void ScenePanel::showSelection() {
    const QModelIndex index = m_selection.mesh() != 0
                                  ? m_model->indexOf({Scope::Mesh, m_selection.mesh()})
                                  : m_model->indexOf({Scope::Material, m_selection.material()});
    m_showing = true;
    m_tree->setCurrentIndex(index);
    m_showing = false;
}

void ScenePanel::takeSelection() {
    const auto target = m_model->targetAt(m_tree->currentIndex());
    if (m_showing || !target)
        return;
    if (target->scope == Scope::Mesh)
        m_selection.selectMesh(target->id);
    else
        m_selection.selectMaterial(target->id);
}

void ScenePanel::clicked(const QModelIndex& index) {
    const auto target = m_model->targetAt(index);
    if (!target || target->scope != Scope::Mesh || index.column() != SceneModel::MarkColumn)
        return;
    if (const MeshInstance* mesh = m_controller.document().mesh(target->id))
        m_controller.setMeshVisible(target->id, !mesh->visible);
}

void ScenePanel::openMenu(const QPoint& at) {
    const QModelIndex index = m_tree->indexAt(at);
    const auto target = m_model->targetAt(index);
    QMenu menu(this);
    const Document& document = m_controller.document();
    const auto rename = [&] {
        QAction* action =
            menu.addAction(icon(QStringLiteral("rename")), tr("Rename"), this, [this, index] {
                m_tree->edit(index.siblingAtColumn(SceneModel::NameColumn));
            });
        action->setShortcut(Qt::Key_F2); // the list's own: for the eye
    };
    if (target && target->scope == Scope::Mesh) {
        const Id id = target->id;
        const bool visible = document.mesh(id)->visible;
        menu.addAction(icon(QStringLiteral("frame")), tr("Frame"), this,
                       &ScenePanel::frameRequested);
        menu.addAction(visible ? icon(QStringLiteral("eye-off")) : icon(QStringLiteral("eye")),
                       visible ? tr("Hide") : tr("Show"), this,
                       [=, this] { m_controller.setMeshVisible(id, !visible); });
        QMenu* materials = menu.addMenu(icon(QStringLiteral("material")), tr("Material"));
        for (const Material& material : document.materials) {
            QAction* action = materials->addAction(
                QString::fromStdString(material.name), this,
                [this, id, other = material.id] { m_controller.assignMaterial(id, other); });
            action->setCheckable(true);
            action->setChecked(material.id == document.mesh(id)->material);
        }
        menu.addSeparator();
        menu.addActions({m_actions.dropToGround, m_actions.backInPlace});
        menu.addSeparator();
        rename();
        menu.addActions({m_actions.duplicateSelected, m_actions.removeSelected});
    } else if (target) {
        rename();
        menu.addActions({m_actions.duplicateSelected, m_actions.removeSelected});
        menu.addSeparator();
    }
    if (!target || target->scope == Scope::Material)
        menu.addAction(icon(QStringLiteral("add")), tr("New Material"), this,
                       [this] { m_selection.selectMaterial(m_controller.addMaterial()); });
    menu.exec(m_tree->viewport()->mapToGlobal(at));
}

} // namespace patina::editor
