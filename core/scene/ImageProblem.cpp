#include "core/scene/ImageProblem.h"

#include "core/base/InputFile.h"
#include "core/base/Utf8.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"
#include "core/scene/OutsidePictures.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace patina {
namespace {

template <class Visit>
void forEachProblem(const Document& document, Id material, const Visit& visit) {
    for (const ParameterInfo& info : parameters()) {
        if (info.scope != Scope::Material || info.type != ParameterType::Map)
            continue;
        const MapSlot slot = std::get<MapSlot>(info.get(document, material));
        if (!slot.problem.empty())
            visit(info, slot);
    }
}

} // namespace

std::string problemWord(std::string_view problem) {
    if (problem == kNoSuchFile)
        return "missing";
    if (problem == kOutsideProblem || problem == kOutsideProjectProblem)
        return "left out";
    // The other refusals of openInputFile() to read what is there.
    for (const std::string_view begin :
         {"the file cannot be", "this is a folder", "this is a pipe"})
        if (problem.starts_with(begin))
            return "unreadable";
    return "damaged";
}

std::string environmentProblem(const Environment& environment) {
    if (environment.kind != EnvironmentKind::Image || environment.problem.empty())
        return {};
    return fmt::format("{} is {}", std::filesystem::path(environment.source).filename().string(),
                       problemWord(environment.problem));
}

std::vector<std::string> damagedMaps(const Document& document) {
    std::vector<std::string> sources;
    for (const Material& material : document.materials)
        forEachProblem(document, material.id, [&](const ParameterInfo&, const MapSlot& slot) {
            const std::string word = problemWord(slot.problem);
            if (word != "missing" && word != "left out" &&
                std::find(sources.begin(), sources.end(), slot.source) == sources.end())
                sources.push_back(slot.source);
        });
    return sources;
}

std::vector<std::string> mapProblems(const Document& document, Id material) {
    std::vector<std::string> lines;
    forEachProblem(document, material, [&](const ParameterInfo& info, const MapSlot& slot) {
        lines.push_back(
            fmt::format("{} is {}: {}", info.label, problemWord(slot.problem),
                        makeValidUtf8(std::filesystem::path(slot.source).filename().string())));
    });
    return lines;
}

} // namespace patina
