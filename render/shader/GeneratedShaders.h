// Shader text that follows from tables in C++. It is included like a file:
//   generated/views.glsl          kView… and kRecord…, as core/document/ViewTable.inc numbers them
//   generated/input-block.glsl    members of the material's uniform block: u_metallic,
//   u_metallicMap generated/inputs.glsl         u_metallicTexture …, and mapNumbers(): what maps of
//   numbers say generated/surface-inputs.glsl from maps to shading::SurfaceInputs, and from there
//   to views
// The last three follow from core/material/MaterialInputs.h.
#pragma once

#include "core/material/MaterialInput.h"

#include <optional>
#include <string>
#include <string_view>

namespace patina {
struct MaterialInputInfo;
}

namespace patina::render {

// Texture units of the maps are in the order of the inputs, from this one on, after all other
// textures. OpenGL 4.5 grants 80 in all, of which one program may use sixteen.
inline constexpr unsigned kFirstMapUnit = 16;
static_assert(kFirstMapUnit + kMaterialInputCount <= 80);

[[nodiscard]] constexpr unsigned mapUnit(MaterialInput input) {
    return kFirstMapUnit + static_cast<unsigned>(input);
}

// "PERCEPTUAL_ROUGHNESS": HAS_…_MAP where there is a map; of an input that reads one channel,
// …_TEXEL is that channel, and FETCH_… is defined where its texture is read for that.
[[nodiscard]] std::string inputDefine(const MaterialInputInfo& info);
// "metallicTexel", which METALLIC_TEXEL and those that share the fetch refer to.
[[nodiscard]] std::string texelName(const MaterialInputInfo& info);

[[nodiscard]] std::optional<std::string> generatedShader(std::string_view name);

} // namespace patina::render
