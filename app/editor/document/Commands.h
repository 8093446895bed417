// The undo commands. Each stores ids and values, never pointers into the document, and swaps
// between what was and what is.
#pragma once

#include "app/editor/document/DocumentController.h"

#include <QUndoCommand>

namespace patina::editor {

class DocumentCommand : public QUndoCommand {
  public:
    DocumentCommand(DocumentController& controller, const QString& text)
        : QUndoCommand(text)
        , m_controller(controller) {}

    void undo() final {
        m_controller.apply([this](Document& document) { return swap(document, false); });
    }
    void redo() final {
        m_controller.apply([this](Document& document) { return swap(document, true); });
    }
    // Memory that only this command keeps alive, roughly: images and meshes.
    [[nodiscard]] virtual std::size_t payloadBytes() const { return 0; }

  protected:
    virtual Change swap(Document& document, bool forward) = 0;
    [[nodiscard]] DocumentController& controller() const { return m_controller; }

  private:
    DocumentController& m_controller;
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

class SetBakesCommand : public DocumentCommand {
  public:
    SetBakesCommand(DocumentController& controller, const QString& text,
                    std::vector<BakeArtifactPtr> after);
    [[nodiscard]] std::size_t payloadBytes() const override;

  protected:
    Change swap(Document& document, bool forward) override;

  private:
    std::vector<BakeArtifactPtr> m_before, m_after;
};

// The name of a mesh, material or light.
[[nodiscard]] std::string nameOf(const Document& document, Target target);

// A parameter that is known to be in the table.
[[nodiscard]] const ParameterInfo& parameter(const char* id);

} // namespace patina::editor
