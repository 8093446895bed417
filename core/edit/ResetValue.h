// What a reset gives a parameter.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"

namespace patina {

// The number (1) or colour (white) that shows a map as it was painted: a map multiplies it.
[[nodiscard]] ParameterValue neutralFactor(const ParameterInfo& number);

// The parameter's default, but neutralFactor() where a map multiplies it: the default would change
// the map or switch it off. The element must exist.
[[nodiscard]] ParameterValue resetValue(const Document& document, const ParameterInfo& info,
                                        const Target& target);

} // namespace patina
