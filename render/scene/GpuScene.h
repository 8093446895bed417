// The document on the GPU. This is the only way data gets there: snapshots go in, things to draw
// come out. What a snapshot has in common with the one before stays as it is.
#pragma once

#include "core/document/Dirty.h"
#include "core/document/Document.h"
#include "render/scene/DfgTextures.h"
#include "render/scene/EnvironmentLight.h"
#include "render/scene/GpuMaterial.h"
#include "render/scene/GpuMesh.h"
#include "render/scene/LightId.h"
#include "render/scene/ManyLights.h"
#include "render/scene/TextureCache.h"
#include "render/scene/TransferValues.h"
#include "render/scene/VertexValues.h"

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace patina {
struct ShownRadiosity; // core/radiosity/document/LiveRadiosity.h
using ShownRadiosityPtr = std::shared_ptr<const ShownRadiosity>;
} // namespace patina

namespace patina::render {

// What radiosity knows of a corner of an element.
struct RadiosityVertex {
    glm::vec4 exitRadiance{0.0f}; // rgb: of unit albedo
    glm::vec4 sent{0.0f};         // rgb: radiance of the element, a: its area, m²
    glm::vec4 unshot{0.0f};       // rgb: of it; a: form factor from the chosen element
};

// One mesh instance, or one side of it as it is divided into elements, ready to be drawn.
struct DrawItem {
    Id id = 0;
    Id materialId = 0;
    const GpuMesh* mesh = nullptr;
    const GpuMaterial* material = nullptr;
    const gl::Buffer* instanceBlock = nullptr;
    const gl::Buffer* visibility = nullptr; // per-vertex AO, or null
    const Transfer* transfer = nullptr;     // of its vertices or its material's texels, or null
    LitElements* lit = nullptr;             // never null: RelightPass keeps it
    LitElements* litVertices = nullptr;     // the same, or those of its vertices
    glm::mat4 transform{1.0f};
    glm::mat3 normalToWorld{1.0f};
    const gl::Texture* texelAo = nullptr;  // baked AO texture, or null
    const gl::Texture* lightMap = nullptr; // baked, or null
    const gl::Buffer* radiosity = nullptr; // RadiosityVertex each, or null
    bool mirrored = false;
    Bounds bounds; // in the world
};

class GpuScene {
  public:
    explicit GpuScene(gl::Context& context);

    // Renews what differs from the document that was shown; returns what that was.
    Dirty update(const Document& document);

    // Environments that may light it: the document's own and others beside it. Their light and the
    // picture behind the scene come with them, not with the document. Throws away what surfaces
    // show in a light that is removed.
    LightId addLight(const Environment& environment);
    void changeLight(LightId light, const Environment& environment); // not the document's own
    void removeLight(LightId light);                                 // not the document's own
    [[nodiscard]] EnvironmentLight& light(LightId light = kDocumentLight);
    [[nodiscard]] const EnvironmentLight& light(LightId light = kDocumentLight) const;
    // How it is turned, mixed and seen.
    [[nodiscard]] const Environment& environment(LightId light = kDocumentLight) const;
    // Of an environment that is shown, or was and is prepared still, made of the same texels; null:
    // there are none.
    [[nodiscard]] const EnvironmentTextures* texturesOf(const EnvironmentTexelsPtr& texels) const;
    // Keeps what a light no longer shows, in place of what was kept longest ago, while anybody has
    // the texels that it was made of.
    void keepTextures(const EnvironmentTextures& textures);

    // AoVertex or PrtVertex.
    void previewVertices(BakeKind kind, Id mesh, int stride, std::span<const float> values);
    void previewTexels(Id material, int size, std::span<const float> values);
    void clearPreview();
    // Radiance of unit albedo per vertex that came by way of other surfaces in this light.
    // Nothing where the mesh has no transfer of as many vertices.
    void setBouncedLight(LightId light, Id mesh, std::span<const glm::vec3> radiance);
    void clearBouncedLight(); // of all lights
    // Shadows of local lights, of vertices and texels, instead of those that transfer knows; null:
    // none. What has not changed is not uploaded again.
    void setNearShadows(const NearShadowsPtr& shadows);
    // What LightingMode::Radiosity shows in the document's own light; null: image-based light,
    // until there is something. What has the shape of before is not uploaded again.
    void setRadiosity(const ShownRadiosityPtr& radiosity);
    [[nodiscard]] const ShownRadiosityPtr& radiosity() const { return m_radiosity; }
    // The lights of LitElements::nearShares, in its order.
    [[nodiscard]] std::vector<Id> nearShareLights() const;

