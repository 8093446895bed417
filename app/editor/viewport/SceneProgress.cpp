#include "app/editor/viewport/SceneProgress.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QOpenGLWidget>

namespace patina::editor {

SceneProgress::SceneProgress(DocumentController& controller, QOpenGLWidget& viewport)
    : QFrame(&viewport)
    , m_viewport(viewport)
    , m_text(new QLabel) {
    setObjectName(QStringLiteral("sceneProgress"));
    setProperty("overlay", true);
    setAttribute(Qt::WA_TransparentForMouseEvents);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, tokens::kGap);
    row->addWidget(m_text);
    hide();
    viewport.installEventFilter(this);

    connect(
        &controller, &DocumentController::changed, this, [this, &controller](const Change& change) {
            if (!change.isAnotherDocument())
                return;
            // A window that nobody sees draws nothing.
            if (m_viewport.isVisible())
                setState(
                    State::Drawing,
                    tr("Drawing %1 for the first time…").arg(shownName(controller.displayName())));
            else
                setState(State::Idle);
        });
    connect(&viewport, &QOpenGLWidget::frameSwapped, this, [this] {
        if (m_state != State::Drawing)
            return;
        setState(State::Idle);
        Q_EMIT sceneShown();
    });
}

void SceneProgress::setOpening(const QString& name) {
    if (!name.isEmpty())
        setState(State::Reading, tr("Opening %1…").arg(name));
    else if (m_state == State::Reading)
        setState(State::Idle); // it failed
}

void SceneProgress::setState(State state, const QString& text) {
    m_state = state;
    m_text->setText(text);
    setAccessibleName(text);
    setVisible(state != State::Idle);
    place();
}

void SceneProgress::place() {
    adjustSize();
    move((m_viewport.width() - width()) / 2, (m_viewport.height() - height()) / 2);
    raise();
}

bool SceneProgress::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible())
        place();
    // Taken off the screen before its first picture: nothing will be drawn to wait for.
    if (event->type() == QEvent::Hide && m_state == State::Drawing) {
        setState(State::Idle);
        Q_EMIT sceneShown();
    }
    return false;
}

} // namespace patina::editor
