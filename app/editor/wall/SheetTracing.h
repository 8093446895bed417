// Cells of a sheet that are traced in place of drawn, in the size of the others.
#pragma once

#include "app/editor/trace/TraceWork.h"
#include "core/base/Result.h"

#include <optional>
#include <string>
#include <vector>

namespace patina::editor {

struct SheetTracing {
    TraceSubject subject; // its look: how the picture is displayed
    TracedBy tracer = TracedBy::Paths;
    WhittedSettings whitted;
};

// Their pictures, in the order of `cells`; empty where there is nothing to trace. With as many
// samples per pixel as `patina sheet` takes. `linear`: F32, RGBA, premultiplied, before the tone
// curve, else U8, sRGB. Errors: those of TraceWork::trace() and displayedPicture().
[[nodiscard]] Result<std::vector<Image>>
traceSheetCells(const std::vector<std::optional<SheetTracing>>& cells, bool linear,
                const JobContext& job);

// For the caption: "path traced, 256 paths per pixel"; empty: none is.
[[nodiscard]] std::string tracingText(const std::vector<std::optional<SheetTracing>>& cells);

} // namespace patina::editor
