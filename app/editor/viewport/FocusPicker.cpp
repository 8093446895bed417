#include "app/editor/viewport/FocusPicker.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/widget/StatusHint.h"
#include "core/base/Log.h"
#include "core/edit/Parameters.h"

#include <QAction>
#include <QKeyEvent>
#include <QMouseEvent>
#include <glm/geometric.hpp>

namespace patina::editor {

FocusPicker::FocusPicker(DocumentController& controller, ViewportWidget& viewport, QAction& action)
    : QObject(&viewport)
    , m_controller(controller)
    , m_viewport(viewport)
    , m_action(action) {
    viewport.installEventFilter(this);
    connect(&action, &QAction::toggled, this, [this](bool picking) {
        if (picking) {
            m_viewport.setCursor(Qt::CrossCursor);
            m_viewport.setFocus();
            showHint(m_viewport, tr("Click what is to be sharp; Esc cancels"));
        } else {
            m_viewport.unsetCursor();
            showHint(m_viewport, {});
        }
    });
}

void FocusPicker::focusAt(const QPointF& position) {
    if (m_viewport.showsWall()) {
        showHint(m_viewport, tr("Focus Here is for one picture; leave the wall first"));
        return;
    }
    const Result<std::optional<glm::vec3>> there = m_viewport.surfaceAt(position);
    if (!there) {
        logError("the pixel could not be looked at: {}", there.error().text());
        return;
    }
    if (!there->has_value()) {
        showHint(m_viewport, tr("There is no surface here; the focus stays as it is"));
        return;
    }
    const Camera& camera = m_controller.document().view.camera;
    const float distance = glm::dot(**there - camera.position(), camera.forward());
    m_controller.setParameters({Scope::View, 0},
                               {{findParameter("view.depthOfField"), true},
                                {findParameter("view.focusDistance"), distance}},
                               tr("Focus Here"));
    showHint(m_viewport, tr("In focus: %1 m from the camera").arg(distance, 0, 'f', 3));
}

bool FocusPicker::eventFilter(QObject*, QEvent* event) {
    if (!m_action.isChecked())
        return false;
    switch (event->type()) {
    case QEvent::MouseButtonPress: {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() != Qt::LeftButton)
            return false;
        m_action.setChecked(false);
        focusAt(mouse->position());
        return true;
    }
    case QEvent::MouseMove: // the cursor is ours
        return static_cast<QMouseEvent*>(event)->buttons() == Qt::NoButton;
    case QEvent::ShortcutOverride:
        if (static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
            m_action.setChecked(false);
            event->accept();
            return true;
        }
        return false;
    default:
        return false;
    }
}

} // namespace patina::editor
