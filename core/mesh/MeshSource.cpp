#include "core/mesh/MeshSource.h"

#include "core/base/Check.h"

#include <numeric>
#include <utility>

namespace patina {

namespace {

struct Owner {
    MeshSource source;
    void operator()(const Mesh* mesh) const { delete mesh; }
};

} // namespace

std::shared_ptr<Mesh> withSource(Mesh mesh, MeshSource source) {
    CHECK_EQ(source.vertices.size(), mesh.positions.size());
    return {new Mesh(std::move(mesh)), Owner{std::move(source)}};
}

std::shared_ptr<Mesh> withOwnVertices(Mesh mesh, int number) {
    MeshSource source;
    source.mesh = number;
    source.vertices.resize(mesh.positions.size());
    std::iota(source.vertices.begin(), source.vertices.end(), 0u);
    return withSource(std::move(mesh), std::move(source));
}

const MeshSource* meshSource(const MeshPtr& mesh) {
    const Owner* owner = std::get_deleter<Owner>(mesh);
    return owner != nullptr ? &owner->source : nullptr;
}

MeshRepairs sanitizeMesh(const std::shared_ptr<Mesh>& mesh) {
    Owner* owner = std::get_deleter<Owner>(mesh);
    return owner != nullptr ? sanitizeMesh(*mesh, owner->source.vertices) : sanitizeMesh(*mesh);
}

void addUse(const MeshPtr& mesh, const MeshSource::Use& use) {
    if (Owner* owner = std::get_deleter<Owner>(mesh))
        owner->source.uses.push_back(use);
}

} // namespace patina
