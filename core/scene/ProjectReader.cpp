// Reads project text that anyone may have written: nothing is believed before it is checked.
#include "core/base/Limits.h"
#include "core/base/Utf8.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectPath.h"

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

// A sorted map, unlike the writer's: objects with many keys must not take quadratic time.
using ReadJson = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t,
                                      std::uint64_t, float>;

// A project of the largest size is refused before it fills the memory with tiny values.
constexpr std::size_t kMaxValues = 8'000'000;
constexpr std::size_t kMaxElements = limits::kMaxMeshes; // of each list

// Leaves the reader from any depth; caught in parseProject, its only way out.
struct Broken {
    std::string message;
};

// A value and where it stands: "materials[3].metallic".
struct Node {
    const ReadJson* json;
    std::string key;
    std::string path{}; // the same as a JSON pointer: "/materials/3/metallic"; of objects and lists
};

std::string describe(const ReadJson& json) {
    constexpr std::size_t kShown = 40;
    if (json.is_structured())
        return json.is_array() ? "a list" : "an object";
    std::string text = json.dump(-1, ' ', false, ReadJson::error_handler_t::replace);
    if (text.size() > kShown)
        text = makeValidUtf8(text.substr(0, kShown)) + "…";
    return text;
}

[[noreturn]] void fail(const Node& node, const std::string& expected) {
    throw Broken{fmt::format("{} should be {}, not {}; the project is damaged", node.key, expected,
                             describe(*node.json))};
}

// A key that this version does not know, in an object that is kept by that name
// (UnknownKeys::of()).
struct UnknownKey {
    std::string parent, path; // where the object stands: "materials[3]", "/materials/3"
    std::string object, key;
};

// An object whose keys are known, or kept: a key that is not known comes from a newer version of
// Patina, and ignoring it would lose it at the next save.
class ObjectReader {
  public:
    explicit ObjectReader(Node node)
        : m_node(std::move(node)) {
        if (!m_node.json->is_object())
            fail(m_node, "an object");
    }
    [[nodiscard]] std::optional<Node> find(const std::string& key) {
        const auto found = m_node.json->find(key);
        if (found == m_node.json->end())
            return std::nullopt;
        m_used.insert(key);
        return Node{&*found, m_node.key.empty() ? key : m_node.key + "." + key,
                    m_node.path + "/" + key};
    }
    [[nodiscard]] Node require(const std::string& key) {
        std::optional<Node> found = find(key);
        if (!found)
            throw Broken{fmt::format("{} is missing; the project is damaged",
                                     m_node.key.empty() ? key : m_node.key + "." + key)};
        return *std::move(found);
    }
    void keepUnknownKeys(const std::string& object, std::vector<UnknownKey>& unknown) const {
        for (const auto& [key, value] : m_node.json->items())
            if (!m_used.contains(key))
                unknown.push_back({m_node.key, m_node.path, object, key});
    }

  private:
    Node m_node;
    std::set<std::string> m_used;
};

std::vector<Node> readList(const Node& node, std::size_t maxSize) {
    if (!node.json->is_array())
        fail(node, "a list");
    if (node.json->size() > maxSize)
        throw Broken{fmt::format("{} has {} elements, more than the {} that Patina reads", node.key,
                                 node.json->size(), maxSize)};
    std::vector<Node> nodes;
    nodes.reserve(node.json->size());
    for (std::size_t i = 0; i < node.json->size(); ++i)
        nodes.push_back({&(*node.json)[i], fmt::format("{}[{}]", node.key, i),
                         fmt::format("{}/{}", node.path, i)});
    return nodes;
}

float readFloat(const Node& node, const std::string& expected = "a number") {
    if (!node.json->is_number())
        fail(node, expected);
    const float value = node.json->get<float>();
    if (!std::isfinite(value))
        fail(node, expected);
    return value;
}

template <std::size_t Count>
std::array<float, Count> readFloats(const Node& node, const std::string& expected) {
    if (!node.json->is_array() || node.json->size() != Count)
        fail(node, expected);
    std::array<float, Count> values{};
    for (std::size_t i = 0; i < Count; ++i)
        values[i] = readFloat({&(*node.json)[i], fmt::format("{}[{}]", node.key, i)});
    return values;
}

std::int64_t readInteger(const Node& node, std::int64_t min, std::int64_t max) {
    const std::string expected = fmt::format("a whole number from {} to {}", min, max);
    if (!node.json->is_number_integer())
        fail(node, expected);
    if (node.json->is_number_unsigned() &&
        node.json->get<std::uint64_t>() > static_cast<std::uint64_t>(max))
        fail(node, expected);
    const std::int64_t value = node.json->get<std::int64_t>();
    if (value < min || value > max)
        fail(node, expected);
    return value;
}

std::string readText(const Node& node, const std::string& expected = "a text") {
    if (!node.json->is_string())
        fail(node, expected);
    return node.json->get<std::string>();
}

