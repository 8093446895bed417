// Equations as text: operators, captions and formulas of the equation bar.
#pragma once

#include "core/document/Equation.h"

#include <QString>
#include <array>

namespace patina {
enum class LocalModel;
}

namespace patina::editor {

enum class TracedBy;

// "Irradiance". `lighting`: of the picture, whose diffuse light is not image-based under each.
[[nodiscard]] QString labelText(ViewKind kind, LightingMode lighting);
// "Irradiance / π".
[[nodiscard]] QString partText(const EquationPart& part, LightingMode lighting);
// What stands before a part: "", "+", ") ×".
[[nodiscard]] QString beforeText(const Equation& equation, std::size_t index);
// "= ρ × kD × E(n) / π × AO".
[[nodiscard]] QString formulaText(const Equation& equation, LightingMode lighting);
// The equation of a traced picture, and what it is in words.
[[nodiscard]] QString tracedFormulaText(TracedBy tracer, LocalModel model);
[[nodiscard]] QString tracedNoteText(TracedBy tracer);
// "Final without Emission": what the picture lacks.
[[nodiscard]] QString withoutText(const std::array<bool, kTermCount>& terms, LightingMode lighting);

} // namespace patina::editor
