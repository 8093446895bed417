#include "app/editor/document/Commands.h"

#include "core/base/Check.h"

#include <algorithm>
#include <map>
#include <utility>

namespace patina::editor {
namespace {

std::size_t imageBytes(const ImagePtr& image) {
    return image ? image->bytes().size() : 0;
}

// Everything heavy that `elements` refers to, by address.
std::map<const void*, std::size_t> payloads(const Elements& elements) {
    std::map<const void*, std::size_t> result;
    for (const MeshInstance& instance : elements.meshes) {
        if (!instance.mesh)
            continue;
        const std::size_t vertexBytes =
            2 * sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2);
        result[instance.mesh.get()] = instance.mesh->vertexCount() * vertexBytes +
                                      instance.mesh->indices.size() * sizeof(std::uint32_t);
    }
    for (const Material& material : elements.materials)
        for (const MapSlot* slot :
             {&material.baseColorMap, &material.metallicMap, &material.perceptualRoughnessMap,
              &material.normalMap, &material.occlusionMap, &material.emissiveMap})
            if (slot->image)
                result[slot->image.get()] = imageBytes(slot->image);
    return result;
}

} // namespace

DocumentCommand::DocumentCommand(DocumentController& controller, const QString& text)
    : QUndoCommand(text)
    , m_controller(controller)
    , m_mergeMark(controller.m_mergeMark) {}

void DocumentCommand::undo() {
    m_controller.m_step = m_stepBefore;
    m_controller.apply([this](Document& document) { return swap(document, false); });
}

void DocumentCommand::redo() {
    if (m_stepAfter == 0) {
        m_stepBefore = m_controller.m_step;
        m_stepAfter = ++m_controller.m_lastStep;
    }
    m_controller.m_step = m_stepAfter;
    m_controller.apply([this](Document& document) { return swap(document, true); });
}

void DocumentCommand::applyOnly() {
    ++m_controller.m_history;
    m_controller.apply([this](Document& document) { return swap(document, true); });
}

void DocumentCommand::merged(const DocumentCommand& next) {
    m_stepAfter = next.m_stepAfter;
    if (isObsolete())
        m_controller.m_step = m_stepBefore;
}

SetParametersCommand::SetParametersCommand(DocumentController& controller, const QString& text,
                                           Target target, std::vector<ParameterEdit> after,
                                           DragSession session)
    : DocumentCommand(controller, text)
    , m_target(target)
    , m_after(std::move(after))
    , m_session(session) {
    for (const ParameterEdit& edit : m_after)
        m_before.push_back({edit.info, edit.info->get(controller.document(), target.id)});
}

bool SetParametersCommand::mergeWith(const QUndoCommand* other) {
    const auto* next = dynamic_cast<const SetParametersCommand*>(other);
    if (!next || !mayMerge(*next) || next->m_session != m_session || next->m_target != m_target ||
        !std::equal(m_after.begin(), m_after.end(), next->m_after.begin(), next->m_after.end(),
                    [](const auto& a, const auto& b) { return a.info == b.info; }))
        return false;
    m_after = next->m_after;
    setObsolete(std::equal(m_before.begin(), m_before.end(), m_after.begin(),
                           [](const auto& a, const auto& b) { return a.value == b.value; }));
    merged(*next);
    return true;
}

std::size_t SetParametersCommand::payloadBytes() const {
    std::size_t bytes = 0;
    for (const auto* edits : {&m_before, &m_after})
        for (const ParameterEdit& edit : *edits)
            if (const auto* slot = std::get_if<MapSlot>(&edit.value))
                bytes += imageBytes(slot->image);
    return bytes;
}

Change SetParametersCommand::swap(Document& document, bool forward) {
    Change change{Affects::Nothing, m_target};
    for (const ParameterEdit& edit : forward ? m_after : m_before) {
        edit.info->set(document, m_target.id, edit.value);
        change.affects = change.affects | edit.info->affects;
    }
    return change;
}

ReplaceElementsCommand::ReplaceElementsCommand(DocumentController& controller, const QString& text,
                                               Elements after)
    : DocumentCommand(controller, text)
    , m_after(std::move(after)) {
    const Document& document = controller.document();
    m_before = {document.meshes, document.materials, document.lights,
                document.environment.softboxes, document.nextId};
}

std::size_t ReplaceElementsCommand::payloadBytes() const {
    const auto before = payloads(m_before);
    const auto after = payloads(m_after);
    std::size_t bytes = 0;
    for (const auto& [address, size] : before)
        bytes += after.contains(address) ? 0 : size;
    for (const auto& [address, size] : after)
        bytes += before.contains(address) ? 0 : size;
    return bytes;
}

Change ReplaceElementsCommand::swap(Document& document, bool forward) {
    const Elements& elements = forward ? m_after : m_before;
    document.meshes = elements.meshes;
    document.materials = elements.materials;
    document.lights = elements.lights;
    document.environment.softboxes = elements.softboxes;
    document.nextId = elements.nextId;
    return {Affects::Structure | Affects::Geometry | Affects::Picture | Affects::Bakes,
            std::nullopt};
}

SetBakeCommand::SetBakeCommand(DocumentController& controller, const QString& text, BakeKind kind,
                               BakeArtifactPtr bake)
    : DocumentCommand(controller, text)
    , m_kind(kind)
    , m_other(std::move(bake)) {}

std::size_t SetBakeCommand::payloadBytes() const {
    std::size_t bytes = 0;
    if (m_other) {
        for (const VertexBake& bake : m_other->vertices)
            bytes += bake.values.size() * sizeof(float);
        for (const TexelBake& bake : m_other->texels)
            bytes += imageBytes(bake.image);
    }
    return bytes;
}

// In the order of their kinds: a bake that comes back takes the place it had.
Change SetBakeCommand::swap(Document& document, bool /*forward*/) {
    std::vector<BakeArtifactPtr>& bakes = document.bakes;
    const auto place =
        std::ranges::find_if(bakes, [this](const auto& bake) { return bake->kind == m_kind; });
    if (place == bakes.end()) {
        if (m_other)
            bakes.insert(std::ranges::find_if(
                             bakes, [this](const auto& bake) { return bake->kind > m_kind; }),
                         std::exchange(m_other, nullptr));
    } else if (m_other) {
        std::swap(*place, m_other);
    } else {
        m_other = *place;
        bakes.erase(place);
    }
    return {Affects::Bakes, std::nullopt};
}

const ParameterInfo& parameter(const char* id) {
    const ParameterInfo* info = findParameter(id);
    CHECK(info != nullptr);
    return *info;
}

std::string nameOf(const Document& document, Target target) {
    switch (target.scope) {
    case Scope::Mesh:
        if (const MeshInstance* mesh = document.mesh(target.id))
            return mesh->name;
        break;
    case Scope::Material:
        if (const Material* material = document.material(target.id))
            return material->name;
        break;
    case Scope::Light:
        if (const Light* light = document.light(target.id))
            return light->name;
        break;
    case Scope::Softbox:
        if (const Softbox* softbox = document.softbox(target.id))
            return softbox->name;
        break;
    case Scope::Environment:
    case Scope::Model:
    case Scope::View:
        break;
    }
    return {};
}

} // namespace patina::editor
