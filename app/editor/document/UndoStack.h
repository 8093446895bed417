// The history of an EditSession as Qt's windows want it: actions and signals.
#pragma once

#include "core/edit/EditSession.h"

#include <QObject>
#include <QString>

class QAction;

namespace patina::editor {

class UndoStack : public QObject {
    Q_OBJECT
  public:
    explicit UndoStack(EditSession& session, QObject* parent = nullptr);

    [[nodiscard]] int count() const { return m_session.count(); }
    [[nodiscard]] int index() const { return m_session.index(); }
    [[nodiscard]] bool canUndo() const { return m_session.canUndo(); }
    [[nodiscard]] bool canRedo() const { return m_session.canRedo(); }
    [[nodiscard]] QString undoText() const;
    [[nodiscard]] QString redoText() const;
    void undo() { m_session.undo(); }
    void redo() { m_session.redo(); }
    void clear() { m_session.clearHistory(); }

    // "Undo Change Roughness of Gold": enabled and named as the history has it.
    QAction* createUndoAction(QObject* parent, const QString& prefix);
    QAction* createRedoAction(QObject* parent, const QString& prefix);

    void update(); // the session's history has changed

  Q_SIGNALS:
    void stepsChanged(); // the steps, which of them are done, or what was saved
    void indexChanged(int index);
    void canUndoChanged(bool canUndo);
    void canRedoChanged(bool canRedo);
    void undoTextChanged(const QString& text);
    void redoTextChanged(const QString& text);

  private:
    EditSession& m_session;
    // As it was last told.
    int m_index = 0;
    bool m_canUndo = false, m_canRedo = false;
    QString m_undoText, m_redoText;
};

} // namespace patina::editor
