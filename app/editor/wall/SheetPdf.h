// A sheet of cells as a PDF: captions are text, pictures keep their pixels.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/sheet/SheetPictures.h"

#include <vector>

namespace patina::editor {

// One page of the sheet's size, 96 pixels an inch. Callable on any thread.
[[nodiscard]] Bytes sheetPdf(const sheet::WallSheet& sheet, const Wall& wall,
                             const std::vector<WallCell>& cells,
                             const std::vector<sheet::DrawnCell>& drawn);

} // namespace patina::editor
