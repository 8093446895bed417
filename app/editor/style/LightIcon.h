// The icons of the kinds of light.
#pragma once

#include <QString>

namespace patina {
enum class LightType;
}

namespace patina::editor {

[[nodiscard]] QString lightIcon(LightType type); // for icon()

} // namespace patina::editor
