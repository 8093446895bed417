// How jobs are put into words, the same in every dock.
#pragma once

#include <QString>

namespace patina::editor {

struct JobRecord;

[[nodiscard]] QString durationText(double seconds);          // "8 s", "2 min 05 s"
[[nodiscard]] QString progressText(const JobRecord& record); // "42 % · 12 s left · 9.8 M rays/s"

} // namespace patina::editor
