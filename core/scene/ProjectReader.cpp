// Reads project text that anyone may have written: nothing is believed before it is checked.
#include "core/base/Limits.h"
#include "core/base/Utf8.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectSnapshots.h"
#include "core/scene/ProjectValues.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_set>

namespace patina::project {
namespace {

namespace fs = std::filesystem;

// A project of the largest size is refused before it fills the memory with tiny values.
constexpr std::size_t kMaxValues = 8'000'000;
constexpr std::size_t kMaxElements = limits::kMaxMeshes; // of each list

// Of an element with an id: those that are read here are all of it.
void readElement(ObjectReader& object, Document& document, Scope scope, Id id, Reading& reading) {
    readParameters(object, document, scope, id, std::to_string(id), reading);
}

class ProjectReader {
  public:
    explicit ProjectReader(const fs::path& projectFile)
        : m_reading{projectFile, {}} {}

    ParsedProject read(const ReadJson& json) {
        checkVersion(json);
        ObjectReader root(Node{&json, ""});
        static_cast<void>(root.find("format"));
        static_cast<void>(root.find("version"));
        readView(root.require("view"));
        readEnvironments(root);
        if (const auto model =
                root.find("model")) // absent in projects of before it could be chosen
            readModel(*model);
        for (const Node& node : readList(root.require("materials"), kMaxElements))
            document().materials.push_back(readMaterial(node));
        for (const Node& node : readList(root.require("lights"), kMaxElements))
            document().lights.push_back(readLight(node));
        for (const Node& node : readList(root.require("meshes"), kMaxElements))
            document().meshes.push_back(readMesh(node));
        if (const auto bakes = root.find("bakes"))
            for (const Node& node : readList(*bakes, kBakeKinds.size()))
                m_project.bakes.push_back(readBake(node));
        const Node nextId = root.require("nextId");
        document().nextId = static_cast<Id>(readInteger(nextId, 1, kMaxId));
        giveIds();
        if (!m_ids.empty() && *m_ids.rbegin() >= document().nextId)
            fail(nextId,
                 fmt::format("larger than every id, the largest being {}", *m_ids.rbegin()));
        if (const auto snapshots = root.find("snapshots"))
            readSnapshots(*snapshots, document(), m_reading, m_project.leftOut);
        root.keepUnknownKeys("", m_reading.unknown);
        return std::move(m_project);
    }

    [[nodiscard]] const std::vector<UnknownKey>& unknown() const { return m_reading.unknown; }

  private:
    Document& document() { return m_project.document; }

    static void checkVersion(const ReadJson& json) {
        const bool isProject = json.is_object() && json.contains("format") &&
                               json["format"].is_string() && json["format"] == "patina";
        if (!isProject)
            throw Broken{"this is no Patina project: the key format is not \"patina\""};
        ObjectReader root(Node{&json, ""});
        const auto version =
            readInteger(root.require("version"), 1, std::numeric_limits<std::int32_t>::max());
        if (version > kProjectVersion)
            throw Broken{fmt::format("the project was saved by a newer Patina (project version {}, "
                                     "this one reads up to {}); update Patina to open it",
                                     version, kProjectVersion)};
    }

    Id readId(ObjectReader& object) {
        const Node node = object.require("id");
        const Id id = static_cast<Id>(readInteger(node, 1, kMaxId));
        if (!m_ids.insert(id).second)
            fail(node, "an id that nothing else has");
        return id;
    }

    void readView(const Node& node) {
        ObjectReader object(node);
        readParameters(object, document(), Scope::View, 0, "view", m_reading);
        if (const auto camera = object.find("camera"))
            readCamera(*camera, document().view.camera, "view.camera", m_reading);
        object.keepUnknownKeys("view", m_reading.unknown);
    }

