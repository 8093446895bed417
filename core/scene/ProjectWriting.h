// Writing a project's text value by value. Only the writers of projects need this.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/scene/ProjectJson.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace patina::project {

// Keys in the order they are written; single precision, so that 0.8f is written as 0.8.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                  std::int64_t, std::uint64_t, float>;

struct Writing {
    const Document& document;
    const std::filesystem::path& projectFile;
};

[[nodiscard]] Json vectorToJson(const glm::vec3& v);
[[nodiscard]] Json cameraToJson(const Camera& camera);
[[nodiscard]] Json parameterToJson(const ParameterInfo& info, const ParameterValue& value,
                                   const std::filesystem::path& projectFile);

// Stands in an object for the text of keys that are only kept (UnknownKeys). No key of ours.
inline constexpr const char* kKept = "\n";
void addKept(Json& json, const Document& document, const std::string& object);

// Every parameter of the element, clamped: what is saved can be opened again. `holder`: the
// document that holds it; `element`: what its unknown keys are kept under.
void addParameters(Json& json, const Document& holder, Scope scope, Id id,
                   const std::string& element, const Writing& writing);

} // namespace patina::project
