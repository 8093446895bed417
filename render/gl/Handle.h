// A move-only OpenGL name: zero when empty, deleted with its owner.
#pragma once

#include <utility>

namespace patina::gl {

template <void (*Delete)(unsigned)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(unsigned id)
        : m_id(id) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept
        : m_id(std::exchange(other.m_id, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            m_id = std::exchange(other.m_id, 0);
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    [[nodiscard]] unsigned id() const { return m_id; }

  private:
    void reset() {
        if (m_id != 0)
            Delete(std::exchange(m_id, 0));
    }
    unsigned m_id = 0;
};

} // namespace patina::gl
