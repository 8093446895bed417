// THE parameter table: every number, colour, choice and map the user can edit, described once. It
// drives panel rows, tooltips, JSON keys, undo text and merging, `--set key=value`, and the
// reference page (`patina parameters --markdown`). A new parameter is one line in Parameters.cpp
// and its use in a shader.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/material/MapSlot.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace patina {

struct Document;

// What a change of a parameter makes necessary.
enum class Affects : std::uint32_t {
    Nothing = 0,
    Picture = 1,          // what is drawn, in some way: Dirty.h says in which
    Geometry = 2,         // meshes, transforms, visibility
    EnvironmentMap = 4,   // image-based light is to be prepared anew
    Bakes = 8,            // attached bakes may become stale
    Structure = 16,       // elements were added, removed, renamed
    AnotherDocument = 32, // ids mean other elements than before
    Everything = 0xffffffffu
};
constexpr Affects operator|(Affects a, Affects b) {
    return static_cast<Affects>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool touches(Affects value, Affects part) {
    return (static_cast<std::uint32_t>(value) & static_cast<std::uint32_t>(part)) != 0;
}

enum class Scope { Material, Light, Environment, View, Mesh, Softbox, Model };
// Reference: the id of an element of the same document, 0 for none.
enum class ParameterType { Bool, Float, Color, Vector, Choice, Text, Map, Reference };

// The value of any parameter: Bool; Float; Color and Vector; Choice (index) and Reference (id);
// Text; Map.
using ParameterValue = std::variant<bool, float, glm::vec3, int, std::string, MapSlot>;

// Whose parameter. View and model have one element, id 0; of environments 0 is the one that lights
// the scene.
struct Target {
    Scope scope = Scope::View;
    Id id = 0;
    friend bool operator==(const Target&, const Target&) = default;
};

struct ParameterInfo;

struct ParameterEdit {
    const ParameterInfo* info = nullptr;
    ParameterValue value;
};

// What must be so of the element for a parameter to have a say.
struct Condition {
    bool (*holds)(const Document&, Id) = nullptr; // the element exists
    std::string_view otherwise;                   // why it has no effect then: "only spots have it"
};

struct ParameterInfo {
    std::string_view id;    // "material.perceptualRoughness": stable, in files and scripts
    std::string_view alias; // another accepted spelling, or empty
    std::string_view label; // "Roughness"
    std::string_view group; // heading in the panel: "Surface"
    Scope scope = Scope::View;
    ParameterType type = ParameterType::Float;
    float softMin = 0.0f, softMax = 1.0f; // the slider's ends
    float hardMin = 0.0f, hardMax = 1.0f; // what may be typed
    int decimals = 3;
    std::string_view unit;                          // "°", "EV", "m" or empty; see unitFor()
    std::string_view zeroName;                      // shown instead of 0 where that is no number
    std::span<const std::string_view> choices;      // names of a Choice, as in files: "openGl"
    std::span<const std::string_view> choiceLabels; // as shown: "OpenGL (Y+)"
    std::string_view help;                          // one sentence
    Affects affects = Affects::Picture;
    ColorEncoding mapEncoding = ColorEncoding::Data; // Map: how integer files are read
    MapChannel mapChannel = MapChannel::Rgb;         // Map: what is read when nothing else is said
    // Reference: of what; a material, or an environment.
    Scope refersTo = Scope::Material;
    bool mayBeNone = true; // Reference: 0 is a value
    // Of the scene, whichever element of its scope is edited: how it uses its environments.
    bool ofScene = false;
    bool wraps = false; // an angle: values beyond the hard range come in at its other end

    // Access to the element that `target` names; get() requires that it exists.
    ParameterValue (*get)(const Document&, Id) = nullptr;
    void (*set)(Document&, Id, const ParameterValue&) = nullptr;
    // Where the unit depends on the element (a light's intensity on its type), otherwise null.
    std::string_view (*unitOf)(const Document&, Id) = nullptr;

    // The unit of this element's number; the element must exist.
    [[nodiscard]] std::string_view unitFor(const Document& document, Id element) const {
        return unitOf ? unitOf(document, element) : unit;
    }

    // Choice: why it cannot be made in this document at the moment, as a sentence that says what to
    // do; empty when it can. Null: every choice can be made.
    std::string (*unavailable)(const Document&, int choice) = nullptr;

    // What else follows when a user sets this value in this element, all of it in order; null: the
    // value alone. Ask editsFor() of core/edit/Edit.h.
    std::vector<ParameterEdit> (*onSet)(const Document&, Id, const ParameterValue&) = nullptr;

    // What a reset leads to where that depends on the element (a mesh goes back to where its file
    // has it), otherwise null: the default.
    ParameterValue (*resetTo)(const Document&, Id) = nullptr;

    // Whether it makes sense for the element (a cone only of spots): else panels hide its row.
    // Null: always.
    const Condition* applies = nullptr;
    // Whether it has an effect while it does: else its row is disabled, so that rows under the
    // pointer keep their place when a switch beside them is clicked. Null: always.
    const Condition* works = nullptr;

    [[nodiscard]] ParameterValue defaultValue() const; // of a default-constructed element
};

// Why this choice of a parameter is not offered in this document; empty when it is.
[[nodiscard]] std::string whyUnavailable(const ParameterInfo& info, const Document& document,
                                         int choice);

// Why the parameter has no effect on this element now, as the end of a sentence; empty when it has.
[[nodiscard]] std::string_view whyIdle(const ParameterInfo& info, const Document& document,
                                       Id element);

[[nodiscard]] std::span<const ParameterInfo> parameters(); // the whole table, in panel order
[[nodiscard]] const ParameterInfo* findParameter(std::string_view idOrAlias);
// "material", "light", "environment", "view", "mesh", "softbox", "model": how names of the scope
// begin.
[[nodiscard]] std::string_view scopeName(Scope scope);
[[nodiscard]] const ParameterInfo* mapOf(const ParameterInfo& parameter); // its ".map", or null

// Clamps to the hard range (or wraps an angle into it); NaN becomes the default; bytes of a text
// that are not UTF-8 become U+FFFD. CHECKs that the value has the parameter's type.
[[nodiscard]] ParameterValue clampToRange(const ParameterInfo& info, ParameterValue value);

// Text as in scripts: "0.3", "0.8,0.2,0.1", "#c08040", "true", "reinhard", a path (Map: `image`
// stays null; the caller loads it; relative paths are made absolute), a material's id (Reference).
// Usage error saying what is expected, also for numbers outside the hard range.
[[nodiscard]] Result<ParameterValue> parseParameterValue(const ParameterInfo& info,
                                                         std::string_view text);
// The same, and a Reference may also be given by the material's name.
[[nodiscard]] Result<ParameterValue>
parseParameterValue(const ParameterInfo& info, std::string_view text, const Document& document);
// "a number from 0 to 1", "one of clamp, reinhard" …: what parseParameterValue wants.
[[nodiscard]] std::string describeExpected(const ParameterInfo& info);
// The shortest text that parses back to the same value. Map: its source.
[[nodiscard]] std::string formatParameterValue(const ParameterInfo& info,
                                               const ParameterValue& value);

// The elements of a scope with this name; none of view and model, which have none.
[[nodiscard]] std::vector<Target> targetsNamed(const Document& document, Scope scope,
                                               std::string_view name);

// "material.metallic" (all materials), "material[Body].metallic" (by name), "light[Sun].intensity".
// "environment.rotationDeg" is that of the environment that lights the scene,
// "environment.secondRotationDeg" of the second one of the mix, "environment[Studio].rotationDeg"
// of one by name. Usage error when nothing is selected, with the nearest names that exist.
struct ParameterSelection {
    const ParameterInfo* info = nullptr;
    std::vector<Target> targets;
};
[[nodiscard]] Result<ParameterSelection> selectParameter(const Document& document,
                                                         std::string_view name);

} // namespace patina
