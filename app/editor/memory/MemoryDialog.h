// Help › Memory: what the editor's memory is used for, and how much it may keep for later.
#pragma once

class QDialog;
class QWidget;

namespace patina::editor {

class MemoryUse;

// Follows while it is open. `memory` outlives it.
[[nodiscard]] QDialog* makeMemoryDialog(MemoryUse& memory, QWidget* parent);

} // namespace patina::editor
