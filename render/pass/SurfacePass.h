// Draws the meshes with their materials and light into the scene's target.
#pragma once

#include "core/base/Hash.h"
#include "render/pass/SurfaceOutput.h"
#include "render/scene/DrawList.h"
#include "render/scene/SceneSlice.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina::render {

// What is the same for all items of a frame.
struct SurfaceSettings {
    LightingMode lighting{};
    LightId light = kDocumentLight;
    bool isDocumentsLight = true; // the document's own, or the same beside it
    bool hasPunctualLights = false;
    bool hasAreaLights = false;
    glm::ivec4 lightEnds{0}; // FrameBlock::lightEnds
    [[nodiscard]] bool hasManyLights() const { return lightEnds.w > kUniformLights; }
    int shadows = 0;    // maps that ShadowPass::bind() has bound
    ShadingModel model; // its choices; the numbers are in the scene's model block
    SurfaceOutput output = SurfaceOutput::Picture;
    // Into a target of 32-bit floats: by a program of its own. llvmpipe (Mesa 22.3) names machine
    // code on disk by the program's code, which compiling for a first format changes: under a
    // second one it would not be found.
    bool floats = false;
    // Set: meshes may be drawn with fewer triangles where this view hides it.
    std::optional<CoarseView> coarseView = std::nullopt;
    TriangleRange triangles = {}; // of the items that are drawn; not with coarseView
    // Set: only triangles that lie in this clip space are drawn, and counted.
    std::optional<glm::mat4> clip = std::nullopt;
};

// What tells two variants apart: features, the choices of the model, the unrolled lights, the
// output.
struct SurfaceVariant {
    SurfaceFeatures features;
    unsigned model = 0, lightEnds = 0, output = 0;
    friend auto operator<=>(const SurfaceVariant&, const SurfaceVariant&) = default;
};
void hashVariant(Hasher& hasher, const SurfaceVariant& variant);

class SurfacePass {
  public:
    // `studyDefines` go into every variant: CONSTANT_… of surface.frag, to measure what terms cost.
    explicit SurfacePass(ShaderLibrary& shaders, std::vector<std::string> studyDefines = {})
        : m_shaders(shaders)
        , m_studyDefines(std::move(studyDefines)) {}

    // The opaque items write depth; the blended ones are added over what is there.
    Result<void> drawOpaque(const GpuScene& scene, const DrawList& list,
                            const SurfaceSettings& settings);
    Result<void> drawBlended(const GpuScene& scene, const DrawList& list,
                             const SurfaceSettings& settings);
    // Depth test and blending as they are.
    Result<void> draw(const GpuScene& scene, const std::vector<const DrawItem*>& items,
                      const SurfaceSettings& settings);

  private:
    Result<const gl::Program*> program(const SurfaceFeatures& features,
                                       const SurfaceSettings& settings);

    ShaderLibrary& m_shaders;
    std::vector<std::string> m_studyDefines;
    std::map<SurfaceVariant, const gl::Program*> m_programs; // owned by the library …
    std::size_t m_drops = 0; // … which has dropped so many of them
};

// Baked values that an item is drawn with.
struct SurfaceBakes {
    bool transfer = false, texelTransfer = false; // the latter: per texel
    bool texelAo = false, vertexAo = false;
    bool lightMap = false;
    bool radiosity = false;
};

// What an item needs under these settings. `material`: its own features.
[[nodiscard]] SurfaceFeatures surfaceFeatures(const SurfaceFeatures& material,
                                              const SurfaceBakes& bakes,
                                              const SurfaceSettings& settings);
[[nodiscard]] SurfaceFeatures surfaceFeatures(const DrawItem& item,
                                              const SurfaceSettings& settings);
[[nodiscard]] SurfaceVariant surfaceVariant(const SurfaceFeatures& features,
                                            const SurfaceSettings& settings);
[[nodiscard]] std::vector<std::string> surfaceDefines(const SurfaceFeatures& features);
// The choices of the model that are not the default.
[[nodiscard]] std::vector<std::string> modelDefines(const ShadingModel& model);

// Whether backs of its triangles are not there. Each side of an element is a surface of its own.
[[nodiscard]] inline bool isCulled(const DrawItem& item) {
    return !item.material->doubleSided || item.radiosity != nullptr;
}

// Binds blocks and buffers of an item and issues the draw call; front faces and culling included.
// `coarse`: of its mesh, drawn instead of all of it; null: those of `ranges`, empty: all.
void drawItem(const DrawItem& item, bool cull, const GpuMesh::Coarse* coarse = nullptr,
              std::span<const TriangleRange> ranges = {});

} // namespace patina::render