    // The environment that lights the scene stands alone, the others in a list.
    void readEnvironments(ObjectReader& root) {
        const Node node = root.require("environment");
        ObjectReader object(node);
        Environment& first = document().environments.front();
        // Absent, as are the others, in projects of before there were several.
        const bool hasId = object.find("id").has_value();
        first.id = document().mix.first = hasId ? readId(object) : 0;
        readParameters(object, document(), Scope::Environment, 0, "environment", m_reading);
        if (document().mix.first != first.id)
            fail(object.require("first"), "the id of the environment beside it");
        readSoftboxes(object, first);
        std::size_t position = 0;
        if (const auto place = object.find("position"))
            position = static_cast<std::size_t>(readInteger(*place, 0, kMaxEnvironments - 1));
        if (const auto others = root.find("environments"))
            for (const Node& other : readList(*others, kMaxEnvironments - 1))
                document().environments.push_back(readEnvironment(other));
        if (!hasId)
            readSecondOfBefore(object);
        object.keepUnknownKeys("environment", m_reading.unknown);
        auto& all = document().environments;
        std::rotate(all.begin(), all.begin() + 1,
                    all.begin() + static_cast<std::ptrdiff_t>(std::min(position, all.size() - 1)) +
                        1);
        const Id second = document().mix.second;
        if (second != 0 && (second == document().mix.first || !document().environment(second)))
            fail(object.require("second"), "the id of another environment in this project");
    }

    Environment readEnvironment(const Node& node) {
        ObjectReader object(node);
        Document scratch;
        Environment& environment = scratch.environments.front();
        const Id id = environment.id = scratch.mix.first = readId(object);
        readElement(object, scratch, Scope::Environment, id, m_reading);
        readSoftboxes(object, environment);
        object.keepUnknownKeys(std::to_string(id), m_reading.unknown);
        return std::move(environment);
    }

    void readSoftboxes(ObjectReader& object, Environment& environment) {
        if (const auto softboxes = object.find("softboxes"))
            for (const Node& softbox : readList(*softboxes, kMaxSoftboxes))
                environment.softboxes.push_back(readSoftbox(softbox));
    }

    // Projects of before there were several environments hold a second one as keys of the first:
    // "secondImage", "secondTint" and so on. Without an image there was none.
    void readSecondOfBefore(ObjectReader& object) {
        Document scratch;
        for (const ParameterInfo& info : parameters()) {
            if (info.scope != Scope::Environment || info.ofScene)
                continue;
            std::string key = keyOf(info);
            key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
            if (const auto node = object.find("second" + key))
                info.set(scratch, 0, readParameter(info, *node, "environment", m_reading));
        }
        Environment& second = scratch.environment();
        if (second.source.empty() || !object.find("secondImage"))
            return;
        second.id = 0;
        document().environments.push_back(std::move(second));
    }

    // Environments of projects of before they had any.
    void giveIds() {
        for (Environment& environment : document().environments) {
            if (environment.id != 0)
                continue;
            const bool isFirst = document().mix.first == 0;
            environment.id = document().takeId();
            (isFirst ? document().mix.first : document().mix.second) = environment.id;
        }
    }

    Softbox readSoftbox(const Node& node) {
        ObjectReader object(node);
        Document scratch;
        const Id id = scratch.environment().softboxes.emplace_back().id = readId(object);
        readElement(object, scratch, Scope::Softbox, id, m_reading);
        object.keepUnknownKeys(std::to_string(id), m_reading.unknown);
        return std::move(scratch.environment().softboxes.front());
    }

    void readModel(const Node& node) {
        ObjectReader object(node);
        readParameters(object, document(), Scope::Model, 0, "model", m_reading);
        object.keepUnknownKeys("model", m_reading.unknown);
    }

    // Elements are read alone in a document, where they are found at once however many there are.
    Material readMaterial(const Node& node) {
        ObjectReader object(node);
        Document scratch;
        const Id id = scratch.materials.emplace_back().id = readId(object);
        readElement(object, scratch, Scope::Material, id, m_reading);
        object.keepUnknownKeys(std::to_string(id), m_reading.unknown);
        m_materials.insert(id);
        return std::move(scratch.materials.front());
    }

    Light readLight(const Node& node) {
        ObjectReader object(node);
        Document scratch;
        const Id id = scratch.lights.emplace_back().id = readId(object);
        readElement(object, scratch, Scope::Light, id, m_reading);
        object.keepUnknownKeys(std::to_string(id), m_reading.unknown);
        return std::move(scratch.lights.front());
    }

