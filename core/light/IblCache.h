// Image-based light that has been computed before, kept in a folder: one file per environment,
// named by the hash of its pixels, the settings and the version of the algorithm. Several processes
// may share the folder.
#pragma once

#include "core/base/CacheFolder.h"
#include "core/light/Ibl.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace patina {

class IblCache {
  public:
    static constexpr std::uint64_t kDefaultBytes = std::uint64_t{512}
                                                   << 20; // about 20 environments

    // The folder is made when something is stored. `maxBytes`: what its files may hold together.
    explicit IblCache(std::filesystem::path folder, std::uint64_t maxBytes = kDefaultBytes);

    [[nodiscard]] static Hash key(const Image& environment, const IblSettings& settings);

    // Nothing when there is none. A damaged file is removed with a line in the log. What is found
    // counts as used now.
    [[nodiscard]] std::optional<IblMaps> find(const Hash& key) const;

    // Writes the file at once or not at all, then removes those that were used longest ago until
    // the rest fits. Errors: CannotCreate, Io; the maps are still good.
    Result<void> store(const Hash& key, const IblMaps& maps) const;

    [[nodiscard]] std::filesystem::path file(const Hash& key) const;

  private:
    CacheFolder m_files;
};

} // namespace patina