std::string readSource(const Node& node, const fs::path& projectFile) {
    std::optional<std::string> source =
        fromProjectPath(readText(node, "the path of a file or builtin:NAME"), projectFile);
    if (!source)
        fail(node, "the path of a file or builtin:NAME");
    return *std::move(source);
}

// Where a project lies, and what of it is not known.
struct Reading {
    const fs::path& projectFile;
    std::vector<UnknownKey> unknown;
};

// `object`: what its unknown keys are kept under.
MapSlot readMap(const Node& node, bool hasAdjustments, const std::string& object,
                Reading& reading) {
    MapSlot slot;
    if (node.json->is_null())
        return slot;
    ObjectReader map(node);
    slot.source = readSource(map.require("source"), reading.projectFile);
    if (hasAdjustments) {
        if (const auto channel = map.find("channel")) {
            const std::string name = readText(*channel, "one of rgb, r, g, b, a");
            const auto found = std::find(kMapChannels.begin(), kMapChannels.end(), name);
            if (found != kMapChannels.end())
                slot.channel =
                    static_cast<MapChannel>(static_cast<std::size_t>(MapChannel::R) +
                                            static_cast<std::size_t>(found - kMapChannels.begin()));
            else if (name != kRgbChannel)
                fail(*channel, "one of rgb, r, g, b, a");
        }
        if (const auto scale = map.find("uvScale")) {
            const auto v = readFloats<2>(*scale, "two numbers");
            slot.uvScale = {v[0], v[1]};
        }
        if (const auto offset = map.find("uvOffset")) {
            const auto v = readFloats<2>(*offset, "two numbers");
            slot.uvOffset = {v[0], v[1]};
        }
        if (const auto rotation = map.find("uvRotationDeg"))
            slot.uvRotationDeg = readFloat(*rotation);
    }
    map.keepUnknownKeys(object, reading.unknown);
    return slot;
}

ParameterValue readParameter(const ParameterInfo& info, const Node& node,
                             const std::string& element, Reading& reading) {
    const std::string expected = describeExpected(info);
    ParameterValue value;
    switch (info.type) {
    case ParameterType::Bool:
        if (!node.json->is_boolean())
            fail(node, expected);
        return node.json->get<bool>();
    case ParameterType::Float:
        value = readFloat(node, expected);
        break;
    case ParameterType::Color:
    case ParameterType::Vector: {
        const auto v = readFloats<3>(node, expected);
        value = glm::vec3(v[0], v[1], v[2]);
        break;
    }
    case ParameterType::Choice: {
        const std::string name = readText(node, expected);
        const auto found = std::find(info.choices.begin(), info.choices.end(), name);
        if (found == info.choices.end())
            fail(node, expected);
        return static_cast<int>(found - info.choices.begin());
    }
    case ParameterType::Text:
        return readText(node, expected);
    case ParameterType::Map:
        return readMap(node, info.scope == Scope::Material, element + "." + keyOf(info), reading);
    case ParameterType::Reference:
        return static_cast<int>(readInteger(node, 0, kMaxId));
    }
    ParameterValue clamped = clampToRange(info, value);
    if (clamped != value && !info.wraps)
        fail(node, expected);
    return clamped;
}

// A parameter that is absent (it is younger than the file) keeps its default.
// `element`: what its unknown keys are kept under.
void readParameters(ObjectReader& object, Document& document, Scope scope, Id id,
                    const std::string& element, Reading& reading) {
    for (const ParameterInfo& info : parameters())
        if (info.scope == scope && (!info.ofScene || id == 0))
            if (const auto node = object.find(keyOf(info)))
                info.set(document, id, readParameter(info, *node, element, reading));
}
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
            readCamera(*camera, document().view.camera);
        object.keepUnknownKeys("view", m_reading.unknown);
    }

    void readCamera(const Node& node, Camera& camera) {
        ObjectReader object(node);
        const Node target = object.require("target");
        const auto v = readFloats<3>(target, "three numbers");
        camera.target = {v[0], v[1], v[2]};
        camera.yawDeg = readFloat(object.require("yawDeg"));
        camera.pitchDeg = readFloat(object.require("pitchDeg"));
        camera.distance = readFloat(object.require("distance"));
        object.keepUnknownKeys("view.camera", m_reading.unknown);
        if (!(sanitizeCamera(camera) == camera))
            fail(node, "a camera with sensible numbers (pitchDeg from -89 to 89, distance from "
                       "1e-6 to 1e9)");
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
        readElement(object, scratch, Scope::Mesh, id, m_reading);
        MeshInstance mesh = std::move(scratch.meshes.front());
        if (mesh.material != 0 && !m_materials.contains(mesh.material))
            fail(object.require("material"), "the id of a material in this project");
        mesh.source = readSource(object.require("source"), m_reading.projectFile);
        mesh.sourceIndex = static_cast<int>(readInteger(object.require("sourceIndex"), 0,
                                                        std::numeric_limits<std::int32_t>::max()));
        const auto transform = readFloats<16>(object.require("transform"), "16 numbers");
        for (int i = 0; i < 16; ++i)
            mesh.transform[i / 4][i % 4] = transform[static_cast<std::size_t>(i)];
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
