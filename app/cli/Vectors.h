// Vectors in reports.
#pragma once

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace patina::cli {

[[nodiscard]] inline nlohmann::ordered_json vectorJson(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

[[nodiscard]] inline std::string vectorText(const glm::vec3& v) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z);
}

} // namespace patina::cli
