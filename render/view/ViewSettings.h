// What of the shading equation a frame shows, and how.
#pragma once

#include "core/base/Id.h"
#include "core/document/Lighting.h"

#include <array>
#include <glm/vec2.hpp>
#include <optional>

namespace patina::render {

enum class ViewMode {
    Raw,         // the factor's own value
    Contribution // what it does to the picture, as radiance (ViewInfo::contribution)
};

struct ViewRange {
    float min = 0.0f, max = 1.0f;
    friend bool operator==(const ViewRange&, const ViewRange&) = default;
};

// One side of the picture.
struct ViewChoice {
    ViewKind kind = shading::kViewFinal;
    ViewMode mode = ViewMode::Raw;
    std::optional<ViewRange> range; // locked; nothing: the table's, or the picture's own
    friend bool operator==(const ViewChoice&, const ViewChoice&) = default;
};

// The limit between two views: a line through `position` (0…1 of width and height, from the top
// left), turned by `angleDeg` from the vertical, clockwise. `other` is shown on its right.
struct ViewSplit {
    ViewChoice other;
    glm::vec2 position{0.5f};
    float angleDeg = 0.0f;
    friend bool operator==(const ViewSplit&, const ViewSplit&) = default;
};

struct ViewSettings {
    ViewChoice shown;
    std::optional<ViewSplit> split;
    // Which terms the picture is made of, in the order of kTermViews.
    std::array<bool, kTermCount> terms{true, true, true, true, true};
    // Whose D, G, F, N·L …: a shining light's id; 0: the mirror direction of the view.
    Id light = 0;
    float flags = 1.0f; // 0…1: strength of the marks of invalid pixels, so that they can blink
    // How the picture is lit instead of what the document says, where the view has no say in it.
    std::optional<LightingMode> lighting;
    // A constant environment of this radiance instead of the document's, without lights.
    std::optional<glm::vec3> furnace;
    friend bool operator==(const ViewSettings&, const ViewSettings&) = default;

    [[nodiscard]] bool isPlain() const { return *this == ViewSettings(); }
    // Whether a side of the picture is the ordinary one, which records no terms.
    [[nodiscard]] bool isOrdinary(const ViewChoice& choice) const;
};

} // namespace patina::render
