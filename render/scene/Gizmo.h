// What marks and handles in the viewport's overlay consist of: points and lines in pixels, from one
// place, so that what is drawn is what can be dragged. No OpenGL.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace patina::render {

// How the scene is seen. Pixels are counted from the bottom left.
struct GizmoView {
    glm::mat4 worldToClip{1.0f};
    glm::vec2 viewport{1.0f}; // pixels
    float scale = 1.0f;       // pixels per unit of the drawing
};

enum class GizmoHandle {
    None,
    Mark,  // moves in the plane of the picture; rotates a directional light
    AxisX, // moves along one axis of the world
    AxisY,
    AxisZ,
    Aim,     // of a light: rotates it about its position
    RotateX, // of meshes: about an axis of the world
    RotateY,
    RotateZ,
    ScaleX, // of meshes: along an axis of its own
    ScaleY,
    ScaleZ,
    ScaleAll
};

struct GizmoLine {
    glm::vec2 from, to;
    glm::vec3 color;
    bool dashed = false;
    GizmoHandle handle = GizmoHandle::None; // that can be taken hold of along the line
};

struct GizmoPoint {
    GizmoHandle handle = GizmoHandle::None;
    glm::vec2 at;
    glm::vec3 color;
    bool square = false; // else round
};

struct GizmoAxis {
    GizmoHandle move, rotate, scale;
    glm::vec3 direction, color;
};
inline constexpr std::array<GizmoAxis, 3> kGizmoAxes{{{GizmoHandle::AxisX,
                                                       GizmoHandle::RotateX,
                                                       GizmoHandle::ScaleX,
                                                       {1, 0, 0},
                                                       {0.95f, 0.30f, 0.28f}},
                                                      {GizmoHandle::AxisY,
                                                       GizmoHandle::RotateY,
                                                       GizmoHandle::ScaleY,
                                                       {0, 1, 0},
                                                       {0.45f, 0.85f, 0.30f}},
                                                      {GizmoHandle::AxisZ,
                                                       GizmoHandle::RotateZ,
                                                       GizmoHandle::ScaleZ,
                                                       {0, 0, 1},
                                                       {0.35f, 0.60f, 1.00f}}}};

inline constexpr float kGizmoMark = 14.0f;       // half the side of a mark, in units
inline constexpr float kGizmoKnob = 5.0f;        // radius of a handle, in units
inline constexpr float kGizmoReach = 64.0f;      // of the axes, in units
inline constexpr float kGizmoPickRadius = 10.0f; // around a handle, in units

// Metres between the lines of the ground grid: the power of ten that gives a handful of cells
// across the picture of a camera so far from its target.
[[nodiscard]] float gridSpacing(float cameraDistance);

// Pixel that a point of the world is seen at; nothing behind the camera.
[[nodiscard]] std::optional<glm::vec2> project(const GizmoView& view, const glm::vec3& point);
// Pixels that a metre across the view covers at `point`; 0 behind the camera.
[[nodiscard]] float pixelsPerMetre(const GizmoView& view, const glm::vec3& point);
// Of a line of the world through `point`, how far from it (in lengths of `direction`, a unit) the
// line comes nearest to what is seen at the pixel; nothing where it is seen end on.
[[nodiscard]] std::optional<float> alongAxis(const GizmoView& view, const glm::vec3& point,
                                             const glm::vec3& direction, const glm::vec2& pixel);

} // namespace patina::render
