#include "core/mesh/UvUnwrap.h"

#include "core/base/Check.h"
#include "core/mesh/BoxProjection.h"

namespace patina {

void unwrapUvs(Mesh& mesh, const UnwrapSettings& settings) {
    CHECK_LT(0, settings.resolution);
    if (mesh.indices.empty()) {
        mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
        return;
    }
    boxProjectUvs(mesh);
}

bool hasOverlappingUvs(const Mesh& mesh, int resolution) {
    CHECK_LT(0, resolution);
    return mesh.uvs.empty();
}

} // namespace patina
