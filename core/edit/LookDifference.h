// What differs between two looks, value by value: docs/user-guide.md calls it the difference of two
// snapshots.
#pragma once

#include "core/document/Snapshot.h"
#include "core/edit/Parameters.h"

#include <string>
#include <vector>

namespace patina {

// All parameters but names, and the camera's field of view: how a thing is called and where it is
// looked at from are no part of a look.
[[nodiscard]] bool isOfLook(const ParameterInfo& info);

struct LookDifference {
    Target target;                       // of environments always by id, or 0 for rows ofScene
    const ParameterInfo* info = nullptr; // null: the whole element, which only one of them has
    ParameterValue a, b;                 // where there is `info`; of maps without their images
    bool inA = true, inB = true;         // the element
    // As shown: "Material Gold", "Roughness", "0.3", "0.9". Of whole elements the label is empty,
    // and the texts are "there" and "not there".
    std::string element, label, textA, textB;
};

// In the order of the parameter table within each element, elements by their lists. Values that are
// equal are not in it; nothing else is left out. Meshes that only one of them has are no difference
// of looks. Names are those of `b`, or of `a` where only that has the element.
[[nodiscard]] std::vector<LookDifference> differencesOf(const Look& a, const Look& b);

} // namespace patina
