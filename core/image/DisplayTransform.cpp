#include "core/image/DisplayTransform.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace patina {

std::string openColorIoConfig(const std::string& chosen) {
    std::string file = chosen;
    if (file.empty())
        if (const char* variable = std::getenv("OCIO"))
            file = variable;
    if (file.empty())
        return {};
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    return error ? file : absolute.string();
}

} // namespace patina
