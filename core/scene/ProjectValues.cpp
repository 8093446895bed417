#include "core/scene/ProjectValues.h"

#include "core/base/Utf8.h"
#include "core/scene/ProjectPath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::project {
namespace {

namespace fs = std::filesystem;

std::string describe(const ReadJson& json) {
    constexpr std::size_t kShown = 40;
    if (json.is_structured())
        return json.is_array() ? "a list" : "an object";
    std::string text = json.dump(-1, ' ', false, ReadJson::error_handler_t::replace);
    if (text.size() > kShown)
        text = makeValidUtf8(text.substr(0, kShown)) + "…";
    return text;
}

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

} // namespace

void fail(const Node& node, const std::string& expected) {
    throw Broken{fmt::format("{} should be {}, not {}; the project is damaged", node.key, expected,
                             describe(*node.json))};
}

ObjectReader::ObjectReader(Node node)
    : m_node(std::move(node)) {
    if (!m_node.json->is_object())
        fail(m_node, "an object");
}

std::optional<Node> ObjectReader::find(const std::string& key) {
    const auto found = m_node.json->find(key);
    if (found == m_node.json->end())
        return std::nullopt;
    m_used.insert(key);
    return Node{&*found, m_node.key.empty() ? key : m_node.key + "." + key,
                m_node.path + "/" + key};
}

Node ObjectReader::require(const std::string& key) {
    std::optional<Node> found = find(key);
    if (!found)
        throw Broken{fmt::format("{} is missing; the project is damaged",
                                 m_node.key.empty() ? key : m_node.key + "." + key)};
    return *std::move(found);
}

void ObjectReader::keepUnknownKeys(const std::string& object,
                                   std::vector<UnknownKey>& unknown) const {
    for (const auto& [key, value] : m_node.json->items())
        if (!m_used.contains(key))
            unknown.push_back({m_node.key, m_node.path, object, key});
}

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

float readFloat(const Node& node, const std::string& expected) {
    if (!node.json->is_number())
        fail(node, expected);
    const float value = node.json->get<float>();
    if (!std::isfinite(value))
        fail(node, expected);
    return value;
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

std::string readText(const Node& node, const std::string& expected) {
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

void readParameters(ObjectReader& object, Document& document, Scope scope, Id id,
                    const std::string& element, Reading& reading) {
    for (const ParameterInfo& info : parameters())
        if (info.scope == scope && (!info.ofScene || id == 0))
            if (const auto node = object.find(keyOf(info)))
                info.set(document, id, readParameter(info, *node, element, reading));
}
void readCamera(const Node& node, Camera& camera, const std::string& object, Reading& reading) {
    ObjectReader reader(node);
    const Node target = reader.require("target");
    const auto v = readFloats<3>(target, "three numbers");
    camera.target = {v[0], v[1], v[2]};
    camera.yawDeg = readFloat(reader.require("yawDeg"));
    camera.pitchDeg = readFloat(reader.require("pitchDeg"));
    camera.distance = readFloat(reader.require("distance"));
    reader.keepUnknownKeys(object, reading.unknown);
    if (!(sanitizeCamera(camera) == camera))
        fail(node, "a camera with sensible numbers (pitchDeg from -89 to 89, distance from "
                   "1e-6 to 1e9)");
}

} // namespace patina::project
