#include "app/editor/library/EnvironmentTurn.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/widget/LatLongMap.h"
#include "app/editor/widget/StatusHint.h"

#include <QWidget>

namespace patina::editor {

void EnvironmentTurn::begin() {
    m_session = m_controller.newDragSession();
    m_beforeDeg = m_controller.document().environment().rotationDeg;
}

void EnvironmentTurn::set(float degrees) {
    m_controller.setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0},
                              degrees, m_session);
}

void EnvironmentTurn::turnBy(double degrees) {
    const double now = static_cast<double>(m_controller.document().environment().rotationDeg);
    set(static_cast<float>(wrapDeg(now + degrees)));
    showHint(m_where, tr("Environment rotated by %1° (Esc takes it back)")
                          .arg(wrapDeg(now + degrees), 0, 'f', 1));
}

void EnvironmentTurn::cancel() {
    set(m_beforeDeg);
    showHint(m_where, {});
}

} // namespace patina::editor
