// What is different between two states of a document, value by value: to decide between them.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <vector>

namespace patina {

struct DocumentDifference {
    std::string element; // "Material Gold", "Light Sun", "Environment"; UTF-8
    std::string value;   // the parameter's label with its unit; empty: the whole element
    std::string before, after;
    friend bool operator==(const DocumentDifference&, const DocumentDifference&) = default;
};

// Compares values, elements by their id, never payloads; neither needs to be resolved. What only
// one of them has is one line ("" and "added", or "removed"). Bakes are not compared.
[[nodiscard]] std::vector<DocumentDifference> differences(const Document& before,
                                                          const Document& after);

} // namespace patina
