#include "core/document/AbsentBake.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectBakes.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectPath.h"
#include "core/scene/ProjectSnapshots.h"
#include "core/scene/ProjectWriting.h"

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
using namespace project;

// An element with an id: `holder` has it alone, where it is found at once however many there are.
Json elementToJson(const Document& holder, Scope scope, Id id, const Writing& writing) {
    Json json{{"id", id}};
    addParameters(json, holder, scope, id, std::to_string(id), writing);
    return json;
}

Json materialToJson(const Material& material, const Writing& writing) {
    Document scratch;
    scratch.materials.push_back(material);
    return elementToJson(scratch, Scope::Material, material.id, writing);
}

Json lightToJson(const Light& light, const Writing& writing) {
    Document scratch;
    scratch.lights.push_back(light);
    return elementToJson(scratch, Scope::Light, light.id, writing);
}

Json softboxToJson(const Softbox& softbox, const Writing& writing) {
    Document scratch;
    scratch.environment().softboxes.push_back(softbox);
    return elementToJson(scratch, Scope::Softbox, softbox.id, writing);
}

Json environmentToJson(const Environment& environment, const Writing& writing) {
    Document scratch;
    scratch.environments.front() = environment;
    scratch.mix.first = environment.id;
    Json json = elementToJson(scratch, Scope::Environment, environment.id, writing);
    Json& softboxes = json["softboxes"] = Json::array();
    for (const Softbox& softbox : environment.softboxes) {
        Json one = softboxToJson(softbox, writing);
        addKept(one, writing.document, std::to_string(softbox.id));
        softboxes.push_back(std::move(one));
    }
    return json;
}

Json meshToJson(const MeshInstance& mesh, const Writing& writing) {
    Document scratch;
    scratch.meshes.push_back(mesh);
    Json json = elementToJson(scratch, Scope::Mesh, mesh.id, writing);
    json["source"] = toProjectPath(mesh.source, writing.projectFile);
    json["sourceIndex"] = std::max(mesh.sourceIndex, 0);
    if (mesh.placement.isAsRead()) // its file's transform says it all
        for (const char* key : {"position", "rotationDeg", "scale"})
            json.erase(key);
    Json transform = Json::array(); // of its file, column by column
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            const float value = mesh.placement.asRead()[column][row];
            transform.push_back(std::isfinite(value) ? value : (column == row ? 1.0f : 0.0f));
        }
    json["transform"] = std::move(transform);
    return json;
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
        if (isObject && element.key() == kKept) {
            for (const Json& text : *element) {
                out += separator;
                newLine(indent + 1);
                out += text.get<std::string>();
                separator = ",";
            }
            continue;
        }
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
                                    ? bake->missingFile
                                    : project::bakeFile(projectFile, bake->kind).string();
    return project::projectText(document, projectFile, names);
}

std::string project::projectText(const Document& document, const fs::path& projectFile,
                                 const BakeNames& bakes) {
    Json json{{"format", "patina"}, {"version", kProjectVersion}, {"nextId", document.nextId}};
    const Writing writing{document, projectFile};
    const auto addWhole = [&](const char* name, Scope scope) -> Json& {
        Json& object = json[name] = Json::object();
        addParameters(object, document, scope, 0, name, writing);
        return object;
    };
    const auto addList = [&](Json& object, const char* name, const auto& elements,
                             const auto& toJson) {
        Json& list = object[name] = Json::array();
        for (const auto& element : elements) {
            Json one = toJson(element, writing);
            addKept(one, document, std::to_string(element.id));
            list.push_back(std::move(one));
        }
    };

    Json& view = addWhole("view", Scope::View);
    view["camera"] = cameraToJson(document.view.camera);
    addKept(view["camera"], document, "view.camera");
    addKept(view, document, "view");
    // The environment that lights the scene stands alone, as before there were others.
    Json& environment = addWhole("environment", Scope::Environment);
    environment["id"] = document.environment().id;
    addList(environment, "softboxes", document.environment().softboxes, softboxToJson);
    const auto& all = document.environments;
    const auto isFirst = [&](const Environment& one) { return one.id == document.mix.first; };
    if (all.size() > 1)
        environment["position"] = std::ranges::find_if(all, isFirst) - all.begin();
    addKept(environment, document, "environment");
    if (all.size() > 1) {
        Json& others = json["environments"] = Json::array();
        for (const Environment& other : all) {
            if (isFirst(other))
                continue;
            Json one = environmentToJson(other, writing);
            addKept(one, document, std::to_string(other.id));
            others.push_back(std::move(one));
        }
    }
    addKept(addWhole("model", Scope::Model), document, "model");

    addList(json, "materials", document.materials, materialToJson);
    addList(json, "lights", document.lights, lightToJson);
    addList(json, "meshes", document.meshes, meshToJson);

    json["bakes"] = Json::array();
    for (const BakeArtifactPtr& bake : document.bakes)
        for (const auto& [kind, name] : project::kBakeKinds)
            if (bake && bake->kind == kind) {
                Json one{{"kind", std::string(name)},
                         {"file", toProjectPath(bakes.at(kind), projectFile)}};
                addKept(one, document, "bake." + std::string(name));
                json["bakes"].push_back(std::move(one));
            }
    if (!document.snapshots.empty())
        json["snapshots"] = snapshotsToJson(writing);
    addKept(json, document, "");

    std::string text;
    print(json, 0, text);
    return text + "\n";
}

} // namespace patina
