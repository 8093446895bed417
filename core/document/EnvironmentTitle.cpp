#include "core/document/EnvironmentTitle.h"

#include "core/base/PrintableText.h"
#include "core/document/Source.h"

#include <cctype>
#include <filesystem>

namespace patina {
namespace {

// "clear-sky" is called "Clear Sky" in the library.
std::string titleOfBuiltin(std::string name) {
    bool begins = true;
    for (char& c : name) {
        if (c == '-')
            c = ' ';
        else if (begins)
            c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        begins = c == ' ';
    }
    return name;
}

} // namespace

std::string environmentTitle(const Environment& environment) {
    if (!environment.name.empty())
        return printableLine(environment.name);
    if (environment.kind == EnvironmentKind::Sky)
        return "Sky";
    if (environment.kind == EnvironmentKind::Softboxes)
        return "Softboxes";
    const std::string title =
        isBuiltin(environment.source)
            ? titleOfBuiltin(builtinName(environment.source))
            : printableLine(std::filesystem::path(environment.source).stem().string());
    return title.empty() ? "Environment" : title;
}

} // namespace patina
