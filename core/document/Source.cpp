#include "core/document/Source.h"

#include <charconv>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace patina {
namespace {

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::string_view kEmbedded = "#embedded:";

} // namespace

bool isBuiltin(const std::string& source) {
    return source.starts_with(kBuiltin);
}

std::string builtinName(const std::string& source) {
    return isBuiltin(source) ? source.substr(kBuiltin.size()) : std::string();
}

std::string normalizeSource(const std::string& source) {
    if (source.empty() || isBuiltin(source))
        return source;
    std::error_code error; // without a current folder the path stays as it is
    const std::filesystem::path path = std::filesystem::absolute(source, error);
    return (error ? std::filesystem::path(source) : path).lexically_normal().string();
}

std::optional<EmbeddedSource> parseEmbeddedSource(const std::string& source) {
    const std::size_t mark = source.rfind(kEmbedded);
    if (mark == std::string::npos)
        return std::nullopt;
    EmbeddedSource result{source.substr(0, mark), 0};
    const char* first = source.data() + mark + kEmbedded.size();
    const char* last = source.data() + source.size();
    const auto [end, code] = std::from_chars(first, last, result.index);
    if (code != std::errc() || end != last || result.index < 0)
        return std::nullopt;
    return result;
}

std::string formatEmbeddedSource(const EmbeddedSource& source) {
    return source.model + std::string(kEmbedded) + std::to_string(source.index);
}

} // namespace patina
