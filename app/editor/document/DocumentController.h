// The one place that changes the document. Every edit is a command on the undo stack; every view
// of the document listens to the one signal changed() and reads document().
//
// Files are read and written on background threads: the functions that name a file return at once,
// apply their result later as one step, and tell of problems through noticed().
#pragma once

#include "app/editor/document/BackgroundTasks.h"
#include "app/editor/document/UserNotice.h"
#include "core/document/Change.h"
#include "core/document/Document.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QUndoStack>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace patina {
class WorkerClient;
}

namespace patina::editor {

// Edits of one parameter that carry the same session merge into one undo step; 0 never merges.
using DragSession = quint64;

class DocumentCommand;

// The lists that structural edits replace as a whole, ids kept.
struct Elements {
    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<Light> lights;
    Id nextId = 1;
};

// `wanted`, or "wanted 2" … when another of `elements` has that name: names are unique so that
// scripts can tell elements apart.
template <class Element>
[[nodiscard]] std::string uniqueName(const std::string& wanted,
                                     const std::vector<Element>& elements) {
    std::string name = wanted;
    for (int number = 2; std::any_of(elements.begin(), elements.end(),
                                     [&](const Element& other) { return other.name == name; });
         ++number)
        name = wanted + " " + std::to_string(number);
    return name;
}

class DocumentController : public QObject {
    Q_OBJECT
  public:
    // `worker` outlives the controller. The document is empty until newDocument() or openScene().
    explicit DocumentController(WorkerClient& worker, QObject* parent = nullptr);
    ~DocumentController() override;

    [[nodiscard]] const Document& document() const { return m_document; }
    [[nodiscard]] WorkerClient& worker() { return m_worker; }
    [[nodiscard]] QUndoStack& undoStack() { return m_undo; }
    [[nodiscard]] BackgroundTasks& tasks() { return m_tasks; }

    // The project file, empty when it has not been saved yet.
    [[nodiscard]] QString filePath() const { return m_filePath; }
    [[nodiscard]] QString displayName() const; // "helmet.patina", "FlightHelmet", "Untitled"
    [[nodiscard]] bool isModified() const { return !m_undo.isClean(); }
    // Nothing would be lost by replacing it: the untouched start scene.
    [[nodiscard]] bool isPristine() const;

    // --- Parameters: clamped to their hard range; equal values make no undo step -----------------
    [[nodiscard]] DragSession newDragSession() { return ++m_lastSession; }
    void setParameter(const ParameterInfo& info, Target target, const ParameterValue& value,
                      DragSession session = 0);
    void resetParameter(const ParameterInfo& info, Target target);

    // --- Maps and surroundings, read in the background -------------------------------------------
    // `map` is a parameter of type Map. An image that cannot be read leaves the slot as it was.
    void setMap(const ParameterInfo& map, Target target, const QString& source);
    void clearMap(const ParameterInfo& map, Target target);
    void setEnvironment(const QString& source); // a file or "builtin:NAME"

    // --- Structure -------------------------------------------------------------------------------
    void rename(Target target, const QString& name);
    Id addLight(LightType type);
    void removeLight(Id light);
    Id addMaterial(Id copyOf = 0);    // 0: a default one
    void removeMaterial(Id material); // its meshes get the first of the others; the last one stays
    void assignMaterial(Id mesh, Id material);
    void applyLibraryMaterial(Id material, const QString& name); // keeps id and name
    void removeMesh(Id mesh);
    void addModel(const QString& source); // a file or "builtin:NAME"
    void replaceElements(const QString& undoText, const std::function<void(Elements&)>& edit);

    // --- Bakes -----------------------------------------------------------------------------------
    void attachBake(BakeArtifactPtr artifact); // replaces the one of the same kind
    void detachBake(BakeKind kind);

    // --- View ------------------------------------------------------------------------------------
    // Navigation is saved with the document, but is neither an undo step nor a modification.
    void setCamera(const Camera& camera);

    // --- Files -----------------------------------------------------------------------------------
    void newDocument();                   // the start scene
    void openScene(const QString& scene); // project, model file or "builtin:NAME"
    // Models are added, HDRs light the scene, images become the base colour of a material, projects
    // are opened.
    void addFiles(const QStringList& files, Id baseColorOf = 0);
    // `done` runs on the UI thread with whether it worked.
    void saveAs(const QString& file, std::function<void(bool)> done = {});

  Q_SIGNALS:
    void changed(const patina::Change& change);
    void fileChanged(); // path, name or modified state
    void noticed(const patina::editor::UserNotice& notice);
    void sceneOpened(const QString& scene); // absolute path or "builtin:NAME"
    void openFailed(const QString& scene);
    void saved(const QString& file);

  private:
    friend class DocumentCommand;
    void apply(const std::function<Change(Document&)>& edit); // for commands only
    void push(DocumentCommand* command);
    void replaceDocument(Document document, const QString& filePath, const QString& name,
                         bool pristine);

    WorkerClient& m_worker;
    Document m_document;
    QUndoStack m_undo;
    BackgroundTasks m_tasks;
    QString m_filePath, m_name;
    bool m_pristine = true;
    DragSession m_lastSession = 0;
};

} // namespace patina::editor
