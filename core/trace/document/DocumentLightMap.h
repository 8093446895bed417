// What a light map of a document is baked from.
#pragma once

#include "core/bake/lightmap/LightMapBake.h"

#include <functional>

namespace patina {

struct Document;
struct IblMaps;
class Image;

// `prepare` makes the maps of the environment that is shown. Errors: those of `prepare`.
Result<LightMapInputs> lightMapInputs(const Document& document,
                                      const std::function<Result<IblMaps>(const Image&)>& prepare);

} // namespace patina
