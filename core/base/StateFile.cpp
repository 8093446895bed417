#include "core/base/StateFile.h"

#include "core/base/InputFile.h"
#include "core/base/OwnFile.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <fmt/format.h>
#include <unistd.h>
#include <vector>

namespace patina {
namespace {

// Layout, least significant byte first: this, the description, its hash, the pieces one after
// another, their hash.
struct StatePrologue {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t descriptionBytes = 0;
};
static_assert(sizeof(StatePrologue) == 16 && std::endian::native == std::endian::little);

constexpr std::uint32_t kMaxDescription = 1u << 20;

Hash hashOfText(std::string_view text) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace

Result<void> writeStateFile(const std::filesystem::path& file, const StateFormat& format,
                            std::string_view description,
                            std::span<const std::span<const std::byte>> pieces,
                            StateFileName name) {
    const StatePrologue prologue{format.magic, format.version,
                                 static_cast<std::uint32_t>(description.size())};
    const Hash descriptionHash = hashOfText(description);
    std::vector<std::span<const std::byte>> all = {
        std::as_bytes(std::span(&prologue, 1)),
        std::as_bytes(std::span(description.data(), description.size())),
        std::as_bytes(std::span(&descriptionHash, 1))};
    Hasher hasher;
    for (const std::span<const std::byte> piece : pieces) {
        all.push_back(piece);
        hasher.bytes(piece);
    }
    const Hash hash = hasher.finish();
    all.push_back(std::as_bytes(std::span(&hash, 1)));
    return name == StateFileName::OfUser ? writePiecesAtomically(file, all)
                                         : writeOwnPieces(file, all);
}

bool isStateFile(const std::filesystem::path& file, const StateFormat& format) {
    const Result<RegularFile> opened = openRegularFile(file);
    std::array<char, 8> magic{};
    return opened.ok() &&
           ::read(opened->fd.get(), magic.data(), magic.size()) ==
               static_cast<ssize_t>(magic.size()) &&
           magic == format.magic;
}

std::optional<std::string> differingSetting(const StateSettings& there, const StateSettings& here) {
    for (const auto& [name, value] : here) {
        const auto other = there.find(name);
        if (other == there.end() || other->second != value)
            return fmt::format("{} ({} there, {} here)", name,
                               other == there.end() ? "none" : other->second, value);
    }
    for (const auto& [name, value] : there)
        if (!here.contains(name))
            return fmt::format("{} ({} there, none here)", name, value);
    return std::nullopt;
}

Error StateFileReader::damaged(std::string_view what) const {
    return {ErrorKind::InputBroken,
            fmt::format("the checkpoint or part is damaged ({}); remove it and {}", what,
                        m_format.anew),
            m_file,
            {}};
}

Result<std::string> StateFileReader::open() {
    Result<RegularFile> file = openRegularFile(m_file);
    if (!file)
        return file.error();
    m_descriptor = std::move(file->fd);
    m_left = file->size;
    StatePrologue prologue;
    if (!readBytes(&prologue, sizeof prologue) || prologue.magic != m_format.magic)
        return Error{ErrorKind::InputBroken, std::string(m_format.notOne), m_file, {}};
    if (prologue.version != m_format.version)
        return Error{ErrorKind::InputBroken,
                     fmt::format("it was written by another version of Patina (format {}, this "
                                 "is {}); {}",
                                 prologue.version, m_format.version, m_format.anew),
                     m_file,
                     {}};
    if (prologue.descriptionBytes > kMaxDescription || prologue.descriptionBytes > m_left)
        return damaged("its end is missing");
    std::string text(prologue.descriptionBytes, '\0');
    Hash hash;
    if (!readBytes(text.data(), text.size()) || !readBytes(&hash, sizeof hash))
        return damaged("its end is missing");
    if (hash != hashOfText(text))
        return damaged("its description was changed");
    return text;
}

Result<void> StateFileReader::expect(std::uint64_t bytes) const {
    if (m_left == bytes + sizeof(Hash))
        return {};
    return damaged(m_left < bytes + sizeof(Hash) ? "its end is missing"
                                                 : "something follows its end");
}

Result<void> StateFileReader::check(const StateSettings& settings) const {
    constexpr std::size_t kMost = 4096; // bytes: of a path
    for (const auto& [name, value] : settings)
        if (name.size() + value.size() > kMost)
            return damaged(
                fmt::format("its setting \"{}\" has {} characters; at most {} are written",
                            name.substr(0, 40), name.size() + value.size(), kMost));
    return {};
}

void StateFileReader::read(std::span<std::byte> piece) {
    m_ended = m_ended || !readBytes(piece.data(), piece.size());
    m_hasher.bytes(piece);
}

Result<void> StateFileReader::finish() {
    Hash hash;
    if (m_ended || !readBytes(&hash, sizeof hash))
        return damaged("its end is missing");
    if (hash != m_hasher.finish())
        return damaged("its values were changed");
    return {};
}

bool StateFileReader::readBytes(void* to, std::size_t size) {
    auto* bytes = static_cast<std::byte*>(to);
    while (size > 0) {
        const ssize_t count = ::read(m_descriptor.get(), bytes, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return false;
        bytes += count;
        size -= static_cast<std::size_t>(count);
        m_left -= std::min(m_left, static_cast<std::uint64_t>(count));
    }
    return true;
}

} // namespace patina
