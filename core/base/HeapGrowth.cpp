#include "core/base/HeapGrowth.h"

#include "core/base/Log.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace patina {

void boundHeapGrowth() {
#if defined(__GLIBC__)
    constexpr int kMappedBytes = 256 << 10; // and more: pages of their own
    constexpr int kSlackBytes = 8 << 20;    // free at a heap's end, before it shrinks
    constexpr int kHeaps = 4;               // threads keep small blocks by themselves
    const bool set = mallopt(M_MMAP_THRESHOLD, kMappedBytes) != 0 &&
                     mallopt(M_TRIM_THRESHOLD, kSlackBytes) != 0 &&
                     mallopt(M_ARENA_MAX, kHeaps) != 0;
    if (!set)
        logWarning("The C library refused limits for its heaps; memory may grow with time.");
#endif
}

void returnFreedMemory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

} // namespace patina
