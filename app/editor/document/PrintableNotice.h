// A notice as it may be shown: names from files hold any characters (core/base/PrintableText.h).
#pragma once

#include "app/editor/document/UserNotice.h"

namespace patina::editor {

[[nodiscard]] UserNotice printableNotice(const UserNotice& notice);

} // namespace patina::editor
