#include "app/editor/document/DocumentController.h"

#include "app/editor/document/Commands.h"
#include "core/base/Check.h"

#include <algorithm>

namespace patina::editor {
namespace {

// What undo may keep alive beyond the document itself.
constexpr std::size_t kUndoPayloadBytes = std::size_t{1} << 30;
constexpr int kUndoSteps = 1000;

QString fromText(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

bool exists(const Document& document, Target target) {
    switch (target.scope) {
    case Scope::Mesh:
        return document.mesh(target.id) != nullptr;
    case Scope::Material:
        return document.material(target.id) != nullptr;
    case Scope::Light:
        return document.light(target.id) != nullptr;
    case Scope::Environment:
    case Scope::View:
        return target.id == 0;
    }
    return false;
}

} // namespace

DocumentController::DocumentController(WorkerClient& worker, QObject* parent)
    : QObject(parent)
    , m_worker(worker) {
    m_undo.setUndoLimit(kUndoSteps);
    connect(&m_undo, &QUndoStack::cleanChanged, this, &DocumentController::fileChanged);
    connect(&m_tasks, &BackgroundTasks::failed, this,
            [this](const QString& activity, const QString& reason) {
                Q_EMIT noticed({NoticeKind::Error, tr("%1 failed.").arg(activity), {reason}});
            });
}

DocumentController::~DocumentController() = default;

QString DocumentController::displayName() const {
    return m_name.isEmpty() ? tr("Untitled") : m_name;
}

bool DocumentController::isPristine() const {
    return m_pristine && m_undo.count() == 0;
}

void DocumentController::apply(const std::function<Change(Document&)>& edit) {
    const Change change = edit(m_document);
    Q_EMIT changed(change);
}

void DocumentController::push(DocumentCommand* command) {
    // When old images would take too much memory the history ends here; the document itself is
    // never at stake.
    if (const std::size_t own = command->payloadBytes(); own > 0) {
        std::size_t total = own;
        for (int index = 0; index < m_undo.count(); ++index)
            if (const auto* old = dynamic_cast<const DocumentCommand*>(m_undo.command(index)))
                total += old->payloadBytes();
        if (total > kUndoPayloadBytes && m_undo.count() > 0) {
            const bool wasClean = m_undo.isClean();
            m_undo.clear();
            if (!wasClean)
                m_undo.resetClean();
            m_pristine = false;
            Q_EMIT noticed({NoticeKind::Info,
                            tr("Earlier undo steps were dropped: their images took more than "
                               "1 GiB of memory."),
                            {}});
        }
    }
    m_undo.push(command);
}

// --- Parameters ----------------------------------------------------------------------------------

void DocumentController::setParameter(const ParameterInfo& info, Target target,
                                      const ParameterValue& value, DragSession session) {
    CHECK(info.scope == target.scope);
    if (!exists(m_document, target))
        return;
    ParameterValue after = clampToRange(info, value);
    if (after == info.get(m_document, target.id))
        return;
    const QString label = fromText(info.label);
    const std::string name = nameOf(m_document, target);
    const QString text = name.empty()
                             ? tr("Change %1").arg(label)
                             : tr("Change %1 of %2").arg(label, QString::fromStdString(name));
    push(new SetParameterCommand(*this, text, info, target, std::move(after), session));
}

void DocumentController::resetParameter(const ParameterInfo& info, Target target) {
    setParameter(info, target, info.defaultValue());
}

// --- Structure -----------------------------------------------------------------------------------

void DocumentController::replaceElements(const QString& undoText,
                                         const std::function<void(Elements&)>& edit) {
    Elements elements{m_document.meshes, m_document.materials, m_document.lights,
                      m_document.nextId};
    edit(elements);
    push(new ReplaceElementsCommand(*this, undoText, std::move(elements)));
}

void DocumentController::rename(Target target, const QString& name) {
    const QString trimmed = name.trimmed();
    const std::string before = nameOf(m_document, target);
    if (!exists(m_document, target) || trimmed.isEmpty() || trimmed.toStdString() == before)
        return;
    push(new RenameCommand(*this, tr("Rename %1").arg(QString::fromStdString(before)), target,
                           trimmed.toStdString()));
}

Id DocumentController::addLight(LightType type) {
    Id id = 0;
    const bool point = type == LightType::Point;
    const QString base = point ? tr("Point") : tr("Sun");
    replaceElements(point ? tr("Add Point Light") : tr("Add Directional Light"),
                    [&](Elements& elements) {
                        Light light;
                        light.id = id = elements.nextId++;
                        light.type = type;
                        light.name = uniqueName(base.toStdString(), elements.lights);
                        if (point)
                            light.intensity = 20.0f;
                        elements.lights.push_back(light);
                    });
    return id;
}

void DocumentController::removeLight(Id id) {
    const Light* light = m_document.light(id);
    if (!light)
        return;
    replaceElements(tr("Remove %1").arg(QString::fromStdString(light->name)),
                    [id](Elements& elements) {
                        std::erase_if(elements.lights, [id](const Light& l) { return l.id == id; });
                    });
}

Id DocumentController::addMaterial(Id copyOf) {
    Id id = 0;
    const Material* original = m_document.material(copyOf);
    replaceElements(original ? tr("Duplicate %1").arg(QString::fromStdString(original->name))
                             : tr("Add Material"),
                    [&](Elements& elements) {
                        Material material = original ? *original : Material{};
                        material.name = uniqueName(material.name, elements.materials);
                        material.id = id = elements.nextId++;
                        elements.materials.push_back(std::move(material));
                    });
    return id;
}

void DocumentController::removeMaterial(Id id) {
    const Material* material = m_document.material(id);
    if (!material || m_document.materials.size() < 2)
        return;
    replaceElements(
        tr("Remove %1").arg(QString::fromStdString(material->name)), [id](Elements& elements) {
            std::erase_if(elements.materials, [id](const Material& m) { return m.id == id; });
            for (MeshInstance& mesh : elements.meshes)
                if (mesh.material == id)
                    mesh.material = elements.materials.front().id;
        });
}

void DocumentController::assignMaterial(Id meshId, Id materialId) {
    const MeshInstance* mesh = m_document.mesh(meshId);
    const Material* material = m_document.material(materialId);
    if (!mesh || !material || mesh->material == materialId)
        return;
    replaceElements(
        tr("Assign %1 to %2")
            .arg(QString::fromStdString(material->name), QString::fromStdString(mesh->name)),
        [=](Elements& elements) {
            for (MeshInstance& candidate : elements.meshes)
                if (candidate.id == meshId)
                    candidate.material = materialId;
        });
}

void DocumentController::removeMesh(Id id) {
    const MeshInstance* mesh = m_document.mesh(id);
    if (!mesh)
        return;
    replaceElements(
        tr("Remove %1").arg(QString::fromStdString(mesh->name)), [id](Elements& elements) {
            std::erase_if(elements.meshes, [id](const MeshInstance& m) { return m.id == id; });
        });
}

// --- Bakes and view ------------------------------------------------------------------------------

void DocumentController::attachBake(BakeArtifactPtr artifact) {
    CHECK(artifact != nullptr);
    std::vector<BakeArtifactPtr> bakes = m_document.bakes;
    std::erase_if(bakes, [&](const BakeArtifactPtr& old) { return old->kind == artifact->kind; });
    bakes.push_back(std::move(artifact));
    push(new SetBakesCommand(*this, tr("Attach Bake"), std::move(bakes)));
}

void DocumentController::detachBake(BakeKind kind) {
    std::vector<BakeArtifactPtr> bakes = m_document.bakes;
    if (std::erase_if(bakes, [&](const BakeArtifactPtr& old) { return old->kind == kind; }) > 0)
        push(new SetBakesCommand(*this, tr("Remove Bake"), std::move(bakes)));
}

void DocumentController::setCamera(const Camera& camera) {
    if (camera == m_document.view.camera)
        return;
    m_document.view.camera = camera;
    Q_EMIT changed({Affects::Nothing, Target{Scope::View, 0}});
}

} // namespace patina::editor
