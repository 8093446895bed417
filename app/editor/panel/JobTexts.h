// How jobs are put into words, the same in every dock.
#pragma once

#include <QString>

namespace patina::editor {

struct JobRecord;

[[nodiscard]] QString durationText(double seconds); // "8 s", "2 min 05 s", "3 h 07 min"
// Of an estimate: "about 8 s", "about 20 s", "about 3 min", "about 1.5 h".
[[nodiscard]] QString roughDurationText(double seconds);
// "42 % · 12 s left · 9.8 M rays/s · pass 3 of 6"
[[nodiscard]] QString progressText(const JobRecord& record);
[[nodiscard]] QString stateText(const JobRecord& record); // of a job in any state

} // namespace patina::editor
