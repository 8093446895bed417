#include "app/editor/document/Commands.h"

#include "core/base/Check.h"

#include <algorithm>
#include <set>

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
    if (!next || next->m_session != m_session || next->m_target != m_target ||
        !std::equal(m_after.begin(), m_after.end(), next->m_after.begin(), next->m_after.end(),
                    [](const auto& a, const auto& b) { return a.info == b.info; }))
        return false;
    m_after = next->m_after;
    setObsolete(std::equal(m_before.begin(), m_before.end(), m_after.begin(),
                           [](const auto& a, const auto& b) { return a.value == b.value; }));
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
    return {Affects::Structure | Affects::Geometry | Affects::Texture | Affects::Uniform |
                Affects::Bakes,
            std::nullopt};
}

SetBakesCommand::SetBakesCommand(DocumentController& controller, const QString& text,
                                 std::vector<BakeArtifactPtr> after)
    : DocumentCommand(controller, text)
    , m_before(controller.document().bakes)
    , m_after(std::move(after)) {}

std::size_t SetBakesCommand::payloadBytes() const {
    std::size_t bytes = 0;
    std::set<const BakeArtifact*> before;
    for (const BakeArtifactPtr& artifact : m_before)
        before.insert(artifact.get());
    for (const BakeArtifactPtr& artifact : m_after) {
        if (before.contains(artifact.get()))
            continue;
        for (const VertexBake& bake : artifact->vertices)
            bytes += bake.values.size() * sizeof(float);
        for (const TexelBake& bake : artifact->texels)
            bytes += imageBytes(bake.image);
    }
    return bytes;
}

Change SetBakesCommand::swap(Document& document, bool forward) {
    document.bakes = forward ? m_after : m_before;
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
