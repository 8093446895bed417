// The files a model may read while it is decoded: itself and what lies in its folder or below. The
// child has no others (core/worker/GuestRequests.h); here is said which one a path means.
#pragma once

#include "core/worker/MemoryFile.h"

#include <filesystem>
#include <optional>
#include <string>

namespace patina::codec {

class ModelFolder {
  public:
    // `folder` is canonical; `modelName` is the name under which the open model file appears there.
    ModelFolder(std::filesystem::path folder, std::string modelName, int modelFd);

    [[nodiscard]] const std::filesystem::path& folder() const { return m_folder; }
    [[nodiscard]] std::filesystem::path modelPath() const { return m_folder / m_modelName; }

    // A relative or absolute path, read-only. Nothing when the file is missing, lies outside or is
    // no regular file.
    [[nodiscard]] std::optional<MemoryFile> open(const std::string& path) const;

  private:
    std::filesystem::path m_folder;
    std::string m_modelName;
    int m_modelFd;
};

// "a%20b.bin" → "a b.bin": references in glTF are URIs.
[[nodiscard]] std::string decodePercent(const std::string& uri);

} // namespace patina::codec
