// The settings of every bake, described once: the rows of the editor's panel, the texts that a bake
// carries with it (BakeArtifact::settings), and what tells whether two bakes were asked for alike.
#pragma once

#include "core/bake/domain/BakeRequest.h"

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace patina {

struct BakeChoice {
    const char* name;  // as text: "shadowed"
    const char* label; // for the user: "Shadowed"
};

struct BakeOption {
    enum class Type { Integer, Number, Toggle, Choice };

    const char* name;  // "bounceSamples"
    const char* label; // "Bounce rays"
    const char* help;  // a sentence: what it does and what it costs
    const char* unit;  // " m", " px", or empty
    Type type;
    double min, max;                     // of numbers
    std::span<const int> steps;          // Integer: those worth offering; empty: any
    std::span<const BakeChoice> choices; // Choice: the value is an index into them

    double (*get)(const BakeRequest&);
    void (*set)(BakeRequest&, double); // of every kind that knows the setting
    bool (*applies)(const BakeRequest&);
    bool shapesResult = true;  // or only what computing it costs
    const char* zeroText = ""; // Number: shown instead of 0
    bool advanced = false;     // for those who know why
};

[[nodiscard]] std::span<const BakeOption> bakeOptions(); // in the order of the panel
[[nodiscard]] const BakeOption* findBakeOption(std::string_view name);

// "256", "0.001", "true", "shadowed".
[[nodiscard]] std::string optionText(const BakeOption& option, const BakeRequest& request);

// Name → text of every option that applies to the request and shapes its result.
[[nodiscard]] std::map<std::string, std::string> settingsText(const BakeRequest& request);
// The reverse. What is missing, malformed or out of range keeps its default.
[[nodiscard]] BakeRequest requestFromText(BakeKind kind,
                                          const std::map<std::string, std::string>& settings);
// What a bake was asked for with.
[[nodiscard]] BakeRequest requestOf(const BakeArtifact& artifact);

// BakeArtifact::settings, note and stopped, by the names that files know them by.
[[nodiscard]] std::map<std::string, std::string> recordOf(const BakeArtifact& artifact);
void setRecord(BakeArtifact& artifact, std::map<std::string, std::string> record);

} // namespace patina
