// What a wall compares, as somebody chooses it. The wall itself is made from it and the document
// (planWall()), anew after each edit, so that it shows what the scene has.
#pragma once

#include "core/cells/Wall.h"

#include <string>
#include <vector>

namespace patina {

enum class Compared {
    Nothing,
    Environments,
    Materials,
    LightingModes,
    ToneCurves,
    Values,
    Snapshots
};

// Of columns or rows.
struct AxisPlan {
    Compared compared = Compared::Nothing;
    // What is not shown: ids of environments, materials or snapshots, indexes of lighting modes or
    // tone curves. What is added to the scene is shown, so that it is not missed.
    std::vector<Id> hidden;
    std::vector<Id> meshes; // Materials: that are given them; empty: all visible ones
    // Values of a number: of one element, or, where its id is 0, of all that the scope has.
    const ParameterInfo* info = nullptr;
    Target target;
    float from = 0.0f, to = 1.0f;
    int count = 5;
    friend bool operator==(const AxisPlan&, const AxisPlan&) = default;
};

struct WallPlan {
    AxisPlan columns, rows; // either may compare nothing, but not both
    friend bool operator==(const WallPlan&, const WallPlan&) = default;
};

// The environments of the scene × its materials where it has several, else whichever it has several
// of, else the roughness of all materials from 0 to 1.
[[nodiscard]] WallPlan defaultWallPlan(const Document& document);

// A plan of a number: its slider's ends (or its whole range, where that is less), five values.
[[nodiscard]] AxisPlan valuesPlan(const ParameterInfo& info, Target target);

// Something that an axis can show beside others: a material, a tone curve.
struct AxisChoice {
    Id id = 0; // as in AxisPlan::hidden
    std::string caption;
    std::string whyNot; // why the document does not offer it; empty where it does
    bool shown = false; // on the wall
};
// None of Nothing and Values. At most `most` are shown, the first ones of those that are not
// hidden.
[[nodiscard]] std::vector<AxisChoice> choicesOf(const Document& document, const AxisPlan& plan,
                                                std::size_t most);
// How many an axis may show: of a table kMostOnWallSide, of a grid as many as fill one.
[[nodiscard]] std::size_t mostOnAxis(const WallPlan& plan);

// The wall of the document. Usage error where it has nothing to show, or the plan refers to what is
// no longer there; the message says which.
[[nodiscard]] Result<Wall> planWall(const Document& document, const WallPlan& plan);

} // namespace patina
