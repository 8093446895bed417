// Files that belong together and are written together: all of them or none. Private to this module.
#pragma once

#include "core/base/AtomicFile.h"

#include <filesystem>
#include <vector>

namespace patina {

class FilesTogether {
  public:
    // `named`: the one whose name the user chose; a link there is followed.
    explicit FilesTogether(std::filesystem::path named)
        : m_named(std::move(named)) {}

    // In the order in which they are written: what names others after them.
    void add(std::filesystem::path file, Bytes data);
    // Returns their paths. When one cannot be written, those before it are as they were, or gone
    // again. Errors: CannotCreate, Io; InputMissing for one that is there and cannot be read.
    [[nodiscard]] Result<std::vector<std::filesystem::path>> write() const;

  private:
    struct File {
        std::filesystem::path path;
        Bytes data;
    };
    std::filesystem::path m_named;
    std::vector<File> m_files;
};

// Whether a name that a file gives is that of another in the same folder or below.
[[nodiscard]] bool liesBeside(const std::filesystem::path& name);
// Whether both are there and are the same.
[[nodiscard]] bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace patina
