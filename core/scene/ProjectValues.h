// Reading a project's text value by value: nothing is believed before it is checked. Only the
// readers of projects need this.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/scene/ProjectJson.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace patina::project {

// A sorted map, unlike the writer's: objects with many keys must not take quadratic time.
using ReadJson = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t,
                                      std::uint64_t, float>;

// Leaves the reader from any depth; caught where the project, or a part of it that may be left out,
// is read.
struct Broken {
    std::string message;
};

// A value and where it stands: "materials[3].metallic".
struct Node {
    const ReadJson* json;
    std::string key;
    std::string path{}; // the same as a JSON pointer: "/materials/3/metallic"; of objects and lists
};

[[noreturn]] void fail(const Node& node, const std::string& expected);

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
    explicit ObjectReader(Node node);
    [[nodiscard]] std::optional<Node> find(const std::string& key);
    [[nodiscard]] Node require(const std::string& key);
    void keepUnknownKeys(const std::string& object, std::vector<UnknownKey>& unknown) const;

  private:
    Node m_node;
    std::set<std::string> m_used;
};

[[nodiscard]] std::vector<Node> readList(const Node& node, std::size_t maxSize);
[[nodiscard]] float readFloat(const Node& node, const std::string& expected = "a number");
template <std::size_t Count>
std::array<float, Count> readFloats(const Node& node, const std::string& expected) {
    if (!node.json->is_array() || node.json->size() != Count)
        fail(node, expected);
    std::array<float, Count> values{};
    for (std::size_t i = 0; i < Count; ++i)
        values[i] = readFloat({&(*node.json)[i], fmt::format("{}[{}]", node.key, i)});
    return values;
}
[[nodiscard]] std::int64_t readInteger(const Node& node, std::int64_t min, std::int64_t max);
[[nodiscard]] std::string readText(const Node& node, const std::string& expected = "a text");
[[nodiscard]] std::string readSource(const Node& node, const std::filesystem::path& projectFile);

// Where a project lies, and what of it is not known.
struct Reading {
    const std::filesystem::path& projectFile;
    std::vector<UnknownKey> unknown;
};

// `element`: what its unknown keys are kept under.
[[nodiscard]] ParameterValue readParameter(const ParameterInfo& info, const Node& node,
                                           const std::string& element, Reading& reading);
// A parameter that is absent (it is younger than the file) keeps its value.
// `element`: what its unknown keys are kept under.
void readParameters(ObjectReader& object, Document& document, Scope scope, Id id,
                    const std::string& element, Reading& reading);
// `object`: what its unknown keys are kept under.
// All of the camera but its field of view, which is a parameter.
void readCamera(const Node& node, Camera& camera, const std::string& object, Reading& reading);

} // namespace patina::project
