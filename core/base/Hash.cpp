#include "core/base/Hash.h"

#include "core/base/Check.h"

#include <bit>
#include <xxhash.h>

namespace patina {

std::string Hash::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

struct Hasher::State {
    XXH3_state_t* xxh = XXH3_createState();
    ~State() { XXH3_freeState(xxh); }
};

Hasher::Hasher()
    : m_state(std::make_unique<State>()) {
    CHECK(m_state->xxh != nullptr);
    XXH3_128bits_reset(m_state->xxh);
}

Hasher::~Hasher() = default;

Hasher& Hasher::bytes(std::span<const std::byte> data) {
    const std::uint64_t size = data.size();
    XXH3_128bits_update(m_state->xxh, &size, sizeof size);
    XXH3_128bits_update(m_state->xxh, data.data(), data.size());
    return *this;
}

Hasher& Hasher::text(std::string_view value) {
    return bytes(std::as_bytes(std::span(value.data(), value.size())));
}

// +0 and -0 are equal values and must hash alike.
Hasher& Hasher::value(float v) {
    return value(std::bit_cast<std::uint32_t>(v == 0.0f ? 0.0f : v));
}

Hasher& Hasher::value(double v) {
    return value(std::bit_cast<std::uint64_t>(v == 0.0 ? 0.0 : v));
}

Hash Hasher::finish() const {
    const XXH128_hash_t digest = XXH3_128bits_digest(m_state->xxh);
    return {digest.high64, digest.low64};
}

Hash hashBytes(std::span<const std::byte> data) {
    const XXH128_hash_t digest = XXH3_128bits(data.data(), data.size());
    return {digest.high64, digest.low64};
}

} // namespace patina
