// What `patina info --light` says about the light of an environment: the Light lab's numbers.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace patina::cli {

// AZIMUTH,ELEVATION in degrees as a unit vector of the world; nothing for an empty text. Usage
// error when it is something else.
Result<std::optional<glm::vec3>> parseDirection(const std::string& text);

// Adds "light" to the report: the environment that lights the document, rotated and scaled as
// there; with `direction` also what is looked up in it. Errors: InputMissing without an
// environment, Cancelled.
Result<void> describeLight(Session& session, const Document& document,
                           const std::optional<glm::vec3>& direction);

} // namespace patina::cli
