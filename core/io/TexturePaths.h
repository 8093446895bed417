// Finding the texture files a model names: on the artist's other computer, with backslashes, in
// another case, or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace patina {

class TexturePaths {
  public:
    // `folder` is the absolute folder of the model.
    explicit TexturePaths(std::filesystem::path folder)
        : m_folder(std::move(folder)) {}

    // The file `name` stands for: as spelled (relative to the model), otherwise by its base name
    // beside the model or in a folder "textures" there, whatever the case. Nothing when no such
    // file is there or it is empty. What lies outside the folder comes last.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name);
    // Whether the file lies in the model's folder or below, links followed.
    [[nodiscard]] bool isInside(const std::filesystem::path& file) const;
    // Where the file would be expected, for messages and for trying again later.
    [[nodiscard]] std::filesystem::path expected(const std::string& name) const;

  private:
    using Listing = std::map<std::string, std::filesystem::path>; // by lower-case name
    const Listing& listing(const std::filesystem::path& folder);

    std::filesystem::path m_folder;
    std::map<std::filesystem::path, Listing> m_listings;
};

} // namespace patina
