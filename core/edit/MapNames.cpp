#include "core/edit/MapNames.h"

#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace patina {
namespace {

struct MapWord {
    std::string_view word, map;
    bool weak = false; // also a word for the stuff itself: counts where no other word does
};

// Those of the table of inputs.
std::vector<MapWord> mapWords() {
    std::vector<MapWord> words;
    for (const MaterialInputInfo& info : kMaterialInputs)
        for (const bool weak : {false, true}) {
            std::string_view rest = weak ? info.weakFileWords : info.fileWords;
            while (!rest.empty()) {
                const std::size_t end = std::min(rest.find(' '), rest.size());
                words.push_back({rest.substr(0, end), info.parameters.map, weak});
                rest.remove_prefix(std::min(end + 1, rest.size()));
            }
        }
    return words;
}

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
    static const std::vector<MapWord> kWords = mapWords();
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
