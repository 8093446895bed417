#include "render/gl/GpuMemory.h"

#include <atomic>
#include <utility>

namespace patina::gl {
namespace {

std::atomic<std::size_t>& counterOf(GpuUse use) {
    static std::atomic<std::size_t> textures{0}, buffers{0};
    return use == GpuUse::Texture ? textures : buffers;
}

} // namespace

GpuMemory gpuMemory() {
    return {counterOf(GpuUse::Texture).load(), counterOf(GpuUse::Buffer).load()};
}

CountedBytes::CountedBytes(GpuUse use, std::size_t bytes)
    : m_use(use)
    , m_bytes(bytes) {
    counterOf(use) += bytes;
}

CountedBytes::CountedBytes(CountedBytes&& other) noexcept
    : m_use(other.m_use)
    , m_bytes(std::exchange(other.m_bytes, 0)) {}

CountedBytes& CountedBytes::operator=(CountedBytes&& other) noexcept {
    std::swap(m_use, other.m_use);
    std::swap(m_bytes, other.m_bytes);
    return *this;
}

CountedBytes::~CountedBytes() {
    counterOf(m_use) -= m_bytes;
}

} // namespace patina::gl
