// Entries of catalogs that have been made before, kept in a folder: one file per environment, named
// by catalogKey(). Several processes may share the folder.
#pragma once

#include "core/base/CacheFolder.h"
#include "core/catalog/CatalogEntry.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace patina {

class CatalogCache {
  public:
    static constexpr std::uint64_t kDefaultBytes = std::uint64_t{128} << 20; // some 2000 entries

    // The folder is made when something is stored. `maxBytes`: what its files may hold together.
    explicit CatalogCache(std::filesystem::path folder, std::uint64_t maxBytes = kDefaultBytes);

    // Nothing when there is none. A damaged file is removed with a line in the log. What is found
    // counts as used now.
    [[nodiscard]] std::optional<CatalogEntry> find(const Hash& key) const;

    // Writes the file at once or not at all, then removes those that were used longest ago until
    // the rest fits. Errors: CannotCreate, Io; the entry is still good.
    Result<void> store(const Hash& key, const CatalogEntry& entry) const;

    [[nodiscard]] std::filesystem::path file(const Hash& key) const { return m_files.file(key); }

  private:
    CacheFolder m_files;
};

} // namespace patina
