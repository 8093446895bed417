#include "core/io/TexturePaths.h"
#include "core/base/LowerCase.h"
#include "core/base/Utf8.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>

namespace patina {

namespace {

namespace fs = std::filesystem;

std::string withSlashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

bool usable(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && fs::file_size(file, error) > 0 && !error;
}

// "C:/art/wood.png" is absolute somewhere else; here it would be a relative path.
bool foreignAbsolute(const std::string& name) {
    return name.size() > 1 && name[1] == ':' &&
           std::isalpha(static_cast<unsigned char>(name[0])) != 0;
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8SequenceLength(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

// Of a text in Windows-1252, which is Latin-1 with letters and marks in place of 0x80…0x9F.
std::string utf8Of(std::string_view windows) {
    constexpr std::array<std::uint16_t, 32> kMarks{
        0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
        0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
        0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};
    std::string text;
    for (const char c : windows) {
        const auto byte = static_cast<unsigned char>(c);
        const unsigned code = byte >= 0x80 && byte < 0xA0 ? kMarks[byte - 0x80] : byte;
        if (code < 0x80) {
            text += c;
        } else if (code < 0x800) {
            text += static_cast<char>(0xC0 | (code >> 6));
            text += static_cast<char>(0x80 | (code & 63));
        } else {
            text += static_cast<char>(0xE0 | (code >> 12));
            text += static_cast<char>(0x80 | ((code >> 6) & 63));
            text += static_cast<char>(0x80 | (code & 63));
        }
    }
    return text;
}

} // namespace

const TexturePaths::Listing& TexturePaths::listing(const fs::path& folder) {
    const auto [entry, isNew] = m_listings.try_emplace(folder);
    if (isNew) {
        std::error_code error;
        for (fs::directory_iterator it(folder, error), end; !error && it != end;
             it.increment(error))
            entry->second.try_emplace(lowerCase(it->path().filename().string()), it->path());
    }
    return entry->second;
}

fs::path TexturePaths::expected(const std::string& name) const {
    const std::string path = withSlashes(name);
    if (foreignAbsolute(path))
        return m_folder / fs::path(path).filename();
    return (m_folder / path).lexically_normal();
}

std::optional<fs::path> TexturePaths::find(const std::string& name) {
    const auto found = findSpelled(name);
    if (found || isUtf8(name))
        return found;
    return findSpelled(utf8Of(name));
}

std::optional<fs::path> TexturePaths::findSpelled(const std::string& name) {
    if (name.empty() || name.find("://") != std::string::npos)
        return std::nullopt;
    // Some file names really hold a backslash.
    std::optional<fs::path> outside;
    for (const fs::path& spelled : {expected(name), m_folder / name}) {
        if (!usable(spelled))
            continue;
        if (isInside(spelled))
            return spelled;
        if (!outside)
            outside = spelled;
    }

    const std::string base = lowerCase(fs::path(withSlashes(name)).filename().string());
    const auto inFolder = [&](const fs::path& folder) -> std::optional<fs::path> {
        const Listing& files = listing(folder);
        const auto it = files.find(base);
        return it != files.end() && usable(it->second) ? std::optional(it->second) : std::nullopt;
    };
    if (auto beside = inFolder(m_folder))
        return beside;
    const Listing& around = listing(m_folder);
    if (const auto textures = around.find("textures"); textures != around.end())
        if (auto within = inFolder(textures->second))
            return within;
    if (outside)
        return outside;

    // In another folder beside the model, unless two have one of that name.
    constexpr std::size_t kMostFolders = 100;
    std::optional<fs::path> elsewhere;
    std::size_t folders = 0;
    for (const auto& [lowerName, path] : around) {
        std::error_code error;
        if (!fs::is_directory(fs::symlink_status(path, error)) || ++folders > kMostFolders)
            continue;
        if (auto within = inFolder(path)) {
            if (elsewhere)
                return std::nullopt;
            elsewhere = std::move(within);
        }
    }
    return elsewhere;
}

bool TexturePaths::isInside(const fs::path& file) const {
    std::error_code failed;
    const fs::path folder = fs::weakly_canonical(m_folder, failed);
    const fs::path full = failed ? fs::path() : fs::weakly_canonical(file, failed);
    return !failed && std::mismatch(folder.begin(), folder.end(), full.begin(), full.end()).first ==
                          folder.end();
}

} // namespace patina
