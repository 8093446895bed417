#include "core/base/FreedMemory.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace patina {

void returnFreedMemory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

} // namespace patina
