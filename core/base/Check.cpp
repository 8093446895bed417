#include "core/base/Check.h"

#include <cstdio>
#include <cstdlib>

namespace patina::detail {

void checkFailed(const char* file, int line, const char* expression, const std::string& operands) {
    std::fprintf(stderr, "%s:%d: check failed: %s%s%s\n", file, line, expression,
                 operands.empty() ? "" : ": ", operands.c_str());
    std::fflush(stderr);
    std::abort();
}

} // namespace patina::detail
