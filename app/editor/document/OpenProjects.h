// Which projects are open in which running editor, so that two who work on one file are told before
// one overwrites the other. Marks lie in the user's cache folder, not beside the project: what
// other users or machines do to a file is noticed by what the file holds (SaveTerms::expected).
#pragma once

#include "core/base/FileDescriptor.h"

#include <filesystem>
#include <memory>
#include <string>

namespace patina::editor {

// The mark of one open project, held until the end of this object or of the process. Immutable:
// may be asked from any thread.
class OpenProject {
  public:
    // Where no mark can be made there is none, and nobody is warned.
    [[nodiscard]] static std::shared_ptr<const OpenProject>
    hold(const std::filesystem::path& marks, const std::filesystem::path& project);
    ~OpenProject();
    OpenProject(const OpenProject&) = delete;
    OpenProject& operator=(const OpenProject&) = delete;

    // Who else has it open: "process 4711 on gauss"; empty when nobody has.
    [[nodiscard]] std::string others() const;

  private:
    OpenProject() = default;

    std::filesystem::path m_mark; // of this one, empty: there is none
    std::filesystem::path m_folder;
    FileDescriptor m_lock;
};

} // namespace patina::editor
