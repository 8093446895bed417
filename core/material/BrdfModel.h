// The document's shading model as the shared shading code takes it.
#pragma once

#include "core/material/ShadingModel.h"
#include "core/math/Shading.h"

namespace patina {

[[nodiscard]] shading::BrdfModel brdfModel(const ShadingModel& model);

} // namespace patina