    [[nodiscard]] const Document& document() const { return m_document; }
    [[nodiscard]] const gl::Texture& dfg() const { return *m_dfg; } // of the shading model
    [[nodiscard]] const gl::Buffer& modelBlock() const { return m_modelBlock; }
    [[nodiscard]] const gl::Texture& lobes() const { return m_lobes; } // core/light/LobeTable.h
    // Visible instances with geometry, in document order.
    [[nodiscard]] const std::vector<DrawItem>& items() const { return m_items; }
    // As it is drawn in this light: under radiosity divided into elements, as far as it is solved.
    [[nodiscard]] const std::vector<DrawItem>& items(LightingMode lighting, LightId light) const;
    [[nodiscard]] const Bounds& bounds() const { return m_bounds; } // of the items
    [[nodiscard]] std::size_t meshCount() const { return m_meshes.size(); }
    [[nodiscard]] std::size_t textureCount() const { return m_textures.size(); }
    // How often items() has been made anew.
    [[nodiscard]] std::uint64_t rebuilds() const { return m_rebuilds; }

    // Grows when geometry, or what is cut out of it, changes: shadow maps are drawn anew.
    [[nodiscard]] std::uint64_t shapeRevision() const { return m_shapeRevision; }

    // The frame's uniforms of environment and lights. `shadows`: ids of the lights that have a
    // shadow map, by slot; `reflectionMix`: View's.
    void fill(FrameBlock& frame, LightId light, float reflectionMix,
              std::span<const Id> shadows = {}) const;
    // Makes the lights ready of which fill() finds more than the frame holds.
    void setManyLights(std::span<const Id> shadows);
    [[nodiscard]] const ManyLights& manyLights() const { return m_manyLights; }
    // What lights transfer from far away, order² radiance coefficients: the environments of the mix
    // and the directional lights.
    [[nodiscard]] std::vector<glm::vec3> transferLight(LightId light, int order) const;
    // World position and normal (TexelPlace) of each texel of a material's bake, for lights near
    // by; made when it is first asked for.
    [[nodiscard]] const gl::Buffer& texelPlaces(Id material, int side);
    // Grows when what texelPlaces() answers may have changed.
    [[nodiscard]] std::uint64_t placeRevision() const { return m_placeRevision; }

  private:
    void updateMeshes();
    void updateMaterials(const Dirty& dirty);
    void updateTexelBakes();
    void updateLightMaps();
    void rebuildItems();
    void rebuildRadiosityItems();
    struct InstanceOnGpu {
        gl::Buffer buffer;
        InstanceBlock block; // that it holds
    };
    [[nodiscard]] const InstanceOnGpu& onGpu(const MeshInstance& mesh);
    // What bakes, or their live preview, know of an item.
    void attachBakes(DrawItem& item);
    void applyNearShadows();
    void applyNearShadows(LitElements& lit, std::optional<std::size_t> part);

    // An environment beside the document's.
    struct OtherLight {
        Environment environment;
        EnvironmentLight light;
    };

    gl::Context& m_context;
    Document m_document;
    EnvironmentLight m_documentLight;
    std::map<LightId, OtherLight> m_otherLights;
    LightId m_lastLight = kDocumentLight;
    std::list<EnvironmentTextures> m_kept; // of lights no more, the one kept last first
    DfgTextures m_dfgTextures;
    const gl::Texture* m_dfg; // one of them
    gl::Buffer m_modelBlock;
    gl::Texture m_lobes;
    ManyLights m_manyLights;
    TextureCache m_textures;
    std::map<MeshPtr, GpuMesh> m_meshes; // holds the mesh: an address is never reused
    std::map<Id, GpuMaterial> m_materials;
    std::map<Id, InstanceOnGpu> m_instances;
    VertexValues m_visibility;
    TransferValues m_transfer;
    NearShadowsPtr m_nearShadows;
    std::map<Id, LitElements> m_lit, m_litTexels; // by mesh, by material
    std::map<Id, gl::Buffer> m_texelPlaces;       // by material, of the present geometry
    std::map<Id, gl::Texture> m_texelPreviews;    // by material
    std::map<Id, TexturePtr> m_texelBakes;
    BakeArtifactPtr m_lightMapBake;
    std::map<Id, gl::Texture> m_lightMaps; // of it, by material
    std::vector<DrawItem> m_items;
    ShownRadiosityPtr m_radiosity;
    struct RadiosityOnGpu { // of a RadiositySurface
        GpuMesh mesh;
        gl::Buffer vertices, instance;
    };
    std::vector<RadiosityOnGpu> m_radiositySurfaces; // of m_radiosity's shape
    std::vector<DrawItem> m_radiosityItems;
    std::uint64_t m_shapeRevision = 0, m_placeRevision = 0, m_rebuilds = 0;
    Bounds m_bounds;
};

} // namespace patina::render
