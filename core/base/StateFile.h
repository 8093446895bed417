// Files that hold the state of work under way: a description as text, then arrays of values, each
// with its hash, so that one that was cut or edited is found out. They are read by the program that
// wrote them: values lie in them as in memory.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/base/FileDescriptor.h"
#include "core/base/Hash.h"
#include "core/base/Result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace patina {

struct StateFormat {
    std::array<char, 8> magic{};
    std::uint32_t version = 1; // also counts changes of how the values are computed
    std::string_view notOne;   // the message about a file that is none of these
    std::string_view anew;     // what to do about one that cannot be used: "bake it anew"
};

// Files that the user named: a link there is followed. Others: it is replaced.
enum class StateFileName { Own, OfUser };

// Writes the pieces in one step, without a copy of them. Errors: those of writeFileAtomically().
Result<void> writeStateFile(const std::filesystem::path& file, const StateFormat& format,
                            std::string_view description,
                            std::span<const std::span<const std::byte>> pieces, StateFileName name);

// Whether a file begins as those of the format do.
[[nodiscard]] bool isStateFile(const std::filesystem::path& file, const StateFormat& format);

// The first setting in which two descriptions differ, for the user: "samples (64 there, 128 here)".
using StateSettings = std::map<std::string, std::string>;
[[nodiscard]] std::optional<std::string> differingSetting(const StateSettings& there,
                                                          const StateSettings& here);

class StateFileReader {
  public:
    StateFileReader(std::filesystem::path file, StateFormat format)
        : m_file(std::move(file))
        , m_format(format) {}

    // The description. Errors: InputMissing; InputBroken for a file that is none, of another
    // version, cut or edited.
    Result<std::string> open();
    // After open(): what follows is `bytes` of values. Errors: InputBroken.
    Result<void> expect(std::uint64_t bytes) const;
    // Settings of the description. Errors: InputBroken where one is longer than any that is
    // written: it would go into messages, and into pictures, whose formats have no room for it.
    Result<void> check(const StateSettings& settings) const;
    // The next piece, of the size that was written; finish() says whether it can be believed.
    void read(std::span<std::byte> piece);
    // After the last piece. Errors: InputBroken where the values are not those that were written.
    Result<void> finish();

    [[nodiscard]] Error damaged(std::string_view what) const;

  private:
    [[nodiscard]] bool readBytes(void* to, std::size_t size);

    std::filesystem::path m_file;
    StateFormat m_format;
    FileDescriptor m_descriptor;
    std::uint64_t m_left = 0; // bytes
    Hasher m_hasher;
    bool m_ended = false;
};

} // namespace patina
