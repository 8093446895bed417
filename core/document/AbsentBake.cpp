#include "core/document/AbsentBake.h"

namespace patina {
namespace {

constexpr const char* kFile = "absentFile"; // no option of a bake is called so

} // namespace

BakeArtifactPtr absentBake(BakeKind kind, const std::string& file) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = kind;
    bake->settings[kFile] = file;
    return bake;
}

bool isAbsent(const BakeArtifact& bake) {
    return !absentFile(bake).empty();
}

std::string absentFile(const BakeArtifact& bake) {
    const auto file = bake.settings.find(kFile);
    const bool empty = bake.vertices.empty() && bake.texels.empty();
    return empty && file != bake.settings.end() ? file->second : std::string();
}

} // namespace patina
