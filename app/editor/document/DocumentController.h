// The editor's document: an EditSession (core/edit) with signals, files and what is read in the
// background. Every view of the document listens to the one signal changed() and reads document().
//
// Files are read and written on background threads: the functions that name a file return at once,
// apply their result later as one step, and tell of problems through noticed().
#pragma once

#include "app/editor/document/BackgroundTasks.h"
#include "app/editor/document/SaveQuestion.h"
#include "app/editor/document/UndoStack.h"
#include "app/editor/document/UserNotice.h"
#include "core/edit/EditSession.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace patina {
class WorkerClient;
struct SaveOutcome;
namespace library {
struct SoftboxRig;
}
} // namespace patina

namespace patina::editor {

class EnvironmentResolver;
class OpenProject;
struct FileOnDisk;
struct SaveOrder;

class DocumentController : public QObject, private EditObserver {
    Q_OBJECT
  public:
    // `worker` and `runner` outlive the controller. The document is empty until newDocument() or
    // openScene().
    DocumentController(WorkerClient& worker, TaskRunner& runner, QObject* parent = nullptr);
    ~DocumentController() override;

    [[nodiscard]] const Document& document() const { return m_session.document(); }
    [[nodiscard]] WorkerClient& worker() { return m_worker; }
    // For edits that have no function of their own here.
    [[nodiscard]] EditSession& session() { return m_session; }
    [[nodiscard]] UndoStack& undoStack() { return m_undo; }
    [[nodiscard]] BackgroundTasks& tasks() { return m_tasks; }
    [[nodiscard]] TaskRunner& runner() { return m_runner; } // for whoever follows the document

    // The project file, empty when it has not been saved yet.
    [[nodiscard]] QString filePath() const { return m_filePath; }
    // Where Save goes: the file, or the one that a save on its way gives the document.
    [[nodiscard]] QString saveTarget() const;
    [[nodiscard]] QString displayName() const; // "helmet.patina", "FlightHelmet", "Untitled"
    // Whether the document differs from what was last saved or opened: what was written is compared
    // with what is there.
    [[nodiscard]] bool isModified() const { return m_session.isModified(); }
    [[nodiscard]] int unsavedSteps() const { return m_session.unsavedSteps(); }
    [[nodiscard]] DocumentState state() const { return m_session.state(); }
    // When something was asked for that is read in the background.
    struct Begun {
        DocumentState state;
        quint64 opened = 0; // how many scenes had been asked for
    };
    [[nodiscard]] Begun begun() const { return {state(), m_opened}; }
    // Applies what was asked for at `begun`: at once, or, when the user has gone back meanwhile, as
    // soon as there is nothing to redo.
    void deliver(const Begun& begun, const QString& name, std::function<void()> edit);
    // Grows with each change of the document, whatever made it, navigation too.
    [[nodiscard]] quint64 revision() const { return m_session.revision(); }
    // Nothing would be lost by replacing it: the untouched start scene.
    [[nodiscard]] bool isPristine() const;

    // --- Parameters (core/edit/EditSession.h) ----------------------------------------------------
    [[nodiscard]] DragSession newDragSession() { return m_session.newDragSession(); }
    void setParameter(const ParameterInfo& info, Target target, const ParameterValue& value,
                      DragSession session = 0);
    void resetParameter(const ParameterInfo& info, Target target);
    void setParameters(Target target, const std::vector<ParameterEdit>& edits, const QString& text,
                       DragSession session = 0);

