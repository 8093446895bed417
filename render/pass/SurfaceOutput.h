// Which variant of surface.frag: the picture, or one that records terms
// (shaders/include/views.glsl).
#pragma once

namespace patina::render {

enum class SurfaceOutput { Picture, OneView, EightViews, Inspection };
inline constexpr int kSurfaceOutputCount = 4;

} // namespace patina::render
