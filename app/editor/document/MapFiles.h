// Several images onto one material.
#pragma once

#include "app/editor/document/DropPlan.h"
#include "core/base/Id.h"

namespace patina::editor {

class DocumentController;

// Reads them in the background and assigns them as one undo step; those that cannot be read leave
// their slots as they are, with a notice.
void setMaps(DocumentController& controller, Id material, const std::vector<MapFile>& files);

} // namespace patina::editor
