#include "core/document/AbsentBake.h"

namespace patina {

BakeArtifactPtr absentBake(BakeKind kind, const std::string& file) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = kind;
    bake->missingFile = file;
    return bake;
}

bool isAbsent(const BakeArtifact& bake) {
    return !bake.missingFile.empty();
}

} // namespace patina
