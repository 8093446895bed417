#include "app/cli/Allocator.h"

#include "core/base/Log.h"

#include <cerrno>
#include <cstring>
#include <sys/prctl.h>

#ifdef PATINA_JEMALLOC
// Read by jemalloc before main(), which has to find it.
extern "C" {
[[gnu::visibility("default")]] extern const char* malloc_conf;
const char* malloc_conf = "thp:always,metadata_thp:always";
}
#endif

namespace patina::cli {

void useSmallPages() {
    if (::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0) != 0)
        logInfo("Huge pages could not be switched off: {}", std::strerror(errno));
}

} // namespace patina::cli
