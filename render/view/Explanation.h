// Why a pixel looks as it does: everything its colour was computed from, with names, formulas and
// numbers, as a tree that panels, `patina render --inspect`, text and JSON show alike.
#pragma once

#include "core/document/Document.h"
#include "render/view/Inspection.h"

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina::render {

// A named number, colour, vector or text.
struct ExplainedValue {
    std::string key;            // stable, for scripts: the id of a view where there is one
    std::string label;          // "Base Colour"
    std::string symbol;         // as formulas call it; may be empty
    std::vector<float> numbers; // up to four; none: `text` says it
    std::string text;
    std::string unit;
    bool isColor = false; // `numbers` are linear r, g, b
};

// A formula, what goes into it and what comes out.
struct ExplainedStep {
    std::string key, label;
    std::string formula; // with the symbols of the factors: "ρd · kD · AO · E / π"
    std::vector<ExplainedValue> factors;
    ExplainedValue result; // as the shader computed it; where it records none, as the CPU did
    // The formula evaluated with these very factors by the CPU, and whether that is the result
    // within kAgreement.
    std::optional<std::vector<float>> recomputed;
    bool agrees = true;
    std::string note; // a sentence; may be empty
};

// Of the larger number; numbers close to zero are compared by their difference.
inline constexpr float kAgreement = 1e-3f;

struct ExplainedSection {
    std::string key, title;
    std::vector<ExplainedValue> values;
    std::vector<ExplainedStep> steps;
};

// A share of the picture: one bar of the waterfall.
struct Contribution {
    std::string key;   // id of the term's view; of a light: "light" and its id
    std::string label; // "Diffuse Image-Based", or the light's name
    glm::vec3 radiance{0.0f};
    glm::vec3 specular{0.0f}; // of a light: the part of `radiance` that its highlight is
    bool on = true;           // false: switched off, not in the sum
};

struct Explanation {
    int x = 0, y = 0, width = 0, height = 0; // pixel from the top left
    std::string mesh, material;              // names; empty beside the model
    std::vector<ExplainedSection> sections;
    std::vector<Contribution> contributions; // their sum is `sum`
    glm::vec3 sum{0.0f};                     // radiance, before exposure
    glm::vec3 exposed{0.0f};
    glm::vec3 displayed{0.0f}; // 0…1, encoded: of the picture, whatever the viewport shows
    // The largest difference of a channel between the picture's colour and the one that the numbers
    // recombine to, in steps of 1/255; nothing where that cannot be told (OpenColorIO, other
    // views).
    std::optional<float> difference;
    [[nodiscard]] bool agrees() const; // every step does
};

[[nodiscard]] Explanation explain(const Inspection& pixel, const Document& document);

// Aligned for fonts of one width; ends with a line feed.
[[nodiscard]] std::string toText(const Explanation& explanation);
// Sections, values and steps by their keys; numbers as they are, colours as arrays. Indented.
[[nodiscard]] std::string toJson(const Explanation& explanation);

// A number as it is shown: four decimals, or a power of ten where they would hide it.
[[nodiscard]] std::string numberText(float number);
// "#c8a04b" of a displayed colour.
[[nodiscard]] std::string hexText(const glm::vec3& displayed);

} // namespace patina::render
