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
    // beside the model or in a folder "textures" there, whatever the case, or in the only other
    // folder there that has one. Nothing when no such file is there or it is empty. What is spelled
    // so but lies outside the folder comes before guesses among other folders. A name that is no
    // UTF-8 is taken for Windows-1252 where no file is called by these bytes.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name);
    // Whether the file lies in the model's folder or below, links followed.
    [[nodiscard]] bool isInside(const std::filesystem::path& file) const;
    // Where the file would be expected, for messages and for trying again later.
    [[nodiscard]] std::filesystem::path expected(const std::string& name) const;

  private:
    using Listing = std::map<std::string, std::filesystem::path>; // by lower-case name
    [[nodiscard]] std::optional<std::filesystem::path> findSpelled(const std::string& name);
    const Listing& listing(const std::filesystem::path& folder);

    std::filesystem::path m_folder;
    std::map<std::filesystem::path, Listing> m_listings;
};

} // namespace patina
