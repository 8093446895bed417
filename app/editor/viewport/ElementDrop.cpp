#include "app/editor/viewport/ElementDrop.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/OwnValueControls.h"
#include "app/editor/wall/WallOverlay.h"
#include "app/editor/wall/WallState.h"
#include "core/document/Document.h"
#include "core/edit/EditSession.h"

#include <QCoreApplication>
#include <algorithm>
#include <numeric>

namespace patina::editor {
namespace {

QString trElementDrop(const char* text) {
    return QCoreApplication::translate("ElementDrop", text);
}

} // namespace

ElementDrop::ElementDrop(WallState& wall, DocumentController& controller, ViewportWidget& viewport,
                         const WallOverlay& overlay)
    : m_wall(wall)
    , m_controller(controller)
    , m_viewport(viewport)
    , m_overlay(overlay) {}

ElementDropPlan ElementDrop::planWall(const DraggedElements& elements,
                                      const QPointF& position) const {
    ElementDropPlan plan;
    std::vector<std::size_t> cells = m_overlay.layoutOfWall().cellsAt(position);
    if (cells.size() == 1 && elements.ids.size() > 1) { // and those that follow
        cells.resize(m_wall.cells().size() - cells.front());
        std::iota(cells.begin(), cells.end(), cells.front());
    }
    if (cells.empty()) {
        plan.lines << trElementDrop("Drop it on a cell, or on the caption of a column or row");
        return plan;
    }
    if (elements.ids.size() == 1)
        plan.parts.push_back({elements.ids.front(), cells, 0});
    else
        for (std::size_t i = 0; i < std::min(elements.ids.size(), cells.size()); ++i)
            plan.parts.push_back({elements.ids[i], {cells[i]}, 0});
    std::vector<std::size_t> taken;
    for (const ElementDropPlan::Part& part : plan.parts) {
        taken.insert(taken.end(), part.cells.begin(), part.cells.end());
        const QString name = elementName(m_controller.document(), elements.element, part.id);
        plan.lines
            << (part.cells.size() == 1
                    ? trElementDrop("Show %1 in the cell %2")
                          .arg(name, captionOf(m_wall.cells()[part.cells.front()]))
                    : trElementDrop("Show %1 in these %2 cells").arg(name).arg(part.cells.size()));
    }
    if (plan.parts.size() < elements.ids.size())
        plan.lines << trElementDrop("There are no cells for the other %1")
                          .arg(elements.ids.size() - plan.parts.size());
    plan.area = m_overlay.layoutOfWall().areaOf(taken);
    return plan;
}

ElementDropPlan ElementDrop::planPicture(const DraggedElements& elements,
                                         const QPointF& position) const {
    ElementDropPlan plan;
    const Document& document = m_controller.document();
    const QString name = elementName(document, elements.element, elements.ids.front());
    if (elements.ids.size() > 1) {
        plan.lines << trElementDrop("The picture shows one at a time: drag one of them, or drop "
                                    "them on a wall (F3)");
    } else if (elements.element == CellElement::Snapshot) {
        plan.parts.push_back({elements.ids.front(), {}, 0});
        plan.lines << trElementDrop("Restore %1").arg(name);
    } else if (const MeshInstance* mesh = document.mesh(m_viewport.meshAt(position))) {
        plan.parts.push_back({elements.ids.front(), {}, mesh->id});
        plan.lines << trElementDrop("Cover %1 with %2").arg(toQString(mesh->name), name);
    } else {
        plan.lines << trElementDrop("Drop it on a mesh to cover it with %1").arg(name);
    }
    return plan;
}

ElementDropPlan ElementDrop::plan(const DraggedElements& elements, const QPointF& position) const {
    if (!m_viewport.rect().contains(position.toPoint()))
        return {};
    return m_wall.isOn() ? planWall(elements, position) : planPicture(elements, position);
}

void ElementDrop::drop(CellElement element, const ElementDropPlan& plan) {
    for (const ElementDropPlan::Part& part : plan.parts) {
        if (part.cells.empty()) {
            if (element == CellElement::Snapshot)
                m_controller.session().restoreSnapshot(part.id);
            else
                m_controller.assignMaterial(part.mesh, part.id);
            continue;
        }
        std::vector<WallCell> cells;
        for (const std::size_t cell : part.cells)
            cells.push_back(m_wall.cells()[cell]);
        m_wall.setOwnElement(cells, element, part.id);
    }
    if (plan.parts.size() == 1 && plan.parts.front().cells.size() == 1 && !m_wall.enlarged())
        m_wall.setCurrent(plan.parts.front().cells.front());
}

} // namespace patina::editor
