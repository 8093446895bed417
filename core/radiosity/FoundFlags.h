// Which of many things have been found, for those who look while others find.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina::radiosity {

class FoundFlags {
  public:
    explicit FoundFlags(std::size_t count = 0)
        : m_flags(count, 0) {}

    [[nodiscard]] std::size_t size() const { return m_flags.size(); }
    // Who sees true also sees what the thread that called set() had written before.
    [[nodiscard]] bool has(std::size_t i) const {
        return std::atomic_ref(m_flags[i]).load(std::memory_order_acquire) != 0;
    }
    void set(std::size_t i) { std::atomic_ref(m_flags[i]).store(1, std::memory_order_release); }

  private:
    mutable std::vector<std::uint8_t> m_flags; // C++20 has no atomic_ref to what is const
};

} // namespace patina::radiosity
