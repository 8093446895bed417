#include "core/scene/ProjectWriting.h"

#include "core/scene/ProjectPath.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace patina::project {
namespace {

Json mapToJson(const MapSlot& slot, bool hasAdjustments, const std::filesystem::path& projectFile) {
    MapSlot saved = slot;
    saved.image = nullptr;
    saved.problem.clear();
    if (saved == MapSlot{})
        return nullptr;
    Json json;
    json["source"] = toProjectPath(saved.source, projectFile);
    if (!hasAdjustments)
        return json;
    json["channel"] = std::string(saved.channel == MapChannel::Rgb
                                      ? kRgbChannel
                                      : kMapChannels[static_cast<std::size_t>(saved.channel) -
                                                     static_cast<std::size_t>(MapChannel::R)]);
    const auto number = [](float value, float fallback) {
        return std::isfinite(value) ? value : fallback;
    };
    json["uvScale"] = Json::array({number(saved.uvScale.x, 1.0f), number(saved.uvScale.y, 1.0f)});
    json["uvOffset"] =
        Json::array({number(saved.uvOffset.x, 0.0f), number(saved.uvOffset.y, 0.0f)});
    json["uvRotationDeg"] = number(saved.uvRotationDeg, 0.0f);
    return json;
}

} // namespace

Json vectorToJson(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json cameraToJson(const Camera& camera) {
    const Camera saved = sanitizeCamera(camera);
    return {{"target", vectorToJson(saved.target)},
            {"yawDeg", saved.yawDeg},
            {"pitchDeg", saved.pitchDeg},
            {"distance", saved.distance}};
}

Json parameterToJson(const ParameterInfo& info, const ParameterValue& value,
                     const std::filesystem::path& projectFile) {
    switch (info.type) {
    case ParameterType::Bool:
        return std::get<bool>(value);
    case ParameterType::Float:
        return std::get<float>(value);
    case ParameterType::Color:
    case ParameterType::Vector:
        return vectorToJson(std::get<glm::vec3>(value));
    case ParameterType::Choice:
        return formatParameterValue(info, value);
    case ParameterType::Text:
        return std::get<std::string>(value);
    case ParameterType::Map:
        return mapToJson(std::get<MapSlot>(value), info.scope == Scope::Material, projectFile);
    case ParameterType::Reference:
        return std::get<int>(value);
    }
    return nullptr;
}

void addKept(Json& json, const Document& document, const std::string& object) {
    const UnknownKeys::Entries* entries = document.unknownKeys.of(object);
    if (entries == nullptr)
        return;
    Json kept = Json::array();
    for (const auto& [key, value] : *entries)
        kept.push_back(Json(key).dump() + ": " + value);
    json[kKept] = std::move(kept);
}

void addParameters(Json& json, const Document& holder, Scope scope, Id id,
                   const std::string& element, const Writing& writing) {
    for (const ParameterInfo& info : parameters())
        if (info.scope == scope && (!info.ofScene || id == 0)) {
            const std::string key = keyOf(info);
            Json& value = json[key] = parameterToJson(
                info, clampToRange(info, info.get(holder, id)), writing.projectFile);
            if (value.is_object())
                addKept(value, writing.document, element + "." + key);
        }
}

} // namespace patina::project
