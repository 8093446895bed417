#include "core/codec/Codec.h"

#include "core/base/Limits.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace patina::codec {

MemoryFile allocate(std::size_t size) {
    auto file = MemoryFile::create(size);
    if (!file)
        throw std::bad_alloc();
    return std::move(*file);
}

MemoryFile mapFile(int fd) {
    struct stat status {};
    FileDescriptor copy(::fcntl(fd, F_DUPFD_CLOEXEC, 0));
    if (!copy.valid() || ::fstat(fd, &status) != 0)
        throw std::bad_alloc();
    auto file = MemoryFile::open(std::move(copy), static_cast<std::size_t>(status.st_size), false);
    if (!file)
        throw std::bad_alloc();
    return std::move(*file);
}

void checkImageSize(long long width, long long height, long long channels, std::size_t sampleSize) {
    if (width <= 0 || height <= 0 || channels <= 0)
        throw Refusal("the file claims a size that makes no sense; it is damaged",
                      fmt::format("{} x {} x {}", width, height, channels));
    if (width > limits::kMaxImageSide || height > limits::kMaxImageSide)
        throw Refusal(fmt::format("the image has {} x {} pixels; the largest supported side is {}",
                                  width, height, limits::kMaxImageSide));
    if (channels > limits::kMaxImageChannels)
        throw Refusal(fmt::format("the image has {} channels; at most {} are supported", channels,
                                  limits::kMaxImageChannels));
    const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                       static_cast<std::size_t>(channels) * sampleSize;
    if (bytes > limits::kMaxImageBytes)
        throw Refusal(fmt::format("the image needs {} MiB of memory; at most {} MiB are supported",
                                  bytes >> 20, limits::kMaxImageBytes >> 20));
}

std::string toJsonText(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace patina::codec
