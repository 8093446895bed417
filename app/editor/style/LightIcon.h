// The icons of the kinds of light.
#pragma once

#include "core/document/Document.h"

#include <QString>

namespace patina::editor {

[[nodiscard]] QString lightIcon(LightType type); // for icon()

} // namespace patina::editor
