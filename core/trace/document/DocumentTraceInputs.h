// What a picture of a document that is traced by rays depends on.
#pragma once

#include "core/trace/path/TraceInputs.h"

#include <functional>
#include <glm/vec3.hpp>
#include <memory>

namespace patina {

struct Document;
struct EnvironmentPart;
struct IblMaps;

// The visible meshes, the lights and environments that take part in the mix.
[[nodiscard]] TraceInputs traceInputs(const Document& document);

// What TraceView::background is where the environment stands blurred behind the scene, as the
// viewport has it. `maps`: of shownEnvironment()'s image; `blur`: View::backgroundBlur.
[[nodiscard]] std::function<glm::vec3(const glm::vec3& direction)>
blurredBackground(std::shared_ptr<const IblMaps> maps, const EnvironmentPart& shown, float blur);

} // namespace patina
