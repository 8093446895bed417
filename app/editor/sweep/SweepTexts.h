// What the Light sweep dock says of a sweep.
#pragma once

#include "app/editor/sweep/SweepWork.h"

#include <QString>
#include <QStringList>

namespace patina::editor {

[[nodiscard]] QString countText(const SweepOutcome& outcome); // "252 lights of 7 environments"
// That, and of which transfer.
[[nodiscard]] QString summaryText(const SweepOutcome& outcome);
// What the numbers leave out, and where they may be wrong; may be empty.
[[nodiscard]] QStringList warningTexts(const SweepOutcome& outcome);
[[nodiscard]] QString problemText(const SweepProblem& problem);
[[nodiscard]] QString lightText(const SweepOutcome& outcome, const SweepLight& light);
[[nodiscard]] QString referenceText(const SweepOutcome& outcome);
[[nodiscard]] QString sensitivityText(const Image& sensitivity); // its range

} // namespace patina::editor
