// Between the document's linear colours and what a screen and a colour dialog show.
#pragma once

#include <QColor>
#include <QString>
#include <glm/vec3.hpp>
#include <optional>

namespace patina::editor {

// Linear sRGB, clamped to 0…1 for the display.
[[nodiscard]] QColor toDisplay(const glm::vec3& linear);
[[nodiscard]] glm::vec3 toLinear(const QColor& display);

struct Hsv {
    float hue = 0, saturation = 0, value = 0; // 0…1, of the encoded (display) colour
};
[[nodiscard]] Hsv hsvOf(const glm::vec3& linear);
[[nodiscard]] glm::vec3 linearOf(const Hsv& hsv);

[[nodiscard]] QString hexOf(const glm::vec3& linear);                 // "#c08040", sRGB
[[nodiscard]] std::optional<glm::vec3> parseHex(const QString& text); // "#c08040", "c84", linear

} // namespace patina::editor