    // --- Maps and environments, read in the background -------------------------------------------
    // `map` is a parameter of type Map. An image that cannot be read leaves the slot as it was.
    void setMap(const ParameterInfo& map, Target target, const QString& source);
    void clearMap(const ParameterInfo& map, Target target);
    // A file or "builtin:NAME"; its layout is guessed. Those of a session that follow each other
    // are one step.
    void setEnvironment(const QString& source, DragSession session = 0);
    // As setEnvironment(), of one that need not light the scene.
    void replaceEnvironment(Id environment, const QString& source);
    // What the two above do, for edits of one's own: reads what `source` shows, and hands `put`
    // what makes the environment show it, unless it was removed meanwhile. A notice says why it
    // cannot be read.
    using PutEnvironment = std::function<void(Target, std::vector<ParameterEdit>)>;
    void readEnvironment(Id environment, const QString& source, EnvironmentLayout layout,
                         PutEnvironment put);
    // Another environment of the scene, as a step: it lights the scene, is the one to fade to, or
    // is there for cells of a wall. A file or "builtin:NAME" that one of them shows already is not
    // added again. `added`, once it is there: which one.
    enum class EnvironmentUse { Light, FadeTo, Cells };
    void addEnvironment(const QString& source, EnvironmentUse use,
                        std::function<void(Id)> added = {});
    void addEnvironment(EnvironmentKind kind); // a sky or softboxes, to light the scene
    void duplicateEnvironment(Id environment) { m_session.duplicateEnvironment(environment); }
    void removeEnvironment(Id environment) { m_session.removeEnvironment(environment); }
    void lightWith(Id environment) { m_session.lightWith(environment); }
    void fadeTo(Id environment); // 0: to none
    // The brightest source of the image that lights the scene becomes a light, found in the
    // background; again: the next one. A notice says where there is none that stands out.
    void extractSun();

    // --- Generated environments: the image follows each edit, a draft first --------------------
    [[nodiscard]] bool showsDraft() const; // of the environment: its full picture is to come
    void setEnvironmentKind(EnvironmentKind kind);        // Softboxes without one get the first rig
    void setSoftboxRig(const library::SoftboxRig& rig);   // in place of what is there
    Id addSoftbox(float azimuthDeg, float elevationDeg) { // 0: there are too many
        return m_session.addSoftbox(azimuthDeg, elevationDeg);
    }
    Id duplicateSoftbox(Id softbox) { return m_session.duplicateSoftbox(softbox); }
    void removeSoftbox(Id softbox) { m_session.removeSoftbox(softbox); }

    // --- Structure (core/edit/EditSession.h) -----------------------------------------------------
    void rename(Target target, const QString& name);
    Id addLight(LightType type) { return m_session.addLight(type); }
    Id duplicateLight(Id light) { return m_session.duplicateLight(light); }
    // What changes of the light becomes one step, or part of a drag. Type, place, direction, size:
    // everything but its name.
    void changeLight(const Light& light, DragSession session, const QString& text);
    void removeLight(Id light) { m_session.removeLight(light); }
    Id addMaterial() { return m_session.addMaterial(); }
    Id duplicateMaterial(Id material) { return m_session.duplicateMaterial(material); }
    void removeMaterial(Id material) { m_session.removeMaterial(material); }
    void assignMaterial(Id mesh, Id material) { m_session.assignMaterial(mesh, material); }
    void applyLibraryMaterial(Id material, const QString& name); // keeps id and name
    void setMeshVisible(Id mesh, bool visible) { m_session.setMeshVisible(mesh, visible); }
    void placeMeshes(const Placements& placements, const QString& text, DragSession session = 0) {
        m_session.placeMeshes(placements, text.toStdString(), session);
    }
    Id duplicateMesh(Id mesh) { return m_session.duplicateMesh(mesh); }
    void removeMesh(Id mesh) { m_session.removeMesh(mesh); }
    void addModel(const QString& source); // a file or "builtin:NAME"
    // Any edit of the lists of meshes, materials and lights (core/edit/Edit.h) as one step.
    void editStructure(const QString& undoText, const std::function<void(Document&)>& edit);

    // --- Bakes -----------------------------------------------------------------------------------
    // A bake that has been made: no undo step.
    void attachBake(BakeArtifactPtr artifact);
    void removeBake(BakeKind kind) { m_session.removeBake(kind); }
    void renewBake(const BakeArtifactPtr& before, BakeArtifactPtr after) {
        m_session.renewBake(before, std::move(after));
    }

    // --- View ------------------------------------------------------------------------------------
    // Shows the scene through an OpenColorIO configuration, with its default display and view; an
    // empty file: through the environment's, or, where there is none, the default tone curve.
    void setDisplayConfig(const QString& file);
    void setDisplayView(const QString& display, const QString& view); // empty view: the default
    // For what the user set going that shows in one way only, such as a bake of transfer: a step,
    // unless there is something to redo, which that would erase; then none.
    void showLighting(LightingMode mode);
    // Navigation is saved with the document, but is neither an undo step nor a modification.
    void setCamera(const Camera& camera) { m_session.setCamera(camera); }

