// Editing a document: the one object that changes it, in steps that can be taken back. The editor,
// the command line and tests edit through it, so that the same edit gives the same document
// everywhere. For one thread; knows nothing of files and windows.
#pragma once

#include "core/document/Document.h"
#include "core/edit/DocumentState.h"
#include "core/edit/Edit.h"
#include "core/edit/EditStep.h"
#include "core/edit/Placing.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

class GroupStep;
struct BrightSource;
struct Look;
struct LookDifference;
enum class LightType;

// Who follows a session.
class EditObserver {
  public:
    virtual ~EditObserver() = default;
    // Brings up to date what follows from an edit, before anybody is told of it. Returns what that
    // has changed.
    virtual Affects derive(Document& /*document*/) { return Affects::Nothing; }
    virtual void documentChanged(const Change& /*change*/) {}
    virtual void historyChanged() {} // the steps, which of them are done, or isModified()
    virtual void stepsDropped() {}   // their payloads took too much memory
};

class EditSession {
  public:
    struct Limits {
        int steps = 1000;
        // What undo may keep alive beyond the document itself. Above it the oldest steps go; the
        // document is never at stake.
        std::size_t payloadBytes = std::size_t{1} << 30;
    };

    EditSession()
        : EditSession(Limits{}) {}
    explicit EditSession(const Limits& limits)
        : m_limits(limits) {}
    void observe(EditObserver* observer) { m_observer = observer; } // null: nobody; outlives this

    [[nodiscard]] const Document& document() const { return m_document; }
    // Another document, without history, as it was saved.
    void replace(Document document);
    // How many documents there have been.
    [[nodiscard]] std::uint64_t documentNumber() const { return m_documents; }
    // Grows with each change of the document, whatever made it, navigation too.
    [[nodiscard]] std::uint64_t revision() const { return m_revision; }

    // --- History ---------------------------------------------------------------------------------
    void undo();
    void redo();
    void goTo(int index); // as many undos or redos as that takes
    [[nodiscard]] bool canUndo() const { return m_index > 0; }
    [[nodiscard]] bool canRedo() const { return m_index < count(); }
    [[nodiscard]] int count() const { return static_cast<int>(m_steps.size()); }
    [[nodiscard]] int index() const { return m_index; } // of the next step to redo
    // Of the steps that undo and redo would take; empty where there is none.
    [[nodiscard]] std::string undoText() const;
    [[nodiscard]] std::string redoText() const;
    // The document after so many steps: what the last of them was, and which state it is.
    struct HistoryEntry {
        std::string text, values; // EditStep; empty before the first step
        DocumentState state;      // without bakes
    };
    [[nodiscard]] HistoryEntry historyEntry(int index) const; // 0 … count()
    void clearHistory();                                      // the document stays
    // What undo and redo alone keep alive, in bytes, roughly.
    [[nodiscard]] std::size_t historyBytes() const;
    // The oldest steps go until what is left is at most that; what can be redone stays.
    void dropOldest(std::size_t most);

    // Taken with a copy of the document it tells later whether the copy is still what is there.
    [[nodiscard]] DocumentState state() const;
    // `state` is what was saved.
    void setSaved(const DocumentState& state);
    // What was saved is no longer there.
    void forgetSaved();
    // Edits on two sides of this are two steps, whatever their session.
    void separateSteps() { ++m_mergeMark; }
    [[nodiscard]] bool isModified() const { return !(m_saved == state()); }
    // Steps between what was saved and what is there; 0: none, or not known, as when undo does not
    // lead back there.
    [[nodiscard]] int unsavedSteps() const;

    // Does a step and puts it on the history, in place of what could be redone.
    void push(std::unique_ptr<EditStep> step);
    // For what arrives by itself: where there is something to redo it does not erase that, and is
    // no step.
    void pushOrApply(std::unique_ptr<EditStep> step);
    // What `edits` pushes becomes one step.
    void group(const std::string& text, const std::function<void()>& edits);

    // --- Parameters: clamped to their hard range; equal values make no step, nor do references
    // that lead nowhere
    // --------------------------------------------------------------------------------
    [[nodiscard]] DragSession newDragSession() { return ++m_lastSession; }
    void setParameter(const ParameterInfo& info, const Target& target, const ParameterValue& value,
                      DragSession session = 0);
    void resetParameter(const ParameterInfo& info, const Target& target);
    // Several of one element as one step, as a drag in two directions needs it: within a session
    // the same parameters in the same order.
    void setParameters(const Target& target, const std::vector<ParameterEdit>& edits,
                       const std::string& text, DragSession session = 0);
    // The same of those alone that differ; edits of a session merge where the same do.
    void setDiffering(const Target& target, const std::vector<ParameterEdit>& edits,
                      const std::string& text, DragSession session = 0);

