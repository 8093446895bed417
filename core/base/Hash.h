// A 128-bit content hash (XXH3) that names what a bake, cache entry or picture was made from.
// Not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace patina {

struct Hash {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend bool operator==(const Hash&, const Hash&) = default;
    [[nodiscard]] std::string hex() const; // 32 lower-case digits
};

// Feeds values one after another; the order and the sizes of the values are part of the hash.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& bytes(std::span<const std::byte> data); // the length goes in first
    Hasher& text(std::string_view value);
    template <class T>
    requires std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T> Hasher&
    value(const T& v) {
        return bytes(std::as_bytes(std::span<const T>(&v, 1)));
    }
    Hasher& value(float v);
    Hasher& value(double v);
    template <class T>
    requires std::is_trivially_copyable_v<T> Hasher& array(std::span<const T> values) {
        return bytes(std::as_bytes(values));
    }

    [[nodiscard]] Hash finish() const;

  private:
    struct State;
    std::unique_ptr<State> m_state;
};

[[nodiscard]] Hash hashBytes(std::span<const std::byte> data);

} // namespace patina
