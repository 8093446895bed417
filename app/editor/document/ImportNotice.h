// What opening a scene reported, as one notice.
#pragma once

#include "app/editor/document/UserNotice.h"

namespace patina::editor {

// Missing and damaged images by number, each once in the details; empty text when there is nothing
// to say.
[[nodiscard]] UserNotice importNotice(const QString& name, const OpenedScene& opened);

} // namespace patina::editor
