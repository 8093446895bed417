#include "core/document/AbsentBake.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectBakes.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectPath.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace patina {
namespace project {

std::filesystem::path bakeFile(const std::filesystem::path& projectFile, BakeKind kind) {
    const std::filesystem::path folder = bakeFolder(projectFile);
    for (const auto& [known, name] : kBakeKinds)
        if (known == kind)
            return folder / (std::string(name) + ".exr");
    return {};
}

Camera sanitizeCamera(Camera camera) {
    const Camera fallback;
    const auto limit = [](float& value, float min, float max, float otherwise) {
        value = std::isfinite(value) ? std::clamp(value, min, max) : otherwise;
    };
    for (int i = 0; i < 3; ++i)
        limit(camera.target[i], -1e9f, 1e9f, 0.0f);
    limit(camera.yawDeg, -1e6f, 1e6f, fallback.yawDeg);
    limit(camera.pitchDeg, -89.0f, 89.0f, fallback.pitchDeg);
    limit(camera.distance, 1e-6f, 1e9f, fallback.distance);
    return camera;
}

} // namespace project

namespace {

namespace fs = std::filesystem;

// Keys in the order they are written; single precision, so that 0.8f is written as 0.8.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                  std::int64_t, std::uint64_t, float>;

Json vectorToJson(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json mapToJson(const MapSlot& slot, bool hasAdjustments, const fs::path& projectFile) {
    MapSlot saved = slot;
    saved.image = nullptr;
    saved.problem.clear();
    if (saved == MapSlot{})
        return nullptr;
    Json json;
    json["source"] = toProjectPath(saved.source, projectFile);
    if (!hasAdjustments)
        return json;
    json["channel"] =
        std::string(saved.channel == MapChannel::Rgb
                        ? project::kRgbChannel
                        : project::kMapChannels[static_cast<std::size_t>(saved.channel) -
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

Json parameterToJson(const ParameterInfo& info, const ParameterValue& value,
                     const fs::path& projectFile) {
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

// Every parameter of the element, clamped: what is saved can be opened again.
void addParameters(Json& json, const Document& document, Scope scope, Id id,
                   const fs::path& projectFile) {
    for (const ParameterInfo& info : parameters())
        if (info.scope == scope)
            json[project::keyOf(info)] =
                parameterToJson(info, clampToRange(info, info.get(document, id)), projectFile);
}

// The element alone in a document, where it is found at once however many there are.
Json materialToJson(const Material& material, const fs::path& projectFile) {
    Document scratch;
    scratch.materials.push_back(material);
    Json json{{"id", material.id}};
    addParameters(json, scratch, Scope::Material, material.id, projectFile);
    return json;
}

Json lightToJson(const Light& light, const fs::path& projectFile) {
    Document scratch;
    scratch.lights.push_back(light);
    Json json{{"id", light.id}};
    addParameters(json, scratch, Scope::Light, light.id, projectFile);
    return json;
}

Json softboxToJson(const Softbox& softbox, const fs::path& projectFile) {
    Document scratch;
    scratch.environment.softboxes.push_back(softbox);
    Json json{{"id", softbox.id}};
    addParameters(json, scratch, Scope::Softbox, softbox.id, projectFile);
    return json;
}

Json meshToJson(const MeshInstance& mesh, const fs::path& projectFile) {
    Document scratch;
    scratch.meshes.push_back(mesh);
    Json json{{"id", mesh.id}};
    addParameters(json, scratch, Scope::Mesh, mesh.id, projectFile);
    json["source"] = toProjectPath(mesh.source, projectFile);
    json["sourceIndex"] = std::max(mesh.sourceIndex, 0);
    Json transform = Json::array(); // column by column
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            const float value = mesh.transform[column][row];
            transform.push_back(std::isfinite(value) ? value : (column == row ? 1.0f : 0.0f));
        }
    json["transform"] = std::move(transform);
    return json;
}

Json cameraToJson(const Camera& camera) {
    const Camera saved = project::sanitizeCamera(camera);
    return {{"target", vectorToJson(saved.target)},
            {"yawDeg", saved.yawDeg},
            {"pitchDeg", saved.pitchDeg},
            {"distance", saved.distance}};
}

// Lists of plain values stay on one line, everything else is indented.
void print(const Json& json, int indent, std::string& out) {
    const auto newLine = [&](int level) {
        out += '\n';
        out.append(2u * static_cast<unsigned>(level), ' ');
    };
    const bool nested =
        json.is_object() ||
        (json.is_array() && std::any_of(json.begin(), json.end(), [](const Json& element) {
             return element.is_structured();
         }));
    if (!nested && !json.is_array()) {
        out += json.dump(-1, ' ', false, Json::error_handler_t::replace);
        return;
    }
    const bool isObject = json.is_object();
    out += isObject ? '{' : '[';
    const char* separator = "";
    for (auto element = json.begin(); element != json.end(); ++element) {
        out += separator;
        if (nested)
            newLine(indent + 1);
        if (isObject)
            out += Json(element.key()).dump() + ": ";
        print(*element, indent + 1, out);
        separator = nested ? "," : ", ";
    }
    if (nested && !json.empty())
        newLine(indent);
    out += isObject ? '}' : ']';
}

} // namespace

std::string documentToJson(const Document& document, const fs::path& projectFile) {
    project::BakeNames names;
    for (const BakeArtifactPtr& bake : document.bakes)
        if (bake)
            names[bake->kind] = isAbsent(*bake)
                                    ? absentFile(*bake)
                                    : project::bakeFile(projectFile, bake->kind).string();
    return project::projectText(document, projectFile, names);
}

std::string project::projectText(const Document& document, const fs::path& projectFile,
                                 const BakeNames& bakes) {
    Json json{{"format", "patina"}, {"version", kProjectVersion}, {"nextId", document.nextId}};

    json["view"] = Json::object();
    addParameters(json["view"], document, Scope::View, 0, projectFile);
    json["view"]["camera"] = cameraToJson(document.view.camera);
    json["environment"] = Json::object();
    addParameters(json["environment"], document, Scope::Environment, 0, projectFile);
    json["environment"]["softboxes"] = Json::array();
    for (const Softbox& softbox : document.environment.softboxes)
        json["environment"]["softboxes"].push_back(softboxToJson(softbox, projectFile));
    json["model"] = Json::object();
    addParameters(json["model"], document, Scope::Model, 0, projectFile);

    json["materials"] = Json::array();
    for (const Material& material : document.materials)
        json["materials"].push_back(materialToJson(material, projectFile));
    json["lights"] = Json::array();
    for (const Light& light : document.lights)
        json["lights"].push_back(lightToJson(light, projectFile));
    json["meshes"] = Json::array();
    for (const MeshInstance& mesh : document.meshes)
        json["meshes"].push_back(meshToJson(mesh, projectFile));

    json["bakes"] = Json::array();
    for (const BakeArtifactPtr& bake : document.bakes)
        for (const auto& [kind, name] : project::kBakeKinds)
            if (bake && bake->kind == kind)
                json["bakes"].push_back({{"kind", std::string(name)},
                                         {"file", toProjectPath(bakes.at(kind), projectFile)}});

    std::string text;
    print(json, 0, text);
    return text + "\n";
}

} // namespace patina
