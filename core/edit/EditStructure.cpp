// The part of EditSession that adds, removes and names elements.

#include "core/base/Check.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/LightPlacement.h"
#include "core/edit/EditSession.h"
#include "core/edit/EditSteps.h"
#include "core/edit/ResetValue.h"
#include "core/light/BrightSources.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

struct NewLight {
    const char* name; // of the light
    const char* text; // of the step
};

NewLight newLight(LightType type) {
    switch (type) {
    case LightType::Point:
        return {"Point", "Add Point Light"};
    case LightType::Directional:
        return {"Sun", "Add Directional Light"};
    case LightType::Spot:
        return {"Spot", "Add Spot Light"};
    case LightType::Sphere:
        return {"Sphere", "Add Sphere Light"};
    case LightType::Rectangle:
        break;
    }
    return {"Panel", "Add Rectangle Light"};
}

} // namespace

void EditSession::resetParameter(const ParameterInfo& info, const Target& target) {
    if (targetExists(m_document, target))
        setParameter(info, target, resetValue(m_document, info, target));
}

void EditSession::editStructure(const std::string& text,
                                const std::function<void(Document&)>& edit) {
    Document copy = m_document; // payloads are shared, so this is cheap
    // What still reads for an element that undo has removed must not find another one under its id.
    copy.nextId = std::max(copy.nextId, m_firstFreeId);
    edit(copy);
    m_firstFreeId = copy.nextId;
    push(std::make_unique<ReplaceElementsStep>(
        text, m_document,
        Elements{std::move(copy.meshes), std::move(copy.materials), std::move(copy.lights),
                 std::move(copy.environments), copy.mix, copy.nextId}));
}

void EditSession::rename(const Target& target, std::string_view name) {
    const bool mayBeEmpty = target.scope == Scope::Environment; // then called by what it shows
    if ((name.empty() && !mayBeEmpty) || !targetExists(m_document, target))
        return;
    const ParameterInfo* info = findParameter(fmt::format("{}.name", scopeName(target.scope)));
    if (info)
        setDiffering(target, {{info, std::string(name)}},
                     fmt::format("Rename {}", nameOf(m_document, target)));
}

// --- Lights --------------------------------------------------------------------------------------

Id EditSession::addLight(LightType type) {
    Light light = placedInView(defaultLight(type, m_document.bounds()), m_document);
    const NewLight made = newLight(type);
    light.name = made.name;
    Id id = 0;
    editStructure(made.text, [&](Document& document) { id = patina::addLight(document, light); });
    return id;
}

Id EditSession::duplicateLight(Id original) {
    Id id = 0;
    if (const Light* light = m_document.light(original))
        editStructure(fmt::format("Duplicate {}", light->name),
                      [&](Document& document) { id = patina::duplicateLight(document, original); });
    return id;
}

void EditSession::changeLight(const Light& light, const std::string& text, DragSession session) {
    setParameters({Scope::Light, light.id}, editsTo(light), text, session);
}

void EditSession::removeLight(Id id) {
    if (const Light* light = m_document.light(id))
        editStructure(fmt::format("Remove {}", light->name),
                      [id](Document& document) { patina::removeLight(document, id); });
}

// --- Materials and meshes ------------------------------------------------------------------------

Id EditSession::addMaterial() {
    Id id = 0;
    editStructure("Add Material",
                  [&](Document& document) { id = patina::addMaterial(document, Material{}); });
    return id;
}

Id EditSession::duplicateMaterial(Id original) {
    Id id = 0;
    if (const Material* material = m_document.material(original))
        editStructure(fmt::format("Duplicate {}", material->name), [&](Document& document) {
            id = patina::duplicateMaterial(document, original);
        });
    return id;
}

void EditSession::removeMaterial(Id id) {
    const Material* material = m_document.material(id);
    if (material && m_document.materials.size() > 1)
        editStructure(fmt::format("Remove {}", material->name),
                      [id](Document& document) { patina::removeMaterial(document, id); });
}

void EditSession::assignMaterial(Id mesh, Id material) {
    const Target target{Scope::Mesh, mesh};
    if (const Material* assigned = m_document.material(material))
        setDiffering(target, {{&parameter("mesh.material"), static_cast<int>(material)}},
                     fmt::format("Assign {} to {}", assigned->name, nameOf(m_document, target)));
}

void EditSession::setMeshVisible(Id mesh, bool visible) {
    const Target target{Scope::Mesh, mesh};
    setDiffering(target, {{&parameter("mesh.visible"), visible}},
                 fmt::format("{} {}", visible ? "Show" : "Hide", nameOf(m_document, target)));
}

void EditSession::placeMeshes(const Placements& placements, const std::string& text,
                              DragSession session) {
    Placements known;
    bool differs = false;
    for (const auto& [id, placement] : placements)
        if (const MeshInstance* mesh = m_document.mesh(id)) {
            known.emplace_back(id, placement);
            differs = differs || mesh->placement != placement;
        }
    // Within a drag a step back to the start is a change, too.
    if (differs)
        push(std::make_unique<PlaceMeshesStep>(text, m_document, std::move(known), session));
}

Id EditSession::duplicateMesh(Id original) {
    Id id = 0;
    if (const MeshInstance* mesh = m_document.mesh(original))
        editStructure(fmt::format("Duplicate {}", mesh->name),
                      [&](Document& document) { id = patina::duplicateMesh(document, original); });
    return id;
}

