#include "app/worker/Landlock.h"

#include "core/base/FileDescriptor.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sys/syscall.h>
#include <unistd.h>

namespace patina::worker {

namespace {

// As the kernel of today knows it; Debian 12's header ends after the first member.
struct Ruleset {
    std::uint64_t files = 0;  // since version 1
    std::uint64_t ports = 0;  // since 4
    std::uint64_t scopes = 0; // since 6
};
constexpr std::uint32_t kAskForVersion = 1;

constexpr std::uint64_t lowestBits(int count) {
    return (std::uint64_t{1} << count) - 1;
}

// Each version's rights, all of which are given up: there is no rule that would grant one.
Ruleset everything(int version) {
    const int files = version < 2 ? 13 : version < 3 ? 14 : version < 5 ? 15 : 16;
    return {lowestBits(files), version < 4 ? 0 : lowestBits(2), version < 6 ? 0 : lowestBits(2)};
}

std::size_t sizeOf(int version) {
    return version < 4   ? offsetof(Ruleset, ports)
           : version < 6 ? offsetof(Ruleset, scopes)
                         : sizeof(Ruleset);
}

} // namespace

int landlockVersion() {
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskForVersion);
    return version < 0 ? 0 : static_cast<int>(version);
}

std::string giveUpFiles(int version) {
    const Ruleset rules = everything(version);
    const FileDescriptor ruleset(
        static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeOf(version), 0)));
    if (!ruleset.valid() || ::syscall(SYS_landlock_restrict_self, ruleset.get(), 0) != 0)
        return std::string("landlock: ") + std::strerror(errno);
    return {};
}

} // namespace patina::worker
