// What is selected: at most one mesh, one material and one light. Shared by the panels and the
// viewport; never refers to an element that is gone.
#pragma once

#include "core/base/Id.h"
#include "core/edit/Change.h"

#include <QObject>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;

class SelectionModel : public QObject {
    Q_OBJECT
  public:
    explicit SelectionModel(DocumentController& controller, QObject* parent = nullptr);

    [[nodiscard]] Id mesh() const { return m_mesh; } // 0: none
    [[nodiscard]] Id material() const { return m_material; }
    [[nodiscard]] Id light() const { return m_light; }

    void selectMesh(Id id); // selects its material as well; 0 deselects the mesh only
    void selectMaterial(Id id);
    void selectLight(Id id);
    // What was selected last, a mesh, material or light, while it is selected: keys mean that.
    [[nodiscard]] std::optional<Target> latest() const;

    // What moves when the selection is moved: the selected mesh, or all meshes of its model.
    void setWholeModel(bool whole);
    [[nodiscard]] bool wholeModel() const { return m_wholeModel; }
    [[nodiscard]] std::vector<Id> placedMeshes() const;
    [[nodiscard]] QString placedName() const; // of the mesh, or of its model's file

  Q_SIGNALS:
    void selectionChanged();

  private:
    void repair(const Change& change);
    void set(Id mesh, Id material, Id light);

    DocumentController& m_controller;
    Id m_mesh = 0, m_material = 0, m_light = 0;
    bool m_wholeModel = false;
    Scope m_latest = Scope::Material;
};

} // namespace patina::editor
