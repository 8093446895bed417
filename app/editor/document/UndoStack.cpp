#include "app/editor/document/UndoStack.h"

#include <QAction>
#include <utility>

namespace patina::editor {
namespace {

QString withPrefix(const QString& prefix, const QString& text) {
    return text.isEmpty() ? prefix : prefix + QLatin1Char(' ') + text;
}

} // namespace

UndoStack::UndoStack(EditSession& session, QObject* parent)
    : QObject(parent)
    , m_session(session) {}

QString UndoStack::undoText() const {
    return QString::fromStdString(m_session.undoText());
}

QString UndoStack::redoText() const {
    return QString::fromStdString(m_session.redoText());
}

QAction* UndoStack::createUndoAction(QObject* parent, const QString& prefix) {
    auto* action = new QAction(withPrefix(prefix, undoText()), parent);
    action->setEnabled(canUndo());
    connect(this, &UndoStack::canUndoChanged, action, &QAction::setEnabled);
    connect(this, &UndoStack::undoTextChanged, action,
            [action, prefix](const QString& text) { action->setText(withPrefix(prefix, text)); });
    connect(action, &QAction::triggered, this, &UndoStack::undo);
    return action;
}

QAction* UndoStack::createRedoAction(QObject* parent, const QString& prefix) {
    auto* action = new QAction(withPrefix(prefix, redoText()), parent);
    action->setEnabled(canRedo());
    connect(this, &UndoStack::canRedoChanged, action, &QAction::setEnabled);
    connect(this, &UndoStack::redoTextChanged, action,
            [action, prefix](const QString& text) { action->setText(withPrefix(prefix, text)); });
    connect(action, &QAction::triggered, this, &UndoStack::redo);
    return action;
}

void UndoStack::update() {
    // Whoever is told may edit: what was told is noted first.
    const bool indexDiffers = std::exchange(m_index, index()) != index();
    const bool canUndoDiffers = std::exchange(m_canUndo, canUndo()) != canUndo();
    const bool canRedoDiffers = std::exchange(m_canRedo, canRedo()) != canRedo();
    const QString undoBefore = std::exchange(m_undoText, undoText());
    const QString redoBefore = std::exchange(m_redoText, redoText());
    Q_EMIT stepsChanged();
    if (indexDiffers)
        Q_EMIT indexChanged(index());
    if (canUndoDiffers)
        Q_EMIT canUndoChanged(canUndo());
    if (canRedoDiffers)
        Q_EMIT canRedoChanged(canRedo());
    if (undoBefore != m_undoText)
        Q_EMIT undoTextChanged(m_undoText);
    if (redoBefore != m_redoText)
        Q_EMIT redoTextChanged(m_redoText);
}

} // namespace patina::editor
