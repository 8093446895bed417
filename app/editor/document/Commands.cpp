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

std::string* nameIn(Document& document, Target target) {
    switch (target.scope) {
    case Scope::Mesh:
        if (MeshInstance* mesh = document.mesh(target.id))
            return &mesh->name;
        break;
    case Scope::Material:
        if (Material* material = document.material(target.id))
            return &material->name;
        break;
    case Scope::Light:
        if (Light* light = document.light(target.id))
            return &light->name;
        break;
    case Scope::Environment:
    case Scope::View:
        break;
    }
    return nullptr;
}

} // namespace

SetParameterCommand::SetParameterCommand(DocumentController& controller, const QString& text,
                                         const ParameterInfo& info, Target target,
                                         ParameterValue after, DragSession session)
    : DocumentCommand(controller, text)
    , m_info(info)
    , m_target(target)
    , m_before(info.get(controller.document(), target.id))
    , m_after(std::move(after))
    , m_session(session) {}

bool SetParameterCommand::mergeWith(const QUndoCommand* other) {
    const auto* next = dynamic_cast<const SetParameterCommand*>(other);
    if (!next || next->m_session != m_session || &next->m_info != &m_info ||
        next->m_target != m_target)
        return false;
    m_after = next->m_after;
    setObsolete(m_after == m_before);
    return true;
}

std::size_t SetParameterCommand::payloadBytes() const {
    const auto* before = std::get_if<MapSlot>(&m_before);
    const auto* after = std::get_if<MapSlot>(&m_after);
    if (!before || !after || before->image == after->image)
        return 0;
    return imageBytes(before->image) + imageBytes(after->image);
}

Change SetParameterCommand::swap(Document& document, bool forward) {
    m_info.set(document, m_target.id, forward ? m_after : m_before);
    return {m_info.affects, m_target};
}

ReplaceElementsCommand::ReplaceElementsCommand(DocumentController& controller, const QString& text,
                                               Elements after)
    : DocumentCommand(controller, text)
    , m_after(std::move(after)) {
    const Document& document = controller.document();
    m_before = {document.meshes, document.materials, document.lights, document.nextId};
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
    document.nextId = elements.nextId;
    return {Affects::Structure | Affects::Geometry | Affects::Texture | Affects::Uniform |
                Affects::Bakes,
            std::nullopt};
}

RenameCommand::RenameCommand(DocumentController& controller, const QString& text, Target target,
                             std::string after)
    : DocumentCommand(controller, text)
    , m_target(target)
    , m_before(nameOf(controller.document(), target))
    , m_after(std::move(after)) {}

Change RenameCommand::swap(Document& document, bool forward) {
    std::string* name = nameIn(document, m_target);
    CHECK(name != nullptr);
    *name = forward ? m_after : m_before;
    return {Affects::Structure, m_target};
}

SetEnvironmentCommand::SetEnvironmentCommand(DocumentController& controller, const QString& text,
                                             std::string source, ImagePtr image)
    : DocumentCommand(controller, text)
    , m_after{std::move(source), std::move(image), {}} {
    const Environment& environment = controller.document().environment;
    m_before = {environment.source, environment.image, environment.problem};
}

std::size_t SetEnvironmentCommand::payloadBytes() const {
    return imageBytes(m_before.image) + imageBytes(m_after.image);
}

Change SetEnvironmentCommand::swap(Document& document, bool forward) {
    const Sky& sky = forward ? m_after : m_before;
    document.environment.source = sky.source;
    document.environment.image = sky.image;
    document.environment.problem = sky.problem;
    return {Affects::EnvironmentMap | Affects::Uniform, Target{Scope::Environment, 0}};
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

std::string nameOf(const Document& document, Target target) {
    // nameIn() only looks; the const_cast spares a second switch.
    const std::string* name = nameIn(const_cast<Document&>(document), target);
    return name ? *name : std::string();
}

} // namespace patina::editor