void EditSession::removeMesh(Id id) {
    if (const MeshInstance* mesh = m_document.mesh(id))
        editStructure(fmt::format("Remove {}", mesh->name),
                      [id](Document& document) { patina::removeMesh(document, id); });
}

// --- Environments --------------------------------------------------------------------------------

Id EditSession::addEnvironment(const Environment& environment, const std::string& text) {
    if (m_document.environments.size() >= kMaxEnvironments)
        return 0;
    Id id = 0;
    editStructure(text, [&](Document& document) {
        id = patina::addEnvironment(document, environment);
        document.mix.first = id;
    });
    return id;
}

Id EditSession::addSecondEnvironment(const Environment& environment, const std::string& text) {
    if (m_document.environments.size() >= kMaxEnvironments)
        return 0;
    Id id = 0;
    editStructure(text, [&](Document& document) {
        id = patina::addEnvironment(document, environment);
        fadeTo(document, id);
    });
    return id;
}

Id EditSession::addUnusedEnvironment(const Environment& environment, const std::string& text) {
    if (m_document.environments.size() >= kMaxEnvironments)
        return 0;
    Id id = 0;
    editStructure(text,
                  [&](Document& document) { id = patina::addEnvironment(document, environment); });
    return id;
}

Id EditSession::duplicateEnvironment(Id original) {
    const Environment* environment = m_document.environment(original);
    if (!environment || m_document.environments.size() >= kMaxEnvironments)
        return 0;
    Id id = 0;
    editStructure(fmt::format("Duplicate {}", environmentTitle(*environment)),
                  [&, found = environment->id](Document& document) {
                      id = patina::duplicateEnvironment(document, found);
                      document.mix.first = id;
                  });
    return id;
}

void EditSession::removeEnvironment(Id id) {
    const Environment* environment = m_document.environment(id);
    if (environment && m_document.environments.size() > 1)
        editStructure(fmt::format("Remove {}", environmentTitle(*environment)),
                      [found = environment->id](Document& document) {
                          patina::removeEnvironment(document, found);
                      });
}

void EditSession::lightWith(Id id) {
    const Environment* environment = m_document.environment(id);
    if (!environment)
        return;
    const Target scene{Scope::Environment, 0};
    setDiffering(scene,
                 editsFor(m_document, parameter("environment.first"), scene,
                          static_cast<int>(environment->id)),
                 fmt::format("Light with {}", environmentTitle(*environment)));
}

Id EditSession::extractSource(Id id, const BrightSource& source, int removed) {
    const Environment* environment = m_document.environment(id);
    if (!environment)
        return 0;
    Id light = 0;
    group("Extract Sun", [&] {
        editStructure("Add Light", [&](Document& document) {
            light = patina::addLight(document, lightOf(source, *document.environment(id)));
        });
        setParameter(parameter("environment.removedSources"), {Scope::Environment, id},
                     static_cast<float>(removed));
    });
    return light;
}

// --- Softboxes -----------------------------------------------------------------------------------

void EditSession::setSoftboxes(const std::string& text, const std::vector<Softbox>& softboxes) {
    editStructure(text, [&](Document& document) {
        document.environment().softboxes.clear();
        for (const Softbox& softbox : softboxes)
            patina::addSoftbox(document, softbox);
    });
}

Id EditSession::addSoftbox(float azimuthDeg, float elevationDeg) {
    if (m_document.environment().softboxes.size() >= kMaxSoftboxes)
        return 0;
    Softbox softbox;
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    Id id = 0;
    editStructure("Add Softbox",
                  [&](Document& document) { id = patina::addSoftbox(document, softbox); });
    return id;
}

Id EditSession::duplicateSoftbox(Id original) {
    const Softbox* softbox = m_document.softbox(original);
    if (!softbox)
        return 0;
    Id id = 0;
    editStructure(fmt::format("Duplicate {}", softbox->name), [&](Document& document) {
        id = patina::duplicateSoftbox(document, original);
        if (id == 0)
            return;
        // Beside the original, where it is seen. Azimuths wrap at 180°.
        Softbox& copy = *document.softbox(id);
        const ParameterInfo& azimuth = parameter("softbox.azimuthDeg");
        azimuth.set(document, id, clampToRange(azimuth, copy.azimuthDeg - 0.5f * copy.widthDeg));
    });
    return id;
}

void EditSession::removeSoftbox(Id id) {
    if (const Softbox* softbox = m_document.softbox(id))
        editStructure(fmt::format("Remove {}", softbox->name),
                      [id](Document& document) { patina::removeSoftbox(document, id); });
}

// --- Bakes ---------------------------------------------------------------------------------------

void EditSession::attachBake(BakeArtifactPtr bake) {
    CHECK(bake != nullptr);
    patina::attachBake(m_document, std::move(bake));
    announce({Affects::Bakes, std::nullopt});
    historyChanged();
}

void EditSession::removeBake(BakeKind kind) {
    if (std::ranges::any_of(m_document.bakes,
                            [&](const BakeArtifactPtr& bake) { return bake->kind == kind; }))
        push(std::make_unique<RemoveBakeStep>("Remove Bake", kind));
}

} // namespace patina
