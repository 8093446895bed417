#include "core/codec/model/MtlText.h"

#include "core/base/LowerCase.h"
#include "core/base/Utf8.h"
#include "core/codec/TokenReader.h"
#include "core/codec/model/TextRewriting.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace patina::codec {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kKey = "patina:";
constexpr std::string_view kAnyBlanks = " \t\r";

// map_Ka is used for what its name says it is (AssimpMaterials.cpp).
constexpr std::array kUsed{"map_kd"sv,   "map_ka"sv, "map_ke"sv, "map_emissive"sv,
                           "map_bump"sv, "bump"sv,   "map_kn"sv, "norm"sv,
                           "map_pr"sv,   "map_pm"sv, "map_d"sv};
constexpr std::array kOthers{"disp"sv, "decal"sv, "refl"sv};
// Clearcoat, sheen and anisotropy: without effect at 0.
constexpr std::array kNumbers{"aniso"sv, "pc"sv, "ps"sv};

template <class Words>
bool isAmong(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kAnyBlanks);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kAnyBlanks) + 1 - first);
}

// Takes the next word off the text.
std::string_view nextWord(std::string_view& text) {
    const std::string_view word = text.substr(0, text.find_first_of(kAnyBlanks));
    text = trimmed(text.substr(word.size()));
    return word;
}

// Up to `most` numbers, which are taken off the text.
std::vector<float> numbersOf(std::string_view& text, std::size_t most) {
    std::vector<float> numbers;
    while (numbers.size() < most) {
        std::string_view rest = text;
        const auto number = TokenReader(nextWord(rest)).number();
        if (!number)
            break;
        numbers.push_back(std::isfinite(*number) ? static_cast<float>(*number) : 0.0f);
        text = rest;
    }
    return numbers;
}

glm::vec2 firstTwo(const std::vector<float>& numbers, glm::vec2 absent) {
    for (int i = 0; i < 2 && static_cast<std::size_t>(i) < numbers.size(); ++i)
        absent[i] = numbers[static_cast<std::size_t>(i)];
    return absent;
}

} // namespace

std::optional<MtlTexture> MtlText::texture(std::string_view statement) const {
    MtlTexture result;
    std::string_view rest = trimmed(statement);
    while (rest.starts_with('-')) {
        std::string_view after = rest;
        const std::string option = lowerCase(nextWord(after));
        if (option == "-s") {
            result.scale = firstTwo(numbersOf(after, 3), result.scale);
        } else if (option == "-o") {
            result.offset = firstTwo(numbersOf(after, 3), result.offset);
        } else if (option == "-t") {
            (void)numbersOf(after, 3);
        } else if (option == "-mm") {
            (void)numbersOf(after, 2);
        } else if (option == "-bm") {
            if (const auto numbers = numbersOf(after, 1); !numbers.empty())
                result.strength = numbers.front();
        } else if (option == "-imfchan") {
            const std::string channel = lowerCase(nextWord(after));
            result.channel = channel == "m" ? 'a' : "rgb"sv.find(channel) < 3 ? channel[0] : '\0';
        } else if (isAmong(std::array{"-clamp"sv, "-cc"sv, "-blendu"sv, "-blendv"sv, "-boost"sv,
                                      "-texres"sv, "-type"sv},
                           option)) {
            (void)nextWord(after);
        } else {
            break; // a name
        }
        rest = after;
    }

    // A comment is none where a file is called so.
    if (rest.starts_with('"')) {
        rest = rest.substr(1);
        rest = rest.substr(0, rest.find('"'));
    } else if (const std::size_t comment = std::min(rest.find(" #"), rest.find("\t#"));
               comment < rest.size() && !m_folder.open(std::string(rest))) {
        rest = trimmed(rest.substr(0, comment));
    }
    result.file = rest;
    return rest.empty() ? std::nullopt : std::optional(std::move(result));
}

std::optional<std::string> MtlText::rewritten(std::string_view text) {
    if (std::optional<std::string> utf8 = utf8FromUtf16(text)) {
        std::optional<std::string> result = rewritten(*utf8);
        return result ? result : utf8;
    }
    TextRewriting rewriting(text);
    forLines(text, [&](std::size_t begin, std::size_t first, std::size_t end) {
        std::string_view statement = text.substr(first, end - first);
        const std::string_view spelled = nextWord(statement);
        const std::string keyword = lowerCase(spelled);
        const bool isTexture =
            keyword.starts_with("map_") || isAmong(kUsed, keyword) || isAmong(kOthers, keyword);
        if (isTexture) {
            auto texture = this->texture(statement);
            if (!texture || !isAmong(kUsed, keyword)) {
                if (texture)
                    m_unused.emplace(spelled);
                rewriting.replace(begin, "", end);
                return;
            }
            rewriting.replace(begin, fmt::format("{} {}{}", keyword, kKey, m_textures.size()), end);
            m_textures.push_back(std::move(*texture));
            return;
        }
        if (isAmong(kNumbers, keyword) && TokenReader(statement).number().value_or(0.0) != 0.0)
            m_unused.emplace(spelled);
        if (keyword.starts_with("aniso"))
            rewriting.replace(begin, "", end);
    });
    return rewriting.result();
}

const MtlTexture* MtlText::find(std::string_view name) const {
    if (!name.starts_with(kKey))
        return nullptr;
    name.remove_prefix(kKey.size());
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
    return error == std::errc() && end == name.data() + name.size() && index < m_textures.size()
               ? &m_textures[index]
               : nullptr;
}

} // namespace patina::codec
