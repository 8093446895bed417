#include "app/editor/document/SelectionCommands.h"

#include "app/editor/Actions.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/widget/StatusHint.h"
#include "core/edit/EditSession.h"
#include "core/edit/Placing.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

namespace patina::editor {

SelectionCommands::SelectionCommands(DocumentController& controller, SelectionModel& selection,
                                     const Actions& actions, QWidget& viewport,
                                     std::initializer_list<QWidget*> lists, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_actions(actions)
    , m_viewport(viewport) {
    const QList<QAction*> keys{actions.removeSelected, actions.duplicateSelected,
                               actions.dropToGround};
    viewport.addActions(keys);
    for (QWidget* list : lists)
        list->addActions(keys);
    connect(actions.removeSelected, &QAction::triggered, this, &SelectionCommands::remove);
    connect(actions.duplicateSelected, &QAction::triggered, this, &SelectionCommands::duplicate);
    connect(actions.dropToGround, &QAction::triggered, this, &SelectionCommands::dropToGround);
    connect(actions.backInPlace, &QAction::triggered, this, &SelectionCommands::backInPlace);
    connect(&selection, &SelectionModel::selectionChanged, this, &SelectionCommands::refresh);
    connect(&controller, &DocumentController::changed, this, &SelectionCommands::refresh);
    refresh();
}

void SelectionCommands::refresh() {
    m_actions.backInPlace->setEnabled(m_selection.mesh() != 0);
    m_actions.dropToGround->setEnabled(!m_controller.document().meshes.empty());
}

std::optional<Target> SelectionCommands::meant(const QString& hint) const {
    const auto target = m_selection.latest();
    if (target && (target->scope != Scope::Material || !m_viewport.hasFocus()))
        return target;
    showHint(m_viewport, hint);
    return std::nullopt;
}

void SelectionCommands::remove() {
    const auto target = meant(tr("Select a mesh or a light to remove it"));
    if (!target)
        return;
    if (target->scope == Scope::Mesh)
        m_controller.removeMesh(target->id);
    else if (target->scope == Scope::Light)
        m_controller.removeLight(target->id);
    else if (m_controller.document().materials.size() > 1)
        m_controller.removeMaterial(target->id);
    else
        showHint(m_viewport, tr("The last material stays: meshes need one"));
}

void SelectionCommands::duplicate() {
    const auto target = meant(tr("Select a mesh or a light to duplicate it"));
    if (!target)
        return;
    if (target->scope == Scope::Mesh)
        m_selection.selectMesh(m_controller.duplicateMesh(target->id));
    else if (target->scope == Scope::Light)
        m_selection.selectLight(m_controller.duplicateLight(target->id));
    else
        m_selection.selectMaterial(m_controller.duplicateMaterial(target->id));
}

void SelectionCommands::dropToGround() {
    const Document& document = m_controller.document();
    std::vector<Id> meshes = m_selection.placedMeshes();
    QString name = m_selection.placedName();
    if (meshes.empty()) {
        for (const MeshInstance& mesh : document.meshes)
            if (mesh.visible)
                meshes.push_back(mesh.id);
        name = tr("the Scene");
    }
    const Placements dropped = droppedToGround(document, meshes);
    if (dropped == placementsOf(document, meshes))
        showHint(m_viewport, tr("It stands on the ground already"));
    else
        m_controller.placeMeshes(dropped, tr("Drop %1 to Ground").arg(name));
}

void SelectionCommands::backInPlace() {
    m_controller.placeMeshes(
        patina::backInPlace(m_controller.document(), m_selection.placedMeshes()),
        tr("Put %1 Back").arg(m_selection.placedName()));
}

} // namespace patina::editor
