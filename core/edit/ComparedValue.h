// A parameter's value where two states of a document are compared.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"

#include <string>

namespace patina {

// Images are derived from their source, or read from it: what is compared is the rest.
[[nodiscard]] ParameterValue withoutPayload(ParameterValue value);

// "Lambert", "on", "Gold", "0.25", a file: as a list of differences says it.
[[nodiscard]] std::string comparedText(const ParameterInfo& info, const ParameterValue& value,
                                       const Document& document);

// "Intensity (lx)": the label with the element's unit.
[[nodiscard]] std::string comparedLabel(const ParameterInfo& info, const Document& document,
                                        Id element);

} // namespace patina
