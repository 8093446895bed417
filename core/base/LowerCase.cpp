#include "core/base/LowerCase.h"

#include <algorithm>

namespace patina {

std::string lowerCase(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return result;
}

std::string extensionOf(const std::filesystem::path& path) {
    return lowerCase(path.extension().string());
}

} // namespace patina
