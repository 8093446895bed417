// Parameter values as text: parsing, formatting, ranges.
#include "core/base/Check.h"
#include "core/base/Utf8.h"
#include "core/document/Document.h"
#include "core/document/Source.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/image/Srgb.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace patina {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return result;
}

// Locale-independent; nothing may follow the number. Infinity and NaN are no numbers here.
std::optional<float> parseFloat(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+'))
        text.remove_prefix(1);
    float value = 0.0f;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string formatFloat(float value) {
    std::array<char, 32> buffer{};
    const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    CHECK(code == std::errc());
    return {buffer.data(), end};
}

std::optional<std::vector<float>> parseFloats(std::string_view text) {
    std::vector<float> values;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::optional<float> value = parseFloat(text.substr(0, comma));
        if (!value)
            return std::nullopt;
        values.push_back(*value);
        if (comma == std::string_view::npos)
            return values;
        text.remove_prefix(comma + 1);
    }
}

// "#rrggbb": sRGB as in every paint program.
std::optional<glm::vec3> parseHexColor(std::string_view text) {
    if (text.size() != 7 || text.front() != '#')
        return std::nullopt;
    unsigned value = 0;
    const auto [end, code] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
    if (code != std::errc() || end != text.data() + 7)
        return std::nullopt;
    const auto channel = [&](int shift) {
        return srgbToLinear(static_cast<float>((value >> shift) & 0xffu) / 255.0f);
    };
    return glm::vec3(channel(16), channel(8), channel(0));
}

std::optional<bool> parseBool(std::string_view text) {
    const std::string word = lowerCase(text);
    if (word == "true" || word == "1" || word == "on" || word == "yes")
        return true;
    if (word == "false" || word == "0" || word == "off" || word == "no")
        return false;
    return std::nullopt;
}

bool inRange(const ParameterInfo& info, float value) {
    return info.wraps || (value >= info.hardMin && value <= info.hardMax);
}

float clampFloat(const ParameterInfo& info, float value, float fallback) {
    if (std::isnan(value))
        return fallback;
    if (info.wraps && std::isfinite(value) && (value < info.hardMin || value > info.hardMax)) {
        const float turn = info.hardMax - info.hardMin;
        value -= turn * std::floor((value - info.hardMin) / turn);
    }
    return std::clamp(value, info.hardMin, info.hardMax);
}

glm::vec3 clampVector(const ParameterInfo& info, glm::vec3 value, glm::vec3 fallback) {
    for (int i = 0; i < 3; ++i)
        value[i] = clampFloat(info, value[i], fallback[i]);
    return value;
}

std::optional<ParameterValue> parseValue(const ParameterInfo& info, std::string_view text) {
    switch (info.type) {
    case ParameterType::Bool:
        if (const auto value = parseBool(text))
            return *value;
        return std::nullopt;
    case ParameterType::Float:
        if (const auto value = parseFloat(text); value && inRange(info, *value))
            return *value;
        return std::nullopt;
    case ParameterType::Color:
    case ParameterType::Vector: {
        const bool isColor = info.type == ParameterType::Color;
        if (const auto hex = parseHexColor(text); hex && isColor)
            return *hex;
        auto values = parseFloats(text);
        if (values && isColor && values->size() == 1)
            values->resize(3, values->front()); // a grey
        if (!values || values->size() != 3 ||
            !std::all_of(values->begin(), values->end(),
                         [&](float value) { return inRange(info, value); }))
            return std::nullopt;
        return glm::vec3((*values)[0], (*values)[1], (*values)[2]);
    }
    case ParameterType::Choice: {
        const std::string word = lowerCase(text);
        for (std::size_t i = 0; i < info.choices.size(); ++i)
            if (lowerCase(info.choices[i]) == word)
                return static_cast<int>(i);
        return std::nullopt;
    }
    case ParameterType::Text:
        return std::string(text);
    case ParameterType::Map: {
        MapSlot slot;
        slot.source = text.empty() ? std::string() : normalizeSource(std::string(text));
        slot.channel = info.mapChannel;
        return slot;
    }
    case ParameterType::Reference: {
        int value = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (code != std::errc() || end != text.data() + text.size() || value < 0)
            return std::nullopt;
        return value;
    }
    }
    CHECK(false);
    return std::nullopt;
}

} // namespace

