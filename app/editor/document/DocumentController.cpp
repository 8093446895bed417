#include "app/editor/document/DocumentController.h"

#include "app/editor/document/Commands.h"
#include "app/editor/document/EnvironmentResolver.h"
#include "core/base/Check.h"
#include "core/document/LightPlacement.h"
#include "core/edit/ResetValue.h"
#include "core/light/Lights.h"

#include <algorithm>

namespace patina::editor {
namespace {

// What undo may keep alive beyond the document itself.
constexpr std::size_t kUndoPayloadBytes = std::size_t{1} << 30;
constexpr int kUndoSteps = 1000;

QString fromText(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

} // namespace

DocumentController::DocumentController(WorkerClient& worker, QObject* parent)
    : QObject(parent)
    , m_worker(worker)
    , m_tasks(4) // most of them wait for the worker process or for the disk
    , m_environment(new EnvironmentResolver(this)) {
    m_undo.setUndoLimit(kUndoSteps);
    connect(&m_undo, &QUndoStack::canRedoChanged, this, &DocumentController::deliverWaiting,
            Qt::QueuedConnection); // not in the middle of a push
    connect(m_environment, &EnvironmentResolver::refined, this, [this](const ImagePtr& image) {
        m_document.environment.image = image;
        m_environment->update(m_document);
        announce({Affects::EnvironmentMap, Target{Scope::Environment, 0}});
    });
    connect(m_environment, &EnvironmentResolver::blended, this, [this](const ImagePtr& image) {
        m_document.environment.blended = image;
        announce({Affects::EnvironmentMap, Target{Scope::Environment, 0}});
    });
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
    Change change = edit(m_document);
    if (m_environment->update(m_document))
        change.affects = change.affects | Affects::EnvironmentMap;
    announce(change);
}

void DocumentController::announce(const Change& change) {
    ++m_revision;
    Q_EMIT changed(change);
    noteModified();
}

void DocumentController::noteModified() {
    if (isModified() == m_shownModified)
        return;
    m_shownModified = !m_shownModified;
    Q_EMIT fileChanged();
}

DocumentState DocumentController::state() const {
    return {m_history, m_step, m_document.bakes};
}

int DocumentController::unsavedSteps() const {
    if (m_saved.history != m_history)
        return 0;
    const auto command = [this](int index) {
        return dynamic_cast<const DocumentCommand*>(m_undo.command(index));
    };
    for (int index = m_undo.index() - 1; index >= 0; --index)
        if (const auto* done = command(index); done && done->stepBefore() == m_saved.step)
            return m_undo.index() - index;
    for (int index = m_undo.index(); index < m_undo.count(); ++index)
        if (const auto* undone = command(index); undone && undone->stepAfter() == m_saved.step)
            return index + 1 - m_undo.index();
    return 0;
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
            m_undo.clear();
            m_pristine = false;
            Q_EMIT noticed({NoticeKind::Info,
                            tr("Earlier undo steps were dropped: their images took more than "
                               "1 GiB of memory."),
                            {}});
        }
    }
    m_undo.push(command);
    noteModified(); // a drag that returned to its start
}

void DocumentController::pushOrApply(std::unique_ptr<DocumentCommand> command) {
    if (!m_undo.canRedo()) {
        push(command.release());
        return;
    }
    m_pristine = false;
    command->applyOnly();
}

void DocumentController::deliver(const Begun& begun, const QString& name,
                                 std::function<void()> edit) {
    if (!m_undo.canRedo() || state() == begun.state) {
        const bool expected = m_opening && begun.opened < m_opened && *m_opening == state();
        edit();
        if (expected)
            *m_opening = state();
        return;
    }
    m_waiting.push_back(std::move(edit));
    Q_EMIT noticed(
        {NoticeKind::Info,
         tr("%1 is ready, but you have gone back since; it comes with your next edit, or "
            "when you have redone everything.")
             .arg(name),
         {}});
}

void DocumentController::deliverWaiting() {
    while (!m_waiting.empty() && !m_undo.canRedo()) {
        const std::function<void()> edit = std::move(m_waiting.front());
        m_waiting.erase(m_waiting.begin());
        edit();
    }
}

// --- Parameters ----------------------------------------------------------------------------------

