// What of a document a glTF export takes along.
#pragma once

#include "core/document/Document.h"
#include "core/export/Export.h"
#include "core/export/LightMapExport.h"
#include "core/export/NodeTransform.h"
#include "core/export/TexturePacking.h"
#include "core/export/TransferExport.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct ExportedInstance {
    const MeshInstance* instance = nullptr;
    std::vector<NodeTransform> transform; // nested nodes, outermost first
    int material = -1;                    // index into ExportContents::materials; -1: none
    const VertexBake* transfer = nullptr;
    const LitVertices* light = nullptr;
    std::vector<int> variants{}; // of each of ExportContents::variants the material; -1: `material`
};

struct ExportedLightMap {
    int material = -1; // index into ExportContents::materials
    const TexelBake* texels = nullptr;
    std::array<std::filesystem::path, kLightMapParts.size()> paths; // of its files
};

// Points into the document it was made from.
struct ExportContents {
    std::vector<ExportedInstance> instances;
    std::vector<const Material*> materials; // used by an instance
    std::vector<std::string> variants;      // their names; empty: none are written
    std::vector<const Light*> lights;
    std::shared_ptr<const Environment> environment; // of the mix, its light is exported; or null
    BakeArtifactPtr transfer;                       // or null
    TransferLayout transferLayout;                  // of it
    std::vector<ExportedLightMap> lightMaps;        // baked
    TexturePlan textures;
    std::filesystem::path buffer; // of a .gltf: the .bin beside it; empty for GLB
    std::vector<std::string> warnings;

    // Where a texture goes: the file beside a .gltf, "OUT.glb#NAME" inside a GLB.
    [[nodiscard]] std::filesystem::path texturePath(const ExportSettings& settings,
                                                    const PackedTexture& texture) const;
    // The light and the shader of transfer, files beside the scene.
    [[nodiscard]] std::filesystem::path transferLightPath(const ExportSettings& settings) const;
    [[nodiscard]] std::filesystem::path transferShaderPath(const ExportSettings& settings) const;
    // The shader of a baked light map, a file beside the scene.
    [[nodiscard]] std::filesystem::path lightMapShaderPath(const ExportSettings& settings) const;
    // The images of the environment always lie in the buffer.
    [[nodiscard]] std::filesystem::path environmentPath(const ExportSettings& settings) const;
};

[[nodiscard]] ExportContents gatherContents(const Document& document,
                                            const ExportSettings& settings);

} // namespace patina