    // --- Structure -------------------------------------------------------------------------------
    // Any edit of the lists of meshes, materials, lights and environments and of the mix
    // (core/edit/Edit.h) as one step. Ids are never given twice, also after undo.
    void editStructure(const std::string& text, const std::function<void(Document&)>& edit);
    void rename(const Target& target, std::string_view name); // not to nothing
    Id addLight(LightType type); // as bright at the scene's centre as any other type
    Id duplicateLight(Id light); // 0: there is no such light; so below
    // Everything of the light but its name.
    void changeLight(const Light& light, const std::string& text, DragSession session = 0);
    void removeLight(Id light);
    Id addMaterial();
    Id duplicateMaterial(Id material);
    void removeMaterial(Id material); // its meshes get the first of the others; the last one stays
    void assignMaterial(Id mesh, Id material);
    void setMeshVisible(Id mesh, bool visible);
    // Several as one step, or as part of a drag; those that do not exist are left out.
    void placeMeshes(const Placements& placements, const std::string& text,
                     DragSession session = 0);
    Id duplicateMesh(Id mesh); // in the same place
    void removeMesh(Id mesh);
    // Environments light the scene when they are added; 0: there are too many, or none to copy.
    Id addEnvironment(const Environment& environment, const std::string& text);
    Id addSecondEnvironment(const Environment& environment, const std::string& text); // to fade to
    // For cells of a wall: the scene's light stays as it is.
    Id addUnusedEnvironment(const Environment& environment, const std::string& text);
    Id duplicateEnvironment(Id environment);
    void removeEnvironment(Id environment); // the last one stays
    void lightWith(Id environment);         // it becomes the first of the mix
    // A light takes the place of a bright source of the environment's image, which is the last of
    // `removed` ones: extractBrightSources(). Returns the light.
    Id extractSource(Id environment, const BrightSource& source, int removed);
    // Of the environment that lights the scene.
    void setSoftboxes(const std::string& text, const std::vector<Softbox>& softboxes);
    Id addSoftbox(float azimuthDeg, float elevationDeg); // 0: there are too many
    Id duplicateSoftbox(Id softbox);                     // beside the original
    void removeSoftbox(Id softbox);

    // --- Snapshots, each a step. Of looks restored, see restoreLook() of core/edit/Looks.h -------
    // The document's look under a name that no other snapshot has; the empty name becomes
    // "Snapshot 1". `picture`: of the scene, or null (Snapshot::picture). 0: there are
    // kMaxSnapshots.
    Id keepSnapshot(std::string_view name, const ImagePtr& picture);
    void renameSnapshot(Id snapshot, std::string_view name); // not to nothing
    void removeSnapshot(Id snapshot);
    void restoreSnapshot(Id snapshot); // its whole look
    // Those of the differences that can be restored, to what `look` has.
    void restoreLook(const Look& look, const std::vector<LookDifference>& differences,
                     const std::string& text);

    // --- Bakes -----------------------------------------------------------------------------------
    // A bake that has been made, in place of one of its kind: no step, as it takes nothing back of
    // what the user did, and an hour's rays must not go by an undo of something else.
    void attachBake(BakeArtifactPtr bake);
    void removeBake(BakeKind kind); // a step

    // --- What is no step -------------------------------------------------------------------------
    // `after` is `before` with what follows from the rest of the document brought up to date.
    // Nothing happens when `before` is no longer attached.
    void renewBake(const BakeArtifactPtr& before, BakeArtifactPtr after);
    // Navigation is saved with the document, but is no modification.
    void setCamera(const Camera& camera);
    // Pictures that follow from the document, made by others (Environment::image, of the one with
    // this id where it is still there; EnvironmentMix::blended).
    void setEnvironmentImage(Id environment, const ImagePtr& image);
    void setBlendedImage(const ImagePtr& image);
    // Of a snapshot that was kept before the scene was drawn (where it is still there).
    void setSnapshotPicture(Id snapshot, const ImagePtr& picture);

  private:
    void apply(EditStep& step, bool forward);
    void announce(const Change& change);
    void historyChanged();
    void makeRoomFor(std::size_t payloadBytes);
    [[nodiscard]] std::string nameText(const Target& target) const;

    Limits m_limits;
    EditObserver* m_observer = nullptr;
    Document m_document;
    std::vector<std::unique_ptr<EditStep>> m_steps;
    int m_index = 0;
    GroupStep* m_group = nullptr; // that is being filled
    DragSession m_lastSession = 0;
    std::uint64_t m_revision = 0, m_documents = 0;
    std::uint64_t m_history = 0, m_step = 0; // of state()
    std::uint64_t m_lastStep = 0;            // steps are numbered once
    std::uint64_t m_mergeMark = 0;
    DocumentState m_saved;
    Id m_firstFreeId = 1;
};

// A parameter that is known to be in the table.
[[nodiscard]] const ParameterInfo& parameter(std::string_view id);

} // namespace patina
