// What a wall can compare: environments, materials, snapshots, choices (lighting modes, tone
// curves) and a number's values.
#pragma once

#include "core/cells/Wall.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

// Environments of the document, by id.
[[nodiscard]] WallAxis environmentAxis(const Document& document, std::span<const Id> environments);

// The id of the document's material of this name; else of a built-in one ("gold", "builtin:gold"),
// which is added. Usage error with the names that exist.
Result<Id> materialNamed(Document& document, const std::string& name);
// Materials of the document on all visible meshes, or on `meshes` alone.
[[nodiscard]] WallAxis materialAxis(const Document& document, std::span<const Id> materials,
                                    std::span<const Id> meshes = {});

// Snapshots of the document, by id.
[[nodiscard]] WallAxis snapshotAxis(const Document& document, std::span<const Id> snapshots);
// The ids of the snapshots of these names. Usage error with the names that exist.
[[nodiscard]] Result<std::vector<Id>> snapshotsNamed(const Document& document,
                                                     std::span<const std::string> names);

// Choices of a parameter by their names in files: "view.lighting", {"ibl", "prt"}. Whether the
// document offers each of them is for the caller to ask (whyUnavailable()). Usage error for a
// parameter that is no choice, and for unknown names, with those that exist.
[[nodiscard]] Result<WallAxis> choiceAxis(const Document& document, std::string_view parameter,
                                          std::span<const std::string> choices);

// Values of a number, evenly spaced, both ends among them.
struct Wedge {
    std::string parameter; // as --set names it: "material[Body].perceptualRoughness"
    float from = 0.0f, to = 1.0f;
    int count = 2;
};
// "NAME=FROM:TO:COUNT". Usage error for other texts.
[[nodiscard]] Result<Wedge> parseWedge(std::string_view text);
// Of elements of one scope, all of which get each value, and at least one. `named`: the title says
// whose it is, "Roughness of Body". Usage errors as of parseWedge() and wedgeAxis().
[[nodiscard]] Result<WallAxis> valueAxis(const Document& document, const ParameterInfo& info,
                                         std::span<const Target> targets, float from, float to,
                                         int count, bool named);
// Usage error when there is no such parameter or element, when it is no number, or an end is out of
// its range.
[[nodiscard]] Result<WallAxis> wedgeAxis(const Document& document, const Wedge& wedge);

} // namespace patina