    // --- Files -----------------------------------------------------------------------------------
    // `done` runs on the UI thread with whether it worked; not when something newer was opened, nor
    // when edits made meanwhile were kept.
    void newDocument(std::function<void(bool)> done = {}); // the start scene
    // A project, a model file or "builtin:NAME".
    void openScene(const QString& scene, std::function<void(bool)> done = {});
    // Models are added, HDRs light the scene, projects are opened, images become maps of a material
    // by their names (document/DropPlan.h); one that says none becomes its base colour.
    void addFiles(const QStringList& files, Id baseColorOf = 0);
    // Saves follow each other in the order of the calls, and each tells its result. The next edit
    // is an undo step of its own, so that undo leads back to what was saved.
    void saveAs(const QString& file, std::function<void(bool)> done = {},
                const SaveConsent& consent = {});
    // Asks before a save does what the user may not want. Without one, such a save fails with a
    // notice.
    void setSaveQuestion(std::function<void(const SaveQuestion&)> ask);
    // Asks before a scene that was being opened replaces edits made meanwhile; calls `proceed` when
    // they may go. Without one they stay, with a notice.
    void setReplaceQuestion(std::function<void(const std::function<void()>& proceed)> ask);

  Q_SIGNALS:
    void changed(const patina::Change& change);
    void fileChanged(); // path, name or modified state
    void noticed(const patina::editor::UserNotice& notice);
    void sceneOpened(const QString& scene); // absolute path or "builtin:NAME"
    // A model file holds several visual scenes, of which the one that it names was opened.
    void severalScenesFound(const QString& file, const QStringList& titles, int opened);
    void openFailed(const QString& scene);
    void saved(const QString& file);

  private:
    Affects derive(Document& document) override;
    void documentChanged(const Change& change) override;
    void historyChanged() override;
    void stepsDropped() override;
    // One step of those that differ.
    void pushParameters(Target target, const std::vector<ParameterEdit>& edits, const QString& text,
                        DragSession session = 0) {
        m_session.setDiffering(target, edits, text.toStdString(), session);
    }
    void deliverWaiting();
    void noteModified(); // tells whether isModified() has changed
    // Now, or when the user agrees to lose what was edited since `begun`.
    void replaceWhenAllowed(const DocumentState& begun, const QString& name,
                            std::function<void()> replace);
    void readEnvironment(Id environment, const QString& source, EnvironmentLayout layout,
                         const QString& undoText, DragSession session = 0);
    void takeOpened(OpenedScene opened, const QString& scene, const QString& name,
                    const std::optional<Hash>& version);
    // m_filePath is open here, and held this when it was read.
    void holdFile(const std::optional<Hash>& version);
    // Of what is open or being saved, if it is; `anew`: without what is known of the content.
    std::shared_ptr<FileOnDisk> fileOnDisk(const QString& file, bool anew);
    void saveEnded(const SaveOutcome& outcome, const SaveOrder& order);
    void replaceDocument(Document document, const QString& filePath, const QString& name,
                         bool pristine);

    WorkerClient& m_worker;
    TaskRunner& m_runner;
    EditSession m_session;
    UndoStack m_undo;
    BackgroundTasks m_tasks;
    EnvironmentResolver* m_environment; // owned by Qt
    QString m_filePath, m_name;
    bool m_pristine = true;

    quint64 m_opened = 0; // scenes asked for
    // What opening the newest of them replaces unasked: the state when it was asked for, and what
    // came since of what had been asked for before.
    std::shared_ptr<DocumentState> m_opening;
    bool m_shownModified = false;
    std::shared_ptr<FileOnDisk> m_onDisk;                 // what is known of the file at m_filePath
    std::vector<std::pair<quint64, QString>> m_saving;    // on their way: document's number, file
    std::map<QString, std::weak_ptr<FileOnDisk>> m_files; // that, and of saves on their way
    std::vector<std::function<void()>> m_waiting;         // for there being nothing to redo
    std::function<void(const SaveQuestion&)> m_saveQuestion;
    std::function<void(const std::function<void()>&)> m_replaceQuestion;
};

} // namespace patina::editor
