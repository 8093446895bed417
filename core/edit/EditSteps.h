// The steps that a history consists of.
#pragma once

#include "core/document/Document.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditStep.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace patina {

// Parameters of one element: one, or the few that belong together. Merges within a drag; a drag
// that returns to its start leaves no step behind.
class SetParametersStep : public EditStep {
  public:
    SetParametersStep(std::string text, const Document& document, Target target,
                      std::vector<ParameterEdit> after, DragSession session);
    Change swap(Document& document, bool forward) override;
    bool merge(const EditStep& next) override;
    [[nodiscard]] std::string values() const override;
    [[nodiscard]] bool isEmpty() const override;
    [[nodiscard]] std::size_t payloadBytes() const override;

  private:
    Target m_target;
    std::vector<ParameterEdit> m_before, m_after; // of the same parameters, in the same order
    DragSession m_session;
};

// One member of several meshes at once. Merges within a session; one that returns to its start
// leaves no step behind.
template <auto Member>
class MeshesStep : public EditStep {
  public:
    using Value = std::remove_cvref_t<decltype(std::declval<MeshInstance>().*Member)>;
    // The meshes exist.
    MeshesStep(std::string text, const Document& document, std::vector<std::pair<Id, Value>> after,
               DragSession session);
    Change swap(Document& document, bool forward) override;
    bool merge(const EditStep& next) override;
    [[nodiscard]] bool isEmpty() const override { return m_before == m_after; }

  private:
    std::vector<std::pair<Id, Value>> m_before, m_after; // of the same meshes, in the same order
    DragSession m_session;
};
extern template class MeshesStep<&MeshInstance::visible>;
extern template class MeshesStep<&MeshInstance::placement>;
using ShowMeshesStep = MeshesStep<&MeshInstance::visible>;
using PlaceMeshesStep = MeshesStep<&MeshInstance::placement>;

// The lists that structural edits replace as a whole, ids kept.
struct Elements {
    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<Light> lights;
    std::vector<Environment> environments;
    EnvironmentMix mix;
    Id nextId = 1;
};

// Meshes, materials, lights and environments as a whole: added, removed, exchanged.
class ReplaceElementsStep : public EditStep {
  public:
    ReplaceElementsStep(std::string text, const Document& before, Elements after);
    Change swap(Document& document, bool forward) override;
    [[nodiscard]] std::size_t payloadBytes() const override;

  private:
    Elements m_before, m_after;
};

// The list of snapshots as a whole: their looks are shared, so that it is small.
class ReplaceSnapshotsStep : public EditStep {
  public:
    ReplaceSnapshotsStep(std::string text, const Document& before, std::vector<Snapshot> after,
                         Id nextId);
    Change swap(Document& document, bool forward) override;
    [[nodiscard]] std::size_t payloadBytes() const override { return m_payloadBytes; }

  private:
    std::vector<Snapshot> m_before, m_after;
    Id m_nextIdBefore, m_nextIdAfter;
    std::size_t m_payloadBytes = 0;
};

// A bake is taken away. Undone it is there again, unless there is another one of its kind by then:
// that a bake is finished is no step (EditSession::attachBake), and none is lost to undo.
class RemoveBakeStep : public EditStep {
  public:
    RemoveBakeStep(std::string text, BakeKind kind)
        : EditStep(std::move(text))
        , m_kind(kind) {}
    Change swap(Document& document, bool forward) override;
    [[nodiscard]] std::size_t payloadBytes() const override;

  private:
    BakeKind m_kind;
    BakeArtifactPtr m_removed; // while it is away
};

// The whole document, such as unsaved work on top of what was saved.
class ReplaceDocumentStep : public EditStep {
  public:
    // Meshes that both documents read from the same place are shared where they are equal.
    ReplaceDocumentStep(std::string text, const Document& before, Document after);
    Change swap(Document& document, bool forward) override;

  private:
    Document m_before, m_after;
};

// Several that are done and taken back together.
class GroupStep : public EditStep {
  public:
    using EditStep::EditStep;
    void add(std::unique_ptr<EditStep> step) { m_steps.push_back(std::move(step)); }
    Change swap(Document& document, bool forward) override;
    [[nodiscard]] bool isEmpty() const override { return m_steps.empty(); }
    [[nodiscard]] std::size_t payloadBytes() const override;

  private:
    std::vector<std::unique_ptr<EditStep>> m_steps;
};

} // namespace patina
