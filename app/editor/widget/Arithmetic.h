// Sums that are typed into number fields: "1/3", "0.5*(2+1)", "-2^2".
#pragma once

#include <QString>
#include <optional>

namespace patina::editor {

// Numbers with a decimal point or comma, + - * / ^ (also − × · ÷), signs and parentheses; the
// usual precedence, ^ from the right. Nothing when the text is no such sum or its value is not
// finite.
[[nodiscard]] std::optional<double> evaluate(const QString& text);

} // namespace patina::editor
