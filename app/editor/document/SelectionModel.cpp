#include "app/editor/document/SelectionModel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SourceName.h"
#include "core/document/SceneModels.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

namespace patina::editor {

SelectionModel::SelectionModel(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {
    connect(&controller, &DocumentController::changed, this, &SelectionModel::repair);
}

void SelectionModel::selectMesh(Id id) {
    const MeshInstance* mesh = m_controller.document().mesh(id);
    m_latest = Scope::Mesh;
    set(mesh ? id : 0, mesh ? mesh->material : m_material, m_light);
}

void SelectionModel::selectMaterial(Id id) {
    if (!m_controller.document().material(id))
        return;
    m_latest = Scope::Material;
    // A mesh of another material would contradict what the panels show.
    const MeshInstance* mesh = m_controller.document().mesh(m_mesh);
    set(mesh && mesh->material == id ? m_mesh : 0, id, m_light);
}

void SelectionModel::selectLight(Id id) {
    m_latest = Scope::Light;
    set(m_mesh, m_material, m_controller.document().light(id) ? id : 0);
}

std::optional<Target> SelectionModel::latest() const {
    const Id id = m_latest == Scope::Mesh    ? m_mesh
                  : m_latest == Scope::Light ? m_light
                                             : m_material;
    return id != 0 ? std::optional(Target{m_latest, id}) : std::nullopt;
}

void SelectionModel::setWholeModel(bool whole) {
    if (whole == m_wholeModel)
        return;
    m_wholeModel = whole;
    Q_EMIT selectionChanged();
}

std::vector<Id> SelectionModel::placedMeshes() const {
    if (m_mesh == 0)
        return {};
    return m_wholeModel ? meshesOfModel(m_controller.document(), m_mesh) : std::vector<Id>{m_mesh};
}

QString SelectionModel::placedName() const {
    const MeshInstance* mesh = m_controller.document().mesh(m_mesh);
    if (!mesh)
        return {};
    return m_wholeModel && placedMeshes().size() > 1
               ? sourceName(QString::fromStdString(mesh->source))
               : QString::fromStdString(mesh->name);
}

void SelectionModel::repair(const Change& change) {
    if (!touches(change.affects, Affects::Structure))
        return;
    const Document& document = m_controller.document();
    // In another document ids mean others.
    const bool another = change.isAnotherDocument();
    const MeshInstance* mesh = another ? nullptr : document.mesh(m_mesh);
    Id material = mesh ? mesh->material : m_material;
    if (another || !document.material(material)) {
        // There is always something to edit: the material of the largest mesh comes first to the
        // eye.
        material = document.materials.empty() ? 0 : document.materials.front().id;
        std::size_t largest = 0;
        for (const MeshInstance& candidate : document.meshes) {
            const std::size_t triangles = candidate.mesh ? candidate.mesh->triangleCount() : 0;
            if (triangles > largest && document.material(candidate.material)) {
                largest = triangles;
                material = candidate.material;
            }
        }
    }
    const bool kept = !another && (m_light == 0 || document.light(m_light));
    const Id light = kept ? m_light : document.lights.empty() ? 0 : document.lights.front().id;
    set(mesh ? m_mesh : 0, material, light);
}

void SelectionModel::set(Id mesh, Id material, Id light) {
    if (mesh == m_mesh && material == m_material && light == m_light)
        return;
    m_mesh = mesh;
    m_material = material;
    m_light = light;
    Q_EMIT selectionChanged();
}

} // namespace patina::editor
