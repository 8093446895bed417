// The files of a glTF export: a GLB, or a .gltf with those beside it.
#pragma once

#include "core/export/Export.h"

namespace patina {

[[nodiscard]] ExportPlan planGltf(const Document& document, const ExportSettings& settings);

} // namespace patina
