#include "core/edit/EditSteps.h"

#include "core/edit/Edit.h"
#include "core/image/Srgb.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace patina {
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
        forEachMap(material, [&](const MapSlot& map) {
            if (map.image)
                result[map.image.get()] = imageBytes(map.image);
        });
    for (const Environment& environment : elements.environments)
        for (const ImagePtr* image : {&environment.image, &environment.fileImage})
            if (*image)
                result[image->get()] = imageBytes(*image);
    return result;
}

// As the panel shows it; empty for what has no short text.
std::string shownValue(const ParameterEdit& edit) {
    const ParameterInfo& info = *edit.info;
    const std::string_view unit = info.unit;
    switch (info.type) {
    case ParameterType::Float:
        return fmt::format("{:.{}f}{}{}", std::get<float>(edit.value), info.decimals,
                           unit.empty() || unit == "°" ? "" : " ", unit);
    case ParameterType::Bool:
        return std::get<bool>(edit.value) ? "on" : "off";
    case ParameterType::Choice:
        return std::string(info.choiceLabels[static_cast<std::size_t>(std::get<int>(edit.value))]);
    case ParameterType::Color: {
        const glm::vec3 color = std::get<glm::vec3>(edit.value);
        return fmt::format("#{:02x}{:02x}{:02x}", linearToSrgb8(color.r), linearToSrgb8(color.g),
                           linearToSrgb8(color.b));
    }
    default:
        return {};
    }
}

// The same part of the same file was read twice.
void shareMeshes(const Document& from, Document& to) {
    std::map<std::pair<std::string, int>, MeshPtr> known;
    for (const MeshInstance& instance : from.meshes)
        known[{instance.source, instance.sourceIndex}] = instance.mesh;
    for (MeshInstance& instance : to.meshes) {
        const auto found = known.find({instance.source, instance.sourceIndex});
        if (found != known.end() && found->second && instance.mesh &&
            *found->second == *instance.mesh)
            instance.mesh = found->second;
    }
}

} // namespace

SetParametersStep::SetParametersStep(std::string text, const Document& document, Target target,
                                     std::vector<ParameterEdit> after, DragSession session)
    : EditStep(std::move(text))
    , m_target(target)
    , m_after(std::move(after))
    , m_session(session) {
    for (const ParameterEdit& edit : m_after)
        m_before.push_back({edit.info, edit.info->get(document, target.id)});
}

bool SetParametersStep::merge(const EditStep& step) {
    const auto* next = dynamic_cast<const SetParametersStep*>(&step);
    if (!next || m_session == 0 || next->m_session != m_session || next->m_target != m_target ||
        !std::equal(m_after.begin(), m_after.end(), next->m_after.begin(), next->m_after.end(),
                    [](const auto& a, const auto& b) { return a.info == b.info; }))
        return false;
    m_after = next->m_after;
    return true;
}

std::string SetParametersStep::values() const {
    const ParameterEdit *before = nullptr, *after = nullptr;
    for (std::size_t i = 0; i < m_after.size(); ++i) {
        if (m_before[i].value == m_after[i].value)
            continue;
        if (before != nullptr)
            return {}; // several: none stands for the others
        before = &m_before[i];
        after = &m_after[i];
    }
    if (before == nullptr || shownValue(*before).empty())
        return {};
    return fmt::format("{} → {}", shownValue(*before), shownValue(*after));
}

bool SetParametersStep::isEmpty() const {
    return std::equal(m_before.begin(), m_before.end(), m_after.begin(),
                      [](const auto& a, const auto& b) { return a.value == b.value; });
}

std::size_t SetParametersStep::payloadBytes() const {
    std::size_t bytes = 0;
    for (const auto* edits : {&m_before, &m_after})
        for (const ParameterEdit& edit : *edits)
            if (const auto* slot = std::get_if<MapSlot>(&edit.value))
                bytes += imageBytes(slot->image);
    return bytes;
}

Change SetParametersStep::swap(Document& document, bool forward) {
    Change change{Affects::Nothing, m_target};
    for (const ParameterEdit& edit : forward ? m_after : m_before) {
        edit.info->set(document, m_target.id, edit.value);
        change.affects = change.affects | edit.info->affects;
    }
    return change;
}

template <auto Member>
MeshesStep<Member>::MeshesStep(std::string text, const Document& document,
                               std::vector<std::pair<Id, Value>> after, DragSession session)
    : EditStep(std::move(text))
    , m_after(std::move(after))
    , m_session(session) {
    for (const auto& [id, value] : m_after)
        m_before.emplace_back(id, document.mesh(id)->*Member);
}

template <auto Member>
bool MeshesStep<Member>::merge(const EditStep& step) {
    const auto* next = dynamic_cast<const MeshesStep*>(&step);
    if (!next || m_session == 0 || next->m_session != m_session ||
        !std::ranges::equal(m_after, next->m_after, {}, &std::pair<Id, Value>::first,
                            &std::pair<Id, Value>::first))
        return false;
    m_after = next->m_after;
    return true;
}

template <auto Member>
Change MeshesStep<Member>::swap(Document& document, bool forward) {
    for (const auto& [id, value] : forward ? m_after : m_before)
        document.mesh(id)->*Member = value;
    return {Affects::Geometry | Affects::Bakes, std::nullopt};
}

template class MeshesStep<&MeshInstance::visible>;
template class MeshesStep<&MeshInstance::placement>;

