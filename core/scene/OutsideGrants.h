// Which files outside its own folder a project may show (OutsidePictures.h): those that were shown
// when this user saved it on this machine, and those that the user has agreed to. Kept for each
// project, file by file, in the user's state folder, never in the project: what somebody else adds
// to a project, or sends in its place, is not among them.
#pragma once

#include "core/base/Result.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace patina {

// $XDG_STATE_HOME (~/.local/state) with /Patina/outside-pictures.json. Empty where there is neither
// this variable nor a home: nothing is kept then, and each start asks anew.
[[nodiscard]] std::filesystem::path outsideGrantsFile();

[[nodiscard]] std::set<std::string> outsideGrants(const std::filesystem::path& project,
                                                  const std::filesystem::path& kept);
// Adds files (absolute paths). Of many projects those that were added to last are kept.
Result<void> grantOutside(const std::filesystem::path& project,
                          const std::vector<std::string>& files, const std::filesystem::path& kept,
                          std::size_t mostProjects = 500);

} // namespace patina
