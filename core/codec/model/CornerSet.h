// A set of the numbers 0 … count - 1 that finds the next one in it quickly: bits, 64 of which each
// bit of the level above stands for.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace patina::codec {

class CornerSet {
  public:
    explicit CornerSet(std::size_t count) {
        do {
            count = (count + 63) / 64;
            m_levels.emplace_back(count, 0);
        } while (count > 1);
    }

    void insert(std::size_t i) {
        for (std::vector<std::uint64_t>& level : m_levels) {
            level[i / 64] |= std::uint64_t{1} << (i % 64);
            i /= 64;
        }
    }

    void erase(std::size_t i) {
        for (std::vector<std::uint64_t>& level : m_levels) {
            level[i / 64] &= ~(std::uint64_t{1} << (i % 64));
            if (level[i / 64] != 0)
                return;
            i /= 64;
        }
    }

    // The least member that is not below `from`; else the least of all.
    [[nodiscard]] std::optional<std::uint32_t> nextInCircle(std::size_t from) const {
        const std::optional<std::uint32_t> next = atLeast(from);
        return next ? next : atLeast(0);
    }

  private:
    [[nodiscard]] std::optional<std::uint32_t> atLeast(std::size_t from) const {
        // Up until a word holds a bit that is far enough, then down along the lowest ones.
        for (std::size_t up = 0; up < m_levels.size(); ++up) {
            const std::size_t word = from / 64;
            if (word >= m_levels[up].size())
                return std::nullopt;
            const std::uint64_t bits = m_levels[up][word] & (~std::uint64_t{0} << (from % 64));
            if (bits == 0) {
                from = word + 1;
                continue;
            }
            std::size_t found = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
            for (std::size_t down = up; down-- > 0;)
                found =
                    found * 64 + static_cast<std::size_t>(std::countr_zero(m_levels[down][found]));
            return static_cast<std::uint32_t>(found);
        }
        return std::nullopt;
    }

    std::vector<std::vector<std::uint64_t>> m_levels;
};

} // namespace patina::codec
