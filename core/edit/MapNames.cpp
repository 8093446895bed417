#include "core/edit/MapNames.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

namespace patina {
namespace {

struct MapWord {
    std::string_view word, map;
    bool weak = false; // also a word for the stuff itself: counts where no other word does
};
constexpr std::array kWords{
    MapWord{"basecolor", "material.baseColor.map"},
    MapWord{"basecolour", "material.baseColor.map"},
    MapWord{"albedo", "material.baseColor.map"},
    MapWord{"diffuse", "material.baseColor.map"},
    MapWord{"diff", "material.baseColor.map"},
    MapWord{"color", "material.baseColor.map"},
    MapWord{"colour", "material.baseColor.map"},
    MapWord{"col", "material.baseColor.map"},
    MapWord{"metallic", "material.metallic.map"},
    MapWord{"metalness", "material.metallic.map"},
    MapWord{"metal", "material.metallic.map", true},
    MapWord{"roughness", "material.perceptualRoughness.map"},
    MapWord{"rough", "material.perceptualRoughness.map", true},
    MapWord{"normal", "material.normalStrength.map"},
    MapWord{"normals", "material.normalStrength.map"},
    MapWord{"normalgl", "material.normalStrength.map"},
    MapWord{"normaldx", "material.normalStrength.map"},
    MapWord{"nrm", "material.normalStrength.map"},
    MapWord{"nor", "material.normalStrength.map"},
    MapWord{"occlusion", "material.occlusionStrength.map"},
    MapWord{"ambientocclusion", "material.occlusionStrength.map"},
    MapWord{"ao", "material.occlusionStrength.map"},
    MapWord{"emissive", "material.emissive.map"},
    MapWord{"emission", "material.emissive.map"},
    MapWord{"glow", "material.emissive.map", true},
};

// "T_BrickWall_baseColor-2k" → t brick wall base color 2 k. Capitals that stand together are a
// word.
std::vector<std::string> wordsOf(std::string_view text) {
    std::vector<std::string> words;
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!std::isalpha(at(i)))
            continue;
        const bool follows = i > 0 && std::isalpha(at(i - 1));
        const bool hump =
            follows && std::isupper(at(i)) &&
            (std::islower(at(i - 1)) || (i + 1 < text.size() && std::islower(at(i + 1))));
        if (!follows || hump)
            words.emplace_back();
        words.back() += static_cast<char>(std::tolower(at(i)));
    }
    return words;
}

const MapWord* find(const std::string& word) {
    const auto found = std::find_if(kWords.begin(), kWords.end(),
                                    [&](const MapWord& w) { return w.word == word; });
    return found == kWords.end() ? nullptr : &*found;
}

} // namespace

const ParameterInfo* mapForFileName(std::string_view fileName) {
    const std::size_t slash = fileName.rfind('/');
    if (slash != std::string_view::npos)
        fileName.remove_prefix(slash + 1);
    const std::vector<std::string> words = wordsOf(fileName.substr(0, fileName.rfind('.')));
    std::string_view strong, weak;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool pair = i + 1 < words.size() && find(words[i] + words[i + 1]);
        const MapWord* word = find(pair ? words[i] + words[i + 1] : words[i]);
        i += pair ? 1 : 0;
        if (!word)
            continue;
        std::string_view& map = word->weak ? weak : strong;
        if (!word->weak && !map.empty() && map != word->map)
            return nullptr; // several in one file
        map = word->map;
    }
    const std::string_view map = strong.empty() ? weak : strong;
    return map.empty() ? nullptr : findParameter(map);
}

} // namespace patina