ReplaceElementsStep::ReplaceElementsStep(std::string text, const Document& before, Elements after)
    : EditStep(std::move(text))
    , m_before{before.meshes,       before.materials, before.lights,
               before.environments, before.mix,       before.nextId}
    , m_after(std::move(after)) {}

std::size_t ReplaceElementsStep::payloadBytes() const {
    const auto before = payloads(m_before);
    const auto after = payloads(m_after);
    std::size_t bytes = 0;
    for (const auto& [address, size] : before)
        bytes += after.contains(address) ? 0 : size;
    for (const auto& [address, size] : after)
        bytes += before.contains(address) ? 0 : size;
    return bytes;
}

Change ReplaceElementsStep::swap(Document& document, bool forward) {
    const Elements& elements = forward ? m_after : m_before;
    const std::vector<Environment> shown = std::move(document.environments);
    const ImagePtr blended = document.mix.blended;
    document.meshes = elements.meshes;
    document.materials = elements.materials;
    document.lights = elements.lights;
    document.environments = elements.environments;
    document.mix = elements.mix;
    // What was made for the state that goes (a finer picture) serves where the recipe is the same.
    document.mix.blended = blended;
    for (const Environment& before : shown)
        if (Environment* environment = document.environment(before.id);
            environment && isGenerated(environmentRecipe(before)) &&
            environmentRecipe(*environment) == environmentRecipe(before))
            environment->image = before.image;
    document.nextId = elements.nextId;
    return {Affects::Structure | Affects::Geometry | Affects::Picture | Affects::Bakes,
            std::nullopt};
}

ReplaceSnapshotsStep::ReplaceSnapshotsStep(std::string text, const Document& before,
                                           std::vector<Snapshot> after, Id nextId)
    : EditStep(std::move(text))
    , m_before(before.snapshots)
    , m_after(std::move(after))
    , m_nextIdBefore(before.nextId)
    , m_nextIdAfter(nextId) {
    // What snapshots that are gone afterwards show, and nothing else: an image, as a rule none.
    std::set<const void*> used;
    for (const auto& [address, size] :
         payloads({before.meshes, before.materials, before.lights, before.environments, {}, 0}))
        used.insert(address);
    const auto count = [&](const std::vector<Snapshot>& snapshots) {
        std::size_t bytes = 0;
        for (const Snapshot& snapshot : snapshots) {
            const ImagePtr& picture = snapshot.picture;
            if (picture && used.insert(picture.get()).second)
                bytes += imageBytes(picture);
            for (const auto& material : snapshot.look->materials)
                forEachMap(*material, [&](const MapSlot& map) {
                    if (map.image && used.insert(map.image.get()).second)
                        bytes += imageBytes(map.image);
                });
            for (const auto& environment : snapshot.look->environments)
                if (environment->fileImage && used.insert(environment->fileImage.get()).second)
                    bytes += imageBytes(environment->fileImage);
        }
        return bytes;
    };
    count(m_after);
    m_payloadBytes = count(m_before);
}

Change ReplaceSnapshotsStep::swap(Document& document, bool forward) {
    // Pictures may have come after the step.
    (forward ? m_before : m_after) = document.snapshots;
    for (Snapshot& snapshot : forward ? m_after : m_before)
        if (const Snapshot* known = document.snapshot(snapshot.id); known != nullptr)
            snapshot.picture = known->picture;
    document.snapshots = forward ? m_after : m_before;
    document.nextId = forward ? m_nextIdAfter : m_nextIdBefore;
    return {Affects::Structure, std::nullopt};
}

std::size_t RemoveBakeStep::payloadBytes() const {
    return m_removed ? artifactBytes(*m_removed) : 0;
}

Change RemoveBakeStep::swap(Document& document, bool forward) {
    const auto place = std::ranges::find_if(
        document.bakes, [this](const auto& bake) { return bake->kind == m_kind; });
    if (forward && place != document.bakes.end()) {
        m_removed = *place;
        document.bakes.erase(place);
    } else if (!forward && m_removed) {
        if (place == document.bakes.end())
            attachBake(document, m_removed);
        m_removed = nullptr;
    }
    return {Affects::Bakes, std::nullopt};
}

ReplaceDocumentStep::ReplaceDocumentStep(std::string text, const Document& before, Document after)
    : EditStep(std::move(text))
    , m_before(before)
    , m_after(std::move(after)) {
    shareMeshes(m_before, m_after);
}

Change ReplaceDocumentStep::swap(Document& document, bool forward) {
    // What was prepared for the state that goes (a finer environment, light that bounced) goes on
    // with it.
    (forward ? m_before : m_after) = document;
    document = forward ? m_after : m_before;
    return {Affects::Structure | Affects::Geometry | Affects::Picture | Affects::EnvironmentMap |
                Affects::Bakes,
            std::nullopt};
}

Change GroupStep::swap(Document& document, bool forward) {
    Change change{Affects::Nothing, std::nullopt};
    const auto swapOne = [&](EditStep& step) {
        change.affects = change.affects | step.swap(document, forward).affects;
    };
    if (forward)
        for (const auto& step : m_steps)
            swapOne(*step);
    else
        for (auto step = m_steps.rbegin(); step != m_steps.rend(); ++step)
            swapOne(**step);
    return change;
}

std::size_t GroupStep::payloadBytes() const {
    std::size_t bytes = 0;
    for (const auto& step : m_steps)
        bytes += step->payloadBytes();
    return bytes;
}

} // namespace patina
