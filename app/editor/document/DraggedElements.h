// Materials and snapshots of the scene that are dragged out of their lists.
#pragma once

#include "core/cells/Wall.h"

#include <optional>
#include <vector>

class QMimeData;

namespace patina {
class EditSession;
}

namespace patina::editor {

inline constexpr const char* kElementsMime = "application/x-patina-elements";

struct DraggedElements {
    CellElement element = CellElement::Material;
    std::vector<Id> ids; // at least one, all in the scene
};

void setDraggedElements(QMimeData& data, const EditSession& session,
                        const DraggedElements& elements);
// Nothing when they are of another editor or of a scene that was closed since.
[[nodiscard]] std::optional<DraggedElements> draggedElements(const QMimeData& data,
                                                             const EditSession& session);

} // namespace patina::editor
