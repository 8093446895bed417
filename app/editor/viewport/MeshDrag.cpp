#include "app/editor/viewport/MeshDrag.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/viewport/WidgetGizmoView.h"
#include "app/editor/widget/StatusHint.h"
#include "core/edit/EditSession.h"

#include <QWidget>
#include <cmath>

namespace patina::editor {
namespace {

// A tenth of the grid's spacing.
float snapStep(const Camera& camera) {
    return 0.1f * render::gridSpacing(camera.distance);
}

QString number(float value, int decimals) {
    return QString::number(static_cast<double>(value), 'f', decimals);
}

// What a drag did, as numbers.
QString described(const render::MeshMotion& motion) {
    if (motion.angleDeg != 0.0f)
        return MeshDrag::tr("Rotated by %1°").arg(number(motion.angleDeg, 1));
    if (motion.factors != glm::vec3(1.0f)) {
        const glm::vec3& f = motion.factors;
        return f.x == f.y && f.y == f.z ? MeshDrag::tr("Scaled by %1").arg(number(f.x, 3))
                                        : MeshDrag::tr("Scaled by %1, %2, %3")
                                              .arg(number(f.x, 3), number(f.y, 3), number(f.z, 3));
    }
    return MeshDrag::tr("Moved by %1, %2, %3 m")
        .arg(number(motion.move.x, 3), number(motion.move.y, 3), number(motion.move.z, 3));
}

} // namespace

MeshDrag::MeshDrag(DocumentController& controller, SelectionModel& selection, QWidget& viewport)
    : m_controller(controller)
    , m_selection(selection)
    , m_viewport(viewport) {}

std::optional<render::MeshHandles> MeshDrag::handles() const {
    const Document& document = m_controller.document();
    const std::vector<Id> meshes = m_selection.placedMeshes();
    if (!m_on || meshes.empty())
        return std::nullopt;
    render::MeshHandles handles;
    handles.several = meshes.size() > 1;
    Bounds bounds; // of boxes: exact bounds of a dense mesh take too long for a frame
    for (const Id id : meshes)
        if (const MeshInstance* mesh = document.mesh(id); mesh && mesh->mesh)
            bounds.add(mesh->mesh->bounds().transformed(mesh->placement.matrix()));
    handles.pivot = bounds.center();
    if (const MeshInstance* mesh = document.mesh(meshes.front()); mesh && !handles.several)
        handles.axes = mesh->placement.axes();
    if (m_held) {
        handles.held = m_held->held;
        // Boxes of several change their middle as they rotate.
        if (handles.several && handles.held != render::GizmoHandle::None &&
            m_moved == glm::vec3(0.0f))
            handles.pivot = m_held->pivot;
    }
    return handles;
}

bool MeshDrag::isOver(const QPointF& position) const {
    return handleAt(position) != render::GizmoHandle::None;
}

bool MeshDrag::takeAt(const QPointF& position) {
    const render::GizmoHandle handle = handleAt(position);
    if (handle == render::GizmoHandle::None)
        return false;
    m_moved = glm::vec3(0.0f);
    m_held = handles();
    m_held->held = handle;
    m_from = position;
    m_before = placementsOf(m_controller.document(), m_selection.placedMeshes());
    m_session = m_controller.newDragSession();
    return true;
}

void MeshDrag::drag(const QPointF& position, bool snap) {
    if (!m_held)
        return;
    m_viewport.setCursor(Qt::ClosedHandCursor);
    const Document& document = m_controller.document();
    const Camera& camera = document.view.camera;
    const render::MeshMotion motion = render::meshMotion(
        *m_held, gizmoViewOf(m_viewport, document),
        {pixelOf(m_from), pixelOf(position), camera.right(), camera.up(), snap, snapStep(camera)});
    m_moved = motion.move;
    Placements after = m_before;
    QString verb = tr("Move %1");
    if (motion.axis != glm::vec3(0.0f)) {
        after = rotated(std::move(after), m_held->pivot, motion.axis, motion.angleDeg);
        verb = tr("Rotate %1");
    } else if (motion.factors != glm::vec3(1.0f)) {
        after = scaled(std::move(after), m_held->pivot, motion.factors);
        verb = tr("Scale %1");
    } else {
        after = moved(std::move(after), motion.move);
    }
    m_controller.placeMeshes(after, verb.arg(m_selection.placedName()), m_session);
    showHint(m_viewport, tr("%1 (Ctrl snaps, Esc takes it back)").arg(described(motion)));
}

// A session that returns to its start leaves no step behind.
void MeshDrag::cancel() {
    m_controller.placeMeshes(m_before, {}, m_session);
    letGo();
}

void MeshDrag::letGo() {
    m_held.reset();
    m_viewport.unsetCursor();
    showHint(m_viewport, {});
}

glm::vec2 MeshDrag::pixelOf(const QPointF& position) const {
    return {static_cast<float>(position.x()),
            static_cast<float>(m_viewport.height() - position.y())};
}

render::GizmoHandle MeshDrag::handleAt(const QPointF& position) const {
    const auto shown = m_visible ? handles() : std::nullopt;
    return shown ? render::pickMeshGizmo(*shown, gizmoViewOf(m_viewport, m_controller.document()),
                                         pixelOf(position))
                 : render::GizmoHandle::None;
}

} // namespace patina::editor
