#include "app/editor/document/OpenProjects.h"

#include "core/base/Hash.h"
#include "core/base/TemporaryName.h"

#include <array>
#include <fcntl.h>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace patina::editor {
namespace {

namespace fs = std::filesystem;

std::string self() {
    std::array<char, 256> host{};
    static_cast<void>(::gethostname(host.data(), host.size() - 1)); // only to be shown
    return fmt::format("process {} on {}", ::getpid(), host.data());
}

// One folder for each project, whatever links lead to it.
fs::path folderOf(const fs::path& marks, const fs::path& project) {
    std::error_code error;
    fs::path canonical = fs::weakly_canonical(project, error);
    const std::string name = error ? project.string() : canonical.string();
    return marks / hashBytes(std::as_bytes(std::span(name.data(), name.size()))).hex();
}

} // namespace

std::shared_ptr<const OpenProject> OpenProject::hold(const fs::path& marks,
                                                     const fs::path& project) {
    std::shared_ptr<OpenProject> result(new OpenProject);
    result->m_folder = folderOf(marks, project);
    std::error_code error;
    fs::create_directories(result->m_folder, error);
    // Locked before it gets the name under which others find it: they remove what nobody holds.
    const fs::path draft = temporaryPath(result->m_folder / "mark");
    FileDescriptor file(
        ::open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!file.valid())
        return result;
    const std::string text = self();
    const fs::path mark =
        result->m_folder / draft.filename().string().substr(1); // no longer hidden
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 ||
        ::write(file.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
        ::rename(draft.c_str(), mark.c_str()) != 0) {
        ::unlink(draft.c_str());
        return result;
    }
    result->m_mark = mark;
    result->m_lock = std::move(file);
    return result;
}

OpenProject::~OpenProject() {
    if (m_mark.empty())
        return;
    ::unlink(m_mark.c_str());
    ::rmdir(m_folder.c_str()); // unless others are in it
}

std::string OpenProject::others() const {
    std::string holder;
    std::error_code error;
    for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path() == m_mark || entry->path().filename().string().starts_with('.'))
            continue;
        const FileDescriptor file(
            ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
        if (!file.valid())
            continue;
        if (::flock(file.get(), LOCK_SH | LOCK_NB) == 0) { // its process has ended
            ::unlink(entry->path().c_str());
            continue;
        }
        std::array<char, 300> text{};
        const ssize_t count = ::pread(file.get(), text.data(), text.size(), 0);
        holder = count > 0 ? std::string(text.data(), static_cast<std::size_t>(count))
                           : std::string("another process");
    }
    return holder;
}

} // namespace patina::editor
