// A part of the scene's picture that is drawn at a time.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace patina::render {

// An interval of the triangles of a draw list: of its opaque items and then of its blended ones.
struct TriangleRange {
    std::uint64_t first = 0, count = std::numeric_limits<std::uint32_t>::max();

    [[nodiscard]] std::uint64_t end() const { return first + count; }
};

struct SceneSlice {
    glm::ivec4 rect{0};      // pixels: left, bottom, width, height
    TriangleRange triangles; // of those that the rectangle shows
    // Set by drawing it: how many triangles the rectangle shows, and whether these were its last.
    std::uint64_t shown = 0;
    bool complete = false;
};

// Clip space of the rectangle, and a pixel around it, out of that of a picture of width × height.
[[nodiscard]] glm::mat4 clipOfRect(const glm::ivec4& rect, int width, int height);

} // namespace patina::render
