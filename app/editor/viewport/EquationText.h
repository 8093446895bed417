// Equations as text: operators, captions and formulas of the equation bar.
#pragma once

#include "core/document/Equation.h"

#include <QString>
#include <array>

namespace patina::editor {

[[nodiscard]] QString labelText(ViewKind kind);           // "Irradiance"
[[nodiscard]] QString partText(const EquationPart& part); // "Irradiance / π"
// What stands before a part: "", "+", ") ×".
[[nodiscard]] QString beforeText(const Equation& equation, std::size_t index);
[[nodiscard]] QString formulaText(const Equation& equation); // "= ρ × kD × E(n) / π × AO"
// "Final without Emission": what the picture lacks.
[[nodiscard]] QString withoutText(const std::array<bool, kTermCount>& terms);

} // namespace patina::editor
