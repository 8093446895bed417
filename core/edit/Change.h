// What an edit touched, so that views of the document can update just that.
#pragma once

#include "core/edit/Parameters.h"

#include <optional>

namespace patina {

struct Change {
    Affects affects = Affects::Everything;
    std::optional<Target> target; // set when one element changed

    [[nodiscard]] static Change everything() { return {}; }
    [[nodiscard]] bool isAnotherDocument() const {
        return touches(affects, Affects::AnotherDocument);
    }
};

} // namespace patina
