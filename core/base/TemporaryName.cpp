#include "core/base/TemporaryName.h"

#include "core/base/Hash.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <sys/random.h>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnd = ".part";
constexpr std::size_t kMaxName = 200; // with what is added it stays below the 255 bytes of a name

// Eight digits that tell machines apart which share a drive.
std::string hostTag() {
    std::array<char, 256> name{};
    static_cast<void>(::gethostname(name.data(), name.size() - 1)); // empty is as good as any
    const std::string_view host = name.data();
    return hashBytes(std::as_bytes(std::span(host.data(), host.size()))).hex().substr(0, 8);
}

std::uint64_t randomNumber() {
    static std::atomic<std::uint64_t> counter{0};
    std::uint64_t value = 0;
    // Without entropy yet (early at boot) the clock and a counter have to do.
    if (::getrandom(&value, sizeof value, GRND_NONBLOCK) != static_cast<ssize_t>(sizeof value))
        value =
            static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    return value + ++counter;
}

} // namespace

fs::path temporaryPath(const fs::path& path) {
    return path.parent_path() / fmt::format(".{}.{}-{}-{:016x}{}",
                                            path.filename().string().substr(0, kMaxName),
                                            ::getpid(), hostTag(), randomNumber(), kEnd);
}

bool isAbandoned(std::string_view name, std::string_view finalName) {
    if (!name.starts_with('.') || !name.ends_with(kEnd))
        return false;
    name = name.substr(1, name.size() - 1 - kEnd.size());
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot == 0 ||
        (!finalName.empty() && name.substr(0, dot) != finalName.substr(0, kMaxName)))
        return false;
    std::string_view tag = name.substr(dot + 1);
    pid_t process = 0;
    const auto [end, error] = std::from_chars(tag.data(), tag.data() + tag.size(), process);
    if (error != std::errc() || process <= 0)
        return false;
    tag.remove_prefix(static_cast<std::size_t>(end - tag.data()));
    // Earlier versions named the process alone.
    const bool ours =
        tag.empty() || (tag.size() == 26 && tag.substr(0, 10) == fmt::format("-{}-", hostTag()));
    return ours && ::kill(process, 0) != 0 && errno == ESRCH;
}

} // namespace patina