std::string describeExpected(const ParameterInfo& info) {
    const std::string range =
        fmt::format("from {} to {}", formatFloat(info.hardMin), formatFloat(info.hardMax));
    switch (info.type) {
    case ParameterType::Bool:
        return "true or false";
    case ParameterType::Float:
        return info.wraps ? "an angle in degrees" : "a number " + range;
    case ParameterType::Color:
        return "a colour: three comma-separated linear numbers " + range + ", or #rrggbb (sRGB)";
    case ParameterType::Vector:
        return info.wraps ? "three comma-separated angles in degrees"
                          : "three comma-separated numbers " + range;
    case ParameterType::Choice:
        return fmt::format("one of {}", fmt::join(info.choices, ", "));
    case ParameterType::Text:
        return "a text";
    case ParameterType::Map:
        return "an image file or builtin:NAME";
    case ParameterType::Reference:
        return fmt::format("{} {} of the scene", info.refersTo == Scope::Material ? "a" : "an",
                           scopeName(info.refersTo));
    }
    CHECK(false);
    return {};
}

Result<ParameterValue> parseParameterValue(const ParameterInfo& info, std::string_view text) {
    // Names and paths may begin or end with a space; nothing else may.
    const bool verbatim = info.type == ParameterType::Text || info.type == ParameterType::Map;
    if (auto value = parseValue(info, verbatim ? text : trimmed(text)))
        return clampToRange(info, *std::move(value));
    return Error{ErrorKind::Usage,
                 fmt::format("{} expects {}, not \"{}\"", info.id, describeExpected(info),
                             makeValidUtf8(text.substr(0, 80))),
                 {},
                 {}};
}

Result<ParameterValue> parseParameterValue(const ParameterInfo& info, std::string_view text,
                                           const Document& document) {
    if (info.type != ParameterType::Reference)
        return parseParameterValue(info, text);
    for (const Target& named : targetsNamed(document, info.refersTo, text))
        return ParameterValue(static_cast<int>(named.id));
    Result<ParameterValue> value = parseParameterValue(info, text);
    if (!value)
        return value;
    if (!leadsSomewhere(document, info, *value))
        return Error{ErrorKind::Usage,
                     fmt::format("{} expects {}; there is none with the name or number \"{}\"",
                                 info.id, describeExpected(info), std::get<int>(*value)),
                     {},
                     {}};
    return value;
}

ParameterValue clampToRange(const ParameterInfo& info, ParameterValue value) {
    // A value of another type than the parameter's is a fault of the caller.
    CHECK_EQ(value.index(), info.defaultValue().index());
    switch (info.type) {
    case ParameterType::Float:
        return clampFloat(info, std::get<float>(value), std::get<float>(info.defaultValue()));
    case ParameterType::Color:
    case ParameterType::Vector:
        return clampVector(info, std::get<glm::vec3>(value),
                           std::get<glm::vec3>(info.defaultValue()));
    case ParameterType::Choice:
        return std::clamp(std::get<int>(value), 0, static_cast<int>(info.choices.size()) - 1);
    case ParameterType::Text:
        return makeValidUtf8(std::get<std::string>(value));
    case ParameterType::Reference:
        return std::max(std::get<int>(value), 0);
    case ParameterType::Bool:
    case ParameterType::Map:
        break;
    }
    return value;
}

std::string formatParameterValue(const ParameterInfo& info, const ParameterValue& value) {
    switch (info.type) {
    case ParameterType::Bool:
        return std::get<bool>(value) ? "true" : "false";
    case ParameterType::Float:
        return formatFloat(std::get<float>(value));
    case ParameterType::Color:
    case ParameterType::Vector: {
        const glm::vec3& v = std::get<glm::vec3>(value);
        return formatFloat(v.x) + "," + formatFloat(v.y) + "," + formatFloat(v.z);
    }
    case ParameterType::Choice: {
        const int index = std::get<int>(value);
        CHECK(index >= 0 && static_cast<std::size_t>(index) < info.choices.size());
        return std::string(info.choices[static_cast<std::size_t>(index)]);
    }
    case ParameterType::Text:
        return std::get<std::string>(value);
    case ParameterType::Map:
        return std::get<MapSlot>(value).source;
    case ParameterType::Reference:
        return std::to_string(std::get<int>(value));
    }
    CHECK(false);
    return {};
}

} // namespace patina
