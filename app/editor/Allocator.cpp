#include "app/editor/Allocator.h"

#include "core/base/Log.h"

#ifdef PATINA_JEMALLOC
#include <jemalloc/jemalloc.h>
#endif

namespace patina::editor {

#ifdef PATINA_JEMALLOC
namespace {

template <typename T>
bool set(const char* name, T value) {
    return mallctl(name, nullptr, nullptr, &value, sizeof(value)) == 0;
}

} // namespace

void prepareAllocator() {
    constexpr ssize_t kMs = kFreedMemoryMs;
    // Of heaps to come, and of the one that is there before there are threads.
    const bool done = set("arenas.dirty_decay_ms", kMs) && set("arenas.muzzy_decay_ms", kMs) &&
                      set("arena.0.dirty_decay_ms", kMs) && set("arena.0.muzzy_decay_ms", kMs) &&
                      set("background_thread", true);
    if (!done)
        logWarning("The allocator refused its settings; memory may grow with time.");
}
#else
void prepareAllocator() {}
#endif

} // namespace patina::editor