void DocumentController::setParameter(const ParameterInfo& info, Target target,
                                      const ParameterValue& value, DragSession session) {
    CHECK(info.scope == target.scope);
    // What a file shows depends on its layout: it is read anew.
    if (info.id == "environment.layout") {
        const Environment& environment = m_document.environment;
        if (ParameterValue(static_cast<int>(environment.layout)) != value)
            readEnvironment(QString::fromStdString(environment.source),
                            static_cast<EnvironmentLayout>(std::get<int>(value)),
                            tr("Change %1").arg(fromText(info.label)));
        return;
    }
    if (!targetExists(m_document, target))
        return;
    const QString label = fromText(info.label);
    const std::string name = nameOf(m_document, target);
    const QString text = name.empty()
                             ? tr("Change %1").arg(label)
                             : tr("Change %1 of %2").arg(label, QString::fromStdString(name));
    const std::vector<ParameterEdit> edits = editsFor(m_document, info, target, value);
    if (info.onSet) // always the same parameters, so that edits of one session merge
        setParameters(target, edits, text, session);
    else
        pushParameters(target, edits, session, text);
}

void DocumentController::pushParameters(Target target, const std::vector<ParameterEdit>& edits,
                                        DragSession session, const QString& text) {
    if (!targetExists(m_document, target))
        return;
    std::vector<ParameterEdit> after;
    for (const ParameterEdit& edit : edits) {
        ParameterValue value = clampToRange(*edit.info, edit.value);
        if (value != edit.info->get(m_document, target.id))
            after.push_back({edit.info, std::move(value)});
    }
    if (!after.empty())
        push(new SetParametersCommand(*this, text, target, std::move(after), session));
}

void DocumentController::setParameters(Target target, const std::vector<ParameterEdit>& edits,
                                       const QString& text, DragSession session) {
    if (!targetExists(m_document, target))
        return;
    std::vector<ParameterEdit> after;
    bool differs = false;
    for (const ParameterEdit& edit : edits) {
        after.push_back({edit.info, clampToRange(*edit.info, edit.value)});
        differs = differs || after.back().value != edit.info->get(m_document, target.id);
    }
    if (differs)
        push(new SetParametersCommand(*this, text, target, std::move(after), session));
}

void DocumentController::resetParameter(const ParameterInfo& info, Target target) {
    if (targetExists(m_document, target))
        setParameter(info, target, resetValue(m_document, info, target));
}

// --- Structure -----------------------------------------------------------------------------------

void DocumentController::editStructure(const QString& undoText,
                                       const std::function<void(Document&)>& edit) {
    Document copy = m_document; // payloads are shared, so this is cheap
    // What still reads for an element that undo has removed must not find another one under its id.
    copy.nextId = std::max(copy.nextId, m_firstFreeId);
    edit(copy);
    m_firstFreeId = copy.nextId;
    push(new ReplaceElementsCommand(*this, undoText,
                                    {std::move(copy.meshes), std::move(copy.materials),
                                     std::move(copy.lights), std::move(copy.environment.softboxes),
                                     copy.nextId}));
}

void DocumentController::rename(Target target, const QString& name) {
    const QString trimmed = name.trimmed();
    if (trimmed.isEmpty() || !targetExists(m_document, target))
        return;
    pushParameters(target,
                   {{&parameter(target.scope == Scope::Mesh       ? "mesh.name"
                                : target.scope == Scope::Material ? "material.name"
                                : target.scope == Scope::Softbox  ? "softbox.name"
                                                                  : "light.name"),
                     trimmed.toStdString()}},
                   0, tr("Rename %1").arg(nameText(target)));
}

QString DocumentController::nameText(Target target) const {
    return QString::fromStdString(nameOf(m_document, target));
}

Id DocumentController::addLight(LightType type) {
    Light light = placedInView(defaultLight(type, m_document.bounds()), m_document);
    QString undoText;
    switch (type) {
    case LightType::Point:
        light.name = tr("Point").toStdString(), undoText = tr("Add Point Light");
        break;
    case LightType::Directional:
        light.name = tr("Sun").toStdString(), undoText = tr("Add Directional Light");
        break;
    case LightType::Spot:
        light.name = tr("Spot").toStdString(), undoText = tr("Add Spot Light");
        break;
    case LightType::Sphere:
        light.name = tr("Sphere").toStdString(), undoText = tr("Add Sphere Light");
        break;
    case LightType::Rectangle:
        light.name = tr("Panel").toStdString(), undoText = tr("Add Rectangle Light");
        break;
    }
    Id id = 0;
    editStructure(undoText, [&](Document& document) { id = patina::addLight(document, light); });
    return id;
}

