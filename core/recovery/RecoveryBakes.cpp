#include "core/recovery/RecoveryBakes.h"

#include "core/bake/document/BakeCache.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/document/Document.h"
#include "core/material/Material.h"

#include <algorithm>
#include <limits>
#include <system_error>
#include <unordered_set>
#include <vector>

namespace patina {
namespace {

namespace fs = std::filesystem;

// The folder is bounded by who writes to it: nothing may be dropped that a record names.
BakeCache cacheIn(const fs::path& folder) {
    return BakeCache(folder, std::numeric_limits<std::uint64_t>::max());
}

// By which elements are numbered in the file: all meshes, hidden ones too.
BakeInputs elementsOf(const Document& document) {
    BakeInputs inputs;
    for (const MeshInstance& instance : document.meshes)
        inputs.meshes.push_back({instance.id,
                                 instance.material,
                                 instance.mesh,
                                 instance.placement.matrix(),
                                 false,
                                 {}});
    return inputs;
}

bool holdsAllOf(const Document& document, const BakeArtifact& artifact) {
    std::unordered_set<Id> meshes, materials;
    for (const MeshInstance& instance : document.meshes) {
        meshes.insert(instance.id);
        materials.insert(instance.material);
    }
    return std::ranges::all_of(
               artifact.vertices,
               [&](const VertexBake& bake) { return meshes.contains(bake.mesh); }) &&
           std::ranges::all_of(artifact.texels, [&](const TexelBake& bake) {
               return materials.contains(bake.material);
           });
}

template <class Visit>
void forEachArray(const BakeArtifact& artifact, const Visit& visit) {
    for (const VertexBake& bake : artifact.vertices)
        for (const auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            visit(std::as_bytes(std::span(*values)));
    for (const TexelBake& bake : artifact.texels) {
        for (const auto* values : {&bake.values, &bake.bounced, &bake.sky, &bake.error})
            visit(std::as_bytes(std::span(*values)));
        visit(bake.image ? bake.image->bytes() : std::span<const std::byte>());
    }
}

} // namespace

Hash hashBake(const BakeArtifact& artifact) {
    Hasher hasher;
    hasher.value(artifact.kind).value(artifact.inputs).value(artifact.albedo);
    for (const auto& [name, text] : recordOf(artifact))
        hasher.text(name).text(text);
    hasher.value(artifact.order).value(artifact.transfer).value(artifact.bounces);
    hasher.value(artifact.samplesDone);
    for (const VertexBake& bake : artifact.vertices)
        hasher.value(bake.mesh).value(bake.stride);
    for (const TexelBake& bake : artifact.texels)
        hasher.value(bake.material).value(bake.side).value(bake.stride);
    forEachArray(artifact, [&](std::span<const std::byte> bytes) { hasher.bytes(bytes); });
    return hasher.finish();
}

Result<void> keepBake(const fs::path& folder, const Hash& content, const BakeArtifact& artifact,
                      const Document& document) {
    if (!holdsAllOf(document, artifact))
        return Error{ErrorKind::Usage, "it is of meshes that were removed since", {}, {}};
    return cacheIn(folder).store(content, elementsOf(document), artifact);
}

std::optional<BakeArtifact> keptBake(const fs::path& folder, const Hash& content,
                                     const Document& document) {
    return cacheIn(folder).find(content, elementsOf(document));
}

void removeBakesExcept(const fs::path& folder, std::span<const Hash> kept) {
    const BakeCache cache = cacheIn(folder);
    std::vector<fs::path> files, old;
    for (const Hash& hash : kept)
        files.push_back(cache.file(hash));
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (std::ranges::find(files, entry->path()) == files.end() &&
            entry->path().extension() != ".part") // which is being written
            old.push_back(entry->path());
    for (const fs::path& file : old)
        fs::remove(file, error);
}

} // namespace patina
