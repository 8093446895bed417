#include "core/document/SceneSource.h"

#include "core/base/LowerCase.h"

#include <charconv>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr std::string_view kScene = "#scene:";

// A title must stay one component of a path, whatever is in it, and end where the source ends.
bool isEncoded(char c) {
    return c == '/' || c == '%' || c == '#' || static_cast<unsigned char>(c) < 32;
}

std::string decodeTitle(std::string_view text) {
    std::string title;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            title += static_cast<char>(value);
            i += 2;
        } else {
            title += text[i];
        }
    }
    return title;
}

} // namespace

std::string formatSceneSource(const SceneSource& source) {
    if (source.title.empty())
        return source.file;
    std::string text = source.file + std::string(kScene);
    for (const char c : source.title)
        if (isEncoded(c))
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        else
            text += c;
    return text;
}

SceneSource parseSceneSource(const std::string& source) {
    const std::size_t mark = source.rfind(kScene);
    if (mark == std::string::npos || !holdsVisualScenes(source.substr(0, mark)))
        return {source, {}};
    const std::string_view title = std::string_view(source).substr(mark + kScene.size());
    if (title.empty() || title.find('/') != std::string_view::npos)
        return {source, {}};
    return {source.substr(0, mark), decodeTitle(title)};
}

bool holdsVisualScenes(const std::string& file) {
    return extensionOf(file) == ".dae";
}

} // namespace patina
