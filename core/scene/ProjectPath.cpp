#include "core/scene/ProjectPath.h"

#include "core/base/Utf8.h"
#include "core/document/Source.h"

#include <charconv>
#include <fmt/format.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

std::string encode(std::string_view bytes) {
    std::string text;
    while (!bytes.empty()) {
        const std::size_t length = bytes.front() == '%' ? 0 : utf8SequenceLength(bytes);
        if (length > 0)
            text += bytes.substr(0, length);
        else
            text += fmt::format("%{:02X}", static_cast<unsigned char>(bytes.front()));
        bytes.remove_prefix(length > 0 ? length : 1);
    }
    return text;
}

// A "%" that no two hexadecimal digits follow was written by hand and stands for itself.
std::string decode(std::string_view text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size()) {
            const char* digits = text.data() + i + 1;
            const auto [end, code] = std::from_chars(digits, digits + 2, value, 16);
            if (code == std::errc() && end == digits + 2) {
                bytes += static_cast<char>(value);
                i += 2;
                continue;
            }
        }
        bytes += text[i];
    }
    return bytes;
}

fs::path folderOf(const fs::path& projectFile) {
    return fs::path(normalizeSource(projectFile.string())).parent_path();
}

} // namespace

std::string toProjectPath(const std::string& source, const fs::path& projectFile) {
    if (source.empty() || isBuiltin(source))
        return source;
    const fs::path path = normalizeSource(source);
    std::string text = path.lexically_relative(folderOf(projectFile)).generic_string();
    if (text.empty())
        text = path.generic_string();
    // A file that is called like a built-in.
    if (isBuiltin(text))
        text.insert(0, "./");
    return encode(text);
}

std::optional<std::string> fromProjectPath(const std::string& text, const fs::path& projectFile) {
    if (text.empty() || isBuiltin(text))
        return text;
    const std::string bytes = decode(text);
    if (bytes.find('\0') != std::string::npos)
        return std::nullopt;
    return (folderOf(projectFile) / bytes).lexically_normal().string();
}

} // namespace patina
