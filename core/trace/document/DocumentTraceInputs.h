// What a picture of a document that is traced by rays depends on.
#pragma once

#include "core/base/Result.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/path/TraceInputs.h"

#include <functional>
#include <glm/vec3.hpp>
#include <memory>

namespace patina {

struct Document;
struct EnvironmentPart;
struct IblMaps;
class Image;

// The visible meshes, the lights and environments that take part in the mix.
[[nodiscard]] TraceInputs traceInputs(const Document& document);

// What TraceView::background is where the environment stands blurred behind the scene, as the
// viewport has it. `maps`: of shownEnvironment()'s image; `blur`: View::backgroundBlur.
[[nodiscard]] std::function<glm::vec3(const glm::vec3& direction)>
blurredBackground(std::shared_ptr<const IblMaps> maps, const EnvironmentPart& shown, float blur);

// Sets what stands behind the scene as the document has it. `prepare` makes the maps of an
// environment that is blurred there. Errors: those of `prepare`.
Result<void> setTracedBackground(const Document& document, TraceView& view,
                                 const std::function<Result<IblMaps>(const Image&)>& prepare);

} // namespace patina
