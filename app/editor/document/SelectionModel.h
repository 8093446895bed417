// What is selected: at most one mesh, one material and one light. Shared by the panels and the
// viewport; never refers to an element that is gone.
#pragma once

#include "core/base/Id.h"
#include "core/edit/Change.h"

#include <QObject>

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

  Q_SIGNALS:
    void selectionChanged();

  private:
    void repair(const Change& change);
    void set(Id mesh, Id material, Id light);

    DocumentController& m_controller;
    Id m_mesh = 0, m_material = 0, m_light = 0;
};

} // namespace patina::editor
