#include "core/base/Leftovers.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace patina {

namespace fs = std::filesystem;

namespace {

// Whether `name` is that of a temporary file (AtomicFile.cpp: .NAME.PID.part) of a process that
// runs no more.
bool isLeftover(std::string_view name, std::string_view prefix) {
    constexpr std::string_view kEnd = ".part";
    if (!name.starts_with(prefix) || !name.ends_with(kEnd) ||
        name.size() <= prefix.size() + kEnd.size())
        return false;
    const std::string_view digits =
        name.substr(prefix.size(), name.size() - prefix.size() - kEnd.size());
    pid_t process = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), process);
    return error == std::errc() && end == digits.data() + digits.size() && process > 0 &&
           ::kill(process, 0) != 0 && errno == ESRCH;
}

} // namespace

void removeLeftovers(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const std::string prefix = fmt::format(".{}.", path.filename().string().substr(0, 200));
    std::vector<fs::path> leftovers;
    std::error_code error; // what cannot be listed or removed stays: it harms nobody
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (isLeftover(entry->path().filename().string(), prefix))
            leftovers.push_back(entry->path());
    for (const fs::path& leftover : leftovers)
        fs::remove(leftover, error);
}

} // namespace patina
