// What of a document an export takes along, decided once for the plan and for the run.
#pragma once

#include "core/document/Document.h"
#include "core/export/Export.h"
#include "core/export/NodeTransform.h"
#include "core/export/TexturePacking.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

struct ExportedInstance {
    const MeshInstance* instance = nullptr;
    std::vector<NodeTransform> transform; // nested nodes, outermost first
    int material = -1;                    // index into ExportContents::materials; -1: none
};

// Points into the document it was made from.
struct ExportContents {
    std::vector<ExportedInstance> instances;
    std::vector<const Material*> materials; // used by an instance
    std::vector<const Light*> lights;
    const Environment* environment = nullptr; // its light is exported
    TexturePlan textures;
    std::filesystem::path buffer; // of a .gltf: the .bin beside it; empty for GLB
    std::vector<std::string> warnings;

    // Where a texture goes: the file beside a .gltf, "OUT.glb#NAME" inside a GLB.
    [[nodiscard]] std::filesystem::path texturePath(const ExportSettings& settings,
                                                    const PackedTexture& texture) const;
    // The images of the environment always lie in the buffer.
    [[nodiscard]] std::filesystem::path environmentPath(const ExportSettings& settings) const;
};

[[nodiscard]] ExportContents gatherContents(const Document& document,
                                            const ExportSettings& settings);

} // namespace patina
