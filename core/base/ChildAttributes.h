// How the programs that Patina starts run: signal handling begins with the defaults, and in a
// session of its own: no terminal is within reach, and Ctrl+C comes to Patina first.
#pragma once

#include <csignal>
#include <spawn.h>

namespace patina {

// For posix_spawn().
class ChildAttributes {
  public:
    ChildAttributes() {
        posix_spawnattr_init(&m_attributes);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&m_attributes, &none);
        posix_spawnattr_setsigdefault(&m_attributes, &all);
        posix_spawnattr_setflags(&m_attributes,
                                 static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                    POSIX_SPAWN_SETSID));
    }
    ~ChildAttributes() { posix_spawnattr_destroy(&m_attributes); }
    ChildAttributes(const ChildAttributes&) = delete;
    ChildAttributes& operator=(const ChildAttributes&) = delete;

    [[nodiscard]] const posix_spawnattr_t* get() const { return &m_attributes; }

  private:
    posix_spawnattr_t m_attributes{};
};

} // namespace patina
