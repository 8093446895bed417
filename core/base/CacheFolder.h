// A folder of files that can be made again, named by the hash of what they were made from. Its size
// is bounded: what was used longest ago goes first. Several processes may share it.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/base/Hash.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace patina {

class CacheFolder {
  public:
    // The folder is made when something is stored. `extension`: ".ibl"; `what`, for the log:
    // "light".
    CacheFolder(std::filesystem::path folder, std::string extension, std::string what,
                std::uint64_t maxBytes, std::size_t maxFileBytes);

    // What store() was given; nothing when there is none. A damaged file is removed with a line in
    // the log. What is found counts as used now.
    [[nodiscard]] std::optional<Bytes> find(const Hash& key) const;

    // Removes a file whose content makes no sense, with the same line in the log.
    void drop(const Hash& key) const;

    // Writes the file at once or not at all, then removes those that were used longest ago until
    // the rest fits. Errors: CannotCreate, Io.
    Result<void> store(const Hash& key, const Bytes& content) const;

    [[nodiscard]] std::filesystem::path file(const Hash& key) const;

  private:
    void evict(const std::filesystem::path& keep) const;

    std::filesystem::path m_folder;
    std::string m_extension, m_what;
    std::uint64_t m_maxBytes;
    std::size_t m_maxFileBytes;
};

} // namespace patina