Id DocumentController::duplicateLight(Id original) {
    Id id = 0;
    if (m_document.light(original))
        editStructure(tr("Duplicate %1").arg(nameText({Scope::Light, original})),
                      [&](Document& document) { id = patina::duplicateLight(document, original); });
    return id;
}

void DocumentController::changeLight(const Light& light, DragSession session, const QString& text) {
    setParameters({Scope::Light, light.id}, editsTo(light), text, session);
}

void DocumentController::removeLight(Id id) {
    if (m_document.light(id))
        editStructure(tr("Remove %1").arg(nameText({Scope::Light, id})),
                      [id](Document& document) { patina::removeLight(document, id); });
}

Id DocumentController::addMaterial() {
    Id id = 0;
    editStructure(tr("Add Material"),
                  [&](Document& document) { id = patina::addMaterial(document, Material{}); });
    return id;
}

Id DocumentController::duplicateMaterial(Id original) {
    Id id = 0;
    if (m_document.material(original))
        editStructure(
            tr("Duplicate %1").arg(nameText({Scope::Material, original})),
            [&](Document& document) { id = patina::duplicateMaterial(document, original); });
    return id;
}

void DocumentController::removeMaterial(Id id) {
    if (m_document.material(id) && m_document.materials.size() > 1)
        editStructure(tr("Remove %1").arg(nameText({Scope::Material, id})),
                      [id](Document& document) { patina::removeMaterial(document, id); });
}

void DocumentController::assignMaterial(Id mesh, Id material) {
    if (m_document.material(material))
        pushParameters(
            {Scope::Mesh, mesh}, {{&parameter("mesh.material"), static_cast<int>(material)}}, 0,
            tr("Assign %1 to %2")
                .arg(nameText({Scope::Material, material}), nameText({Scope::Mesh, mesh})));
}

void DocumentController::setMeshVisible(Id mesh, bool visible) {
    pushParameters({Scope::Mesh, mesh}, {{&parameter("mesh.visible"), visible}}, 0,
                   (visible ? tr("Show %1") : tr("Hide %1")).arg(nameText({Scope::Mesh, mesh})));
}

void DocumentController::removeMesh(Id id) {
    if (m_document.mesh(id))
        editStructure(tr("Remove %1").arg(nameText({Scope::Mesh, id})),
                      [id](Document& document) { patina::removeMesh(document, id); });
}

// --- Bakes and view ------------------------------------------------------------------------------

void DocumentController::attachBake(BakeArtifactPtr artifact) {
    CHECK(artifact != nullptr);
    const BakeKind kind = artifact->kind;
    pushOrApply(
        std::make_unique<SetBakeCommand>(*this, tr("Attach Bake"), kind, std::move(artifact)));
}

void DocumentController::detachBake(BakeKind kind) {
    if (std::ranges::any_of(m_document.bakes,
                            [&](const BakeArtifactPtr& bake) { return bake->kind == kind; }))
        push(new SetBakeCommand(*this, tr("Remove Bake"), kind, nullptr));
}

void DocumentController::renewBake(const BakeArtifactPtr& before, BakeArtifactPtr after) {
    const auto found = std::find(m_document.bakes.begin(), m_document.bakes.end(), before);
    if (found == m_document.bakes.end())
        return;
    *found = std::move(after);
    announce({Affects::Bakes, std::nullopt});
}

void DocumentController::showLighting(LightingMode mode) {
    const ParameterInfo& info = parameter("view.lighting");
    const Target view{Scope::View, 0};
    if (m_document.view.lighting != mode)
        pushOrApply(std::make_unique<SetParametersCommand>(
            *this, tr("Change %1").arg(fromText(info.label)), view,
            std::vector<ParameterEdit>{{&info, static_cast<int>(mode)}}, 0));
}

void DocumentController::setCamera(const Camera& camera) {
    if (camera == m_document.view.camera)
        return;
    m_document.view.camera = camera;
    announce({Affects::Nothing, Target{Scope::View, 0}});
}

} // namespace patina::editor
