// Names an environment's light in a scene.
#pragma once

#include <cstdint>

namespace patina::render {

using LightId = std::uint32_t;
inline constexpr LightId kDocumentLight = 0; // of the document's own environment: always there

} // namespace patina::render
