// Stands for an OpenGL driver that does not fit the system: it ends the process that loads it.

#include <cstdlib>

namespace {

struct Crash {
    Crash() { std::abort(); }
} crash;

} // namespace
