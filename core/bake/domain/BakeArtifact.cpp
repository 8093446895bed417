#include "core/bake/domain/BakeArtifact.h"

namespace patina {
namespace {

template <class Bake>
std::size_t numberBytes(const Bake& bake) {
    return sizeof(float) *
           (bake.values.size() + bake.bounced.size() + bake.sky.size() + bake.error.size());
}

} // namespace

std::size_t artifactBytes(const BakeArtifact& bake) {
    std::size_t bytes = 0;
    for (const VertexBake& vertices : bake.vertices)
        bytes += numberBytes(vertices);
    for (const TexelBake& texels : bake.texels)
        bytes += numberBytes(texels) + (texels.image ? texels.image->bytes().size() : 0);
    return bytes;
}

} // namespace patina
