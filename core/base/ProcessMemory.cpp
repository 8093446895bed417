#include "core/base/ProcessMemory.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>

namespace patina {
namespace {

std::size_t pageBytes() {
    const long bytes = ::sysconf(_SC_PAGESIZE);
    return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

std::optional<std::uint64_t> number(std::string_view text) {
    std::uint64_t value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc())
        return std::nullopt;
    return value;
}

std::optional<std::uint64_t> firstLine(const std::string& file) {
    std::ifstream stream(file);
    std::string line;
    if (!std::getline(stream, line))
        return std::nullopt;
    return number(line);
}

// "MemAvailable:   12345 kB"
std::optional<std::uint64_t> freeMemory() {
    std::ifstream stream("/proc/meminfo");
    for (std::string word; stream >> word;)
        if (word == "MemAvailable:" && stream >> word)
            if (const auto kibibytes = number(word))
                return *kibibytes << 10;
    return std::nullopt;
}

// Version 2: each group on the way up may set a limit ("0::/a/b" in /proc/self/cgroup).
std::optional<std::uint64_t> freeInGroups() {
    std::ifstream stream("/proc/self/cgroup");
    std::optional<std::uint64_t> least;
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("0::"))
            continue;
        for (std::string group = line.substr(3);; group.resize(group.find_last_of('/'))) {
            const std::string folder = "/sys/fs/cgroup" + (group == "/" ? "" : group);
            const auto limit = firstLine(folder + "/memory.max"); // nothing for "max"
            const auto used = firstLine(folder + "/memory.current");
            if (limit && used)
                least =
                    std::min(least.value_or(~std::uint64_t{0}), *limit - std::min(*limit, *used));
            if (group.size() < 2)
                break;
        }
    }
    return least;
}

} // namespace

std::size_t residentMemory() {
    // Pages: all, resident, shared … (proc(5)).
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0, resident = 0;
    return statm >> all >> resident ? resident * pageBytes() : 0;
}

std::size_t installedMemory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    return pages > 0 ? static_cast<std::size_t>(pages) * pageBytes() : 0;
}

std::uint64_t availableMemory() {
    const std::uint64_t unlimited = ~std::uint64_t{0};
    const std::uint64_t least =
        std::min(freeMemory().value_or(unlimited), freeInGroups().value_or(unlimited));
    return least == unlimited ? 0 : least;
}

} // namespace patina
