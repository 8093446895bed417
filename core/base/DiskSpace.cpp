#include "core/base/DiskSpace.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;

std::string sizeText(std::uint64_t bytes) {
    const double mebibytes = static_cast<double>(bytes) / (1024.0 * 1024.0);
    return mebibytes < 1000.0 ? fmt::format("{:.1f} MiB", mebibytes)
                              : fmt::format("{:.1f} GiB", mebibytes / 1024.0);
}

} // namespace

std::optional<std::uint64_t> freeDiskBytes(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(path, error); // where links lead
    if (error)
        return std::nullopt;
    const fs::file_status status = fs::status(target, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        return std::nullopt;
    const fs::space_info space = fs::space(target.parent_path(), error);
    if (error || space.available == static_cast<std::uintmax_t>(-1))
        return std::nullopt;
    return space.available;
}

Result<void> checkDiskSpace(const fs::path& path, std::uint64_t bytes, std::uint64_t largestFile) {
    const auto refuse = [&](const char* what, std::uint64_t wanted, std::uint64_t available) {
        return Error{ErrorKind::Io,
                     fmt::format("{} up to {}, and {} can be written there; free some space or "
                                 "choose another place",
                                 what, sizeText(wanted), sizeText(available)),
                     path,
                     {}};
    };
    const std::optional<std::uint64_t> available = freeDiskBytes(path);
    if (!available) // a device takes what it takes
        return {};
    if (bytes > *available)
        return refuse("this takes", bytes, *available);
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        largestFile > limit.rlim_cur)
        return refuse("a file of this takes", largestFile, limit.rlim_cur);
    return {};
}

} // namespace patina
