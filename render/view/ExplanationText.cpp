#include "render/view/Explanation.h"

#include "core/edit/Parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::render {
namespace {

constexpr std::size_t kLabelColumns = 34, kSymbolColumns = 8;
constexpr int kNumberColumns = 11;

// Columns of a font of one width: our texts have no wide characters, but superscripts and Greek.
std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

std::string padded(std::string text, std::size_t width) {
    const std::size_t length = columns(text);
    if (length < width)
        text.append(width - length, ' ');
    return text;
}

std::string numbersText(const std::vector<float>& numbers) {
    std::string text;
    for (const float number : numbers)
        text += fmt::format("{:>{}}", numberText(number), kNumberColumns);
    return text;
}

std::string valueLine(const ExplainedValue& value, std::size_t indent, std::string_view mark = {}) {
    std::string line(indent, ' ');
    line += mark;
    line = padded(line + value.label, kLabelColumns) + "  ";
    line += padded(value.symbol, kSymbolColumns);
    line += value.numbers.empty() ? "  " + value.text : numbersText(value.numbers);
    if (!value.unit.empty())
        line += "  " + value.unit;
    return line + "\n";
}

std::string stepText(const ExplainedStep& step) {
    std::string text = valueLine({{},
                                  step.label,
                                  step.result.symbol,
                                  step.result.numbers,
                                  step.result.text,
                                  step.result.unit,
                                  false},
                                 2, "= ");
    if (!step.formula.empty())
        text += "      " + step.formula + "\n";
    for (const ExplainedValue& factor : step.factors)
        text += valueLine(factor, 6);
    if (step.recomputed && !step.agrees)
        text +=
            valueLine({{}, "differs: the CPU computes", {}, *step.recomputed, {}, {}, false}, 6);
    if (!step.note.empty())
        text += "      " + step.note + "\n";
    return text;
}

using Json = nlohmann::ordered_json;

// Not a number and infinity are no JSON: they travel as text.
Json json(float number) {
    if (std::isfinite(number))
        return number;
    return numberText(number);
}

Json json(const std::vector<float>& numbers) {
    if (numbers.size() == 1)
        return json(numbers.front());
    Json array = Json::array();
    for (const float number : numbers)
        array.push_back(json(number));
    return array;
}

Json json(const glm::vec3& v) {
    return json(std::vector<float>{v.x, v.y, v.z});
}

Json json(const ExplainedValue& value) {
    return value.numbers.empty() ? Json(value.text) : json(value.numbers);
}

Json json(const ExplainedStep& step) {
    Json object;
    object["formula"] = step.formula;
    for (const ExplainedValue& factor : step.factors)
        object["factors"][factor.key] = json(factor);
    object["result"] = json(step.result);
    if (step.recomputed)
        object["recomputed"] = json(*step.recomputed);
    object["agrees"] = step.agrees;
    if (!step.note.empty())
        object["note"] = step.note;
    return object;
}

Json json(const ExplainedSection& section) {
    Json object;
    object["title"] = section.title;
    for (const ExplainedValue& value : section.values)
        object["values"][value.key] = json(value);
    for (const ExplainedStep& step : section.steps)
        object["steps"][step.key] = json(step);
    return object;
}

} // namespace

std::string numberText(float number) {
    if (std::isnan(number))
        return "NaN";
    if (std::isinf(number))
        return number > 0.0f ? "+Inf" : "-Inf";
    const float size = std::abs(number);
    if (size == 0.0f)
        return "0.0000";
    if (size >= 1e-3f && size < 1e4f)
        return fmt::format("{:.4f}", number);
    return fmt::format("{:.2e}", number);
}

std::string hexText(const glm::vec3& displayed) {
    const auto byte = [](float x) {
        return static_cast<int>(std::lround(255.0f * std::clamp(x, 0.0f, 1.0f)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(displayed.x), byte(displayed.y),
                       byte(displayed.z));
}

std::string toText(const Explanation& explanation) {
    std::string text = fmt::format("Pixel {}, {} of {} × {}: ", explanation.x, explanation.y,
                                   explanation.width, explanation.height);
    text += explanation.mesh.empty() && explanation.material.empty()
                ? std::string("background")
                : fmt::format("{}, material {}", explanation.mesh, explanation.material);
    text += fmt::format("\nDisplayed {}", hexText(explanation.displayed));
    if (explanation.difference)
        text += fmt::format("; these numbers recombine to it within {:.2f} / 255",
                            *explanation.difference);
    text += "\n";
    for (const ExplainedSection& section : explanation.sections) {
        text += "\n" + section.title + "\n";
        for (const ExplainedValue& value : section.values)
            text += valueLine(value, 2);
        for (const ExplainedStep& step : section.steps)
            text += stepText(step);
    }
    text += "\nContributions\n";
    for (const Contribution& part : explanation.contributions)
        text += valueLine({part.key,
                           part.label + (part.on ? "" : " (off)"),
                           {},
                           {part.radiance.x, part.radiance.y, part.radiance.z},
                           {},
                           {},
                           true},
                          2);
    const glm::vec3& sum = explanation.sum;
    return text + valueLine({"sum", "Sum", {}, {sum.x, sum.y, sum.z}, {}, {}, true}, 2, "= ");
}

std::string toJson(const Explanation& explanation) {
    Json object;
    object["pixel"] = {explanation.x, explanation.y};
    object["size"] = {explanation.width, explanation.height};
    object["mesh"] = explanation.mesh;
    object["material"] = explanation.material;
    for (const ExplainedSection& section : explanation.sections)
        object["sections"][section.key] = json(section);
    for (const Contribution& part : explanation.contributions)
        object["contributions"].push_back({{"key", part.key},
                                           {"label", part.label},
                                           {"radiance", json(part.radiance)},
                                           {"specular", json(part.specular)},
                                           {"on", part.on}});
    object["sum"] = json(explanation.sum);
    object["exposed"] = json(explanation.exposed);
    object["displayed"] = json(explanation.displayed);
    object["hex"] = hexText(explanation.displayed);
    if (explanation.difference)
        object["differenceOf255"] = *explanation.difference;
    object["agrees"] = explanation.agrees();
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace patina::render
