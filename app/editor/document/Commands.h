// The undo commands. Each stores ids and values, never pointers into the document, and swaps
// between what was and what is.
#pragma once

#include "app/editor/document/DocumentController.h"

#include <QUndoCommand>

namespace patina::editor {

class DocumentCommand : public QUndoCommand {
  public:
    DocumentCommand(DocumentController& controller, const QString& text);

    void undo() final;
    void redo() final;
    // Makes the edit where it is no undo step.
    void applyOnly();
    // Memory that only this command keeps alive, roughly: images and meshes.
    [[nodiscard]] virtual std::size_t payloadBytes() const { return 0; }
    // DocumentState::step on its two sides; the second is 0 while it was not done yet.
    [[nodiscard]] quint64 stepBefore() const { return m_stepBefore; }
    [[nodiscard]] quint64 stepAfter() const { return m_stepAfter; }

  protected:
    virtual Change swap(Document& document, bool forward) = 0;
    [[nodiscard]] DocumentController& controller() const { return m_controller; }
    // Edits on two sides of a save are two steps.
    [[nodiscard]] bool mayMerge(const DocumentCommand& next) const {
        return m_mergeMark == next.m_mergeMark;
    }
    // `next` has become a part of this one, which may be obsolete thereby.
    void merged(const DocumentCommand& next);

  private:
    DocumentController& m_controller;
    quint64 m_mergeMark;
    quint64 m_stepBefore = 0, m_stepAfter = 0;
};

// Parameters of one element: one, or the few that belong together. Merges within a drag; a drag
// that returns to its start leaves no step behind.
class SetParametersCommand : public DocumentCommand {
  public:
    SetParametersCommand(DocumentController& controller, const QString& text, Target target,
                         std::vector<ParameterEdit> after, DragSession session);
    [[nodiscard]] int id() const override { return m_session == 0 ? -1 : 1; }
    bool mergeWith(const QUndoCommand* other) override;
    [[nodiscard]] std::size_t payloadBytes() const override;

  protected:
    Change swap(Document& document, bool forward) override;

  private:
    Target m_target;
    std::vector<ParameterEdit> m_before, m_after; // of the same parameters, in the same order
    DragSession m_session;
};

// Meshes, materials and lights as a whole: added, removed, exchanged.
class ReplaceElementsCommand : public DocumentCommand {
  public:
    ReplaceElementsCommand(DocumentController& controller, const QString& text, Elements after);
    [[nodiscard]] std::size_t payloadBytes() const override;

  protected:
    Change swap(Document& document, bool forward) override;

  private:
    Elements m_before, m_after;
};

// The bake of one kind: attached, exchanged, removed. Holds what is not attached at the time, so
// that what follows from later edits (DocumentController::renewBake) is kept by undo and redo.
class SetBakeCommand : public DocumentCommand {
  public:
    // `bake`: null to remove it.
    SetBakeCommand(DocumentController& controller, const QString& text, BakeKind kind,
                   BakeArtifactPtr bake);
    [[nodiscard]] std::size_t payloadBytes() const override;

  protected:
    Change swap(Document& document, bool forward) override;

  private:
    BakeKind m_kind;
    BakeArtifactPtr m_other;
};

// The name of a mesh, material or light.
[[nodiscard]] std::string nameOf(const Document& document, Target target);

// A parameter that is known to be in the table.
[[nodiscard]] const ParameterInfo& parameter(const char* id);

} // namespace patina::editor