    MeshInstance readMesh(const Node& node) {
        ObjectReader object(node);
        Document scratch;
        const Id id = scratch.meshes.emplace_back().id = readId(object);
        // As its file says, where the parameters say nothing else.
        const auto numbers = readFloats<16>(object.require("transform"), "16 numbers");
        glm::mat4 transform;
        for (int i = 0; i < 16; ++i)
            transform[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
        scratch.meshes.front().placement = transform;
        readElement(object, scratch, Scope::Mesh, id, m_reading);
        MeshInstance mesh = std::move(scratch.meshes.front());
        if (mesh.material != 0 && !m_materials.contains(mesh.material))
            fail(object.require("material"), "the id of a material in this project");
        mesh.source = readSource(object.require("source"), m_reading.projectFile);
        mesh.sourceIndex = static_cast<int>(readInteger(object.require("sourceIndex"), 0,
                                                        std::numeric_limits<std::int32_t>::max()));
        object.keepUnknownKeys(std::to_string(id), m_reading.unknown);
        return mesh;
    }

    BakeReference readBake(const Node& node) {
        ObjectReader object(node);
        const Node kindNode = object.require("kind");
        const std::string name = readText(kindNode);
        const auto kind = std::find_if(kBakeKinds.begin(), kBakeKinds.end(),
                                       [&](const auto& entry) { return entry.second == name; });
        const bool repeated =
            kind != kBakeKinds.end() &&
            std::any_of(m_project.bakes.begin(), m_project.bakes.end(),
                        [&](const BakeReference& bake) { return bake.kind == kind->first; });
        if (kind == kBakeKinds.end() || repeated)
            fail(kindNode, "one of aoTexel, aoVertex, prtVertex, prtTexel, each at most once");
        BakeReference bake{kind->first, readSource(object.require("file"), m_reading.projectFile)};
        object.keepUnknownKeys("bake." + name, m_reading.unknown);
        return bake;
    }

    Reading m_reading;
    ParsedProject m_project;
    std::set<Id> m_ids;
    std::unordered_set<Id> m_materials;
};

// Their values with all their digits: the reader's own numbers have single precision. Like its
// objects, these must not take quadratic time (as nlohmann::ordered_json's do).
UnknownKeys textsOf(const std::vector<UnknownKey>& unknown, const std::string& text) {
    if (unknown.empty())
        return {};
    const auto root = nlohmann::json::parse(text);
    UnknownKeys::ByObject byObject;
    for (const UnknownKey& one : unknown) {
        const auto& object = root.at(nlohmann::json::json_pointer(one.path));
        byObject[one.object].emplace_back(
            one.key,
            object.at(one.key).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    }
    return UnknownKeys(std::move(byObject));
}

// Counts brackets and commas outside of strings, before the text is given to the parser.
std::optional<std::string> checkShape(const std::string& text) {
    std::size_t depth = 0, values = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
            continue;
        }
        if (c == '"')
            inString = true;
        else if (c == '{' || c == '[')
            ++depth;
        else if ((c == '}' || c == ']') && depth > 0)
            --depth;
        else if (c == ',')
            ++values;
        if (depth > static_cast<std::size_t>(limits::kMaxJsonDepth))
            return fmt::format("it is nested more than {} levels deep", limits::kMaxJsonDepth);
        if (values > kMaxValues)
            return fmt::format("it has more than {} values", kMaxValues);
    }
    return std::nullopt;
}

} // namespace

Result<ParsedProject> parseProject(const std::string& json, const fs::path& projectFile) {
    const auto broken = [&](std::string message, std::string detail) {
        return Error{ErrorKind::InputBroken, std::move(message), projectFile, std::move(detail)};
    };
    if (json.size() > limits::kMaxProjectFileBytes)
        return broken(fmt::format("the project is larger than {} MiB, the most Patina reads",
                                  limits::kMaxProjectFileBytes >> 20),
                      {});
    if (const auto problem = checkShape(json))
        return broken("this is no Patina project: " + *problem, {});
    try {
        ProjectReader reader(projectFile);
        ParsedProject project = reader.read(ReadJson::parse(json));
        project.document.unknownKeys = textsOf(reader.unknown(), json);
        for (const UnknownKey& one : reader.unknown())
            project.unknown.push_back(one.parent + (one.parent.empty() ? "" : ".") +
                                      one.key.substr(0, 80));
        return project;
    } catch (const Broken& problem) {
        return broken(problem.message, {});
    } catch (const ReadJson::exception& problem) {
        return broken("this is no Patina project, or it is damaged: the file is not valid JSON",
                      makeValidUtf8(std::string_view(problem.what()).substr(0, 300)));
    } catch (const std::bad_alloc&) {
        return broken("the project does not fit into memory", {});
    }
}

} // namespace patina::project

namespace patina {

Result<Document> documentFromJson(const std::string& json,
                                  const std::filesystem::path& projectFile) {
    Result<project::ParsedProject> parsed = project::parseProject(json, projectFile);
    if (!parsed)
        return parsed.error();
    return std::move(parsed->document);
}

} // namespace patina
