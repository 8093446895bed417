// How far a traced picture is, in words.
#pragma once

#include "app/editor/trace/TraceWork.h"

#include <QString>

namespace patina::editor {

enum class TracedRoom {
    Whole, // of the viewport: all that is known
    Side,  // of a split, half the room
    Cell,  // of a wall
    Small, // the same where that does not fit
};

// "Path traced · 64 paths per pixel · ± 1.5 % of the mean …", or why there is no picture.
[[nodiscard]] QString tracedText(TracedBy tracer, const TraceProgress& progress, TracedRoom room);
// What the numbers mean: a tool tip.
[[nodiscard]] QString tracedHelp(TracedBy tracer, const TraceProgress& progress);

} // namespace patina::editor
