// Rays of a tree in words and colours.
#pragma once

#include "core/trace/whitted/RayTree.h"

#include <QColor>
#include <QString>

namespace patina {
struct Document;
}

namespace patina::editor {

// Of the viewport's lines and the tree's marks.
[[nodiscard]] QColor rayColor(const RayNode& node);
// "Camera ray 3 of 25", "Reflected", "Shadow → Key light"; `number`, `count`: of camera rays.
[[nodiscard]] QString rayName(const Document& document, const RayNode& node, int number, int count);
// "Ball, 1.42 m", "Background".
[[nodiscard]] QString rayMeets(const Document& document, const RayNode& node);
// The terms of Whitted's equation, as luminances: "Ia ka 0.04", "f·Ip 2.1 · kd 0.31 · ks 0.02",
// "kr 0.96"; empty where the ray has none.
[[nodiscard]] QString rayTerms(const RayNode& node);
// "In shadow", "Through glass: 84 %".
[[nodiscard]] QString rayEnds(const RayNode& node);
// Of red, green and blue.
[[nodiscard]] QString lightText(const glm::vec3& light);
// Everything of a ray, a line each.
[[nodiscard]] QString rayHelp(const Document& document, const RayNode& node,
                              const glm::vec3& subtotal);

} // namespace patina::editor
