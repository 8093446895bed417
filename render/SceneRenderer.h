// A document on the GPU with all that its pictures share: geometry, maps, shadow maps, environment
// light, programs. Draws nothing itself: ViewRenderer and SheetRenderer do, as many as there are
// pictures. Qt-free. All calls need the context it was created with to be current, on one thread.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/io/DisplayTransform.h"
#include "core/light/EnvironmentTexels.h"
#include "render/gl/Context.h"
#include "render/scene/LightId.h"
#include "render/shader/ShaderLibrary.h"

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace patina {
struct ShownRadiosity; // core/radiosity/document/LiveRadiosity.h
using ShownRadiosityPtr = std::shared_ptr<const ShownRadiosity>;
} // namespace patina

namespace patina::render {

class SceneRenderer {
  public:
    // Compiles the programs. `shaderFolder`: read shaders from there and watch them (hot reload);
    // empty: the ones built in. Errors: NoOpenGl, Internal with the compiler's log.
    static Result<std::unique_ptr<SceneRenderer>>
    create(gl::Context& context, const std::filesystem::path& shaderFolder = {});
    ~SceneRenderer();

    // Takes over what differs from the document before, and keeps the snapshot. The camera travels
    // with each frame instead.
    void setDocument(const Document& document);

    // --- Environment light -----------------------------------------------------------------------
    // Another environment beside the document's: frames may be lit by it (FrameSettings::light).
    // Its picture is `environment`.image or ::blended; whether it is solo the document says. A grey
    // sky lights the scene until its light is set.
    LightId addLight(const Environment& environment);
    void changeLight(LightId light, const Environment& environment); // not the document's own
    void removeLight(LightId light);                                 // not the document's own
    // Light and picture of an environment; prepared elsewhere (a job in the editor, directly in the
    // command line). Another light of the same texels shares them on the GPU, and those that were
    // shown last stay there while anybody has their texels: some are there again at once.
    void setEnvironment(EnvironmentTexelsPtr texels, LightId light = kDocumentLight);
    void setIbl(const IblMaps& maps, LightId light = kDocumentLight); // light alone
    // setEnvironment() in pieces between frames: the old environment is shown until the new one is
    // complete. proceedEnvironment() uploads about so many bytes more; true when nothing is left.
    void beginEnvironment(EnvironmentTexelsPtr texels, LightId light = kDocumentLight);
    bool proceedEnvironment(std::size_t bytes, LightId light = kDocumentLight);

    // Coefficients (8 bands) of a picture that takes part in a cross-fade. With both known,
    // transfer is lit by exactly their mix while the picture of both is still on its way; those of
    // a picture that was set come with it.
    using ProjectionSh = std::array<glm::vec3, 64>;
    void setProjection(const ImagePtr& image, const ProjectionSh& coefficients);
    [[nodiscard]] bool knowsProjection(const ImagePtr& image) const;
    // Radiance coefficients, order² of them, of the light from far away that transfer is lit by
    // now: the environments of the mix and the directional lights as discs.
    [[nodiscard]] std::vector<glm::vec3> transferLight(int order,
                                                       LightId light = kDocumentLight) const;

    // What ToneMap::OpenColorIo shows; null: nothing yet, the default curve stands in for it. Error
    // Internal when the driver refuses its shader; the stand-in is used then, too.
    Result<void> setDisplay(const DisplayTransformPtr& display);

    // --- Bakes -----------------------------------------------------------------------------------
    // Live bake preview: values of a running bake, drawn instead of an attached artifact's. `kind`
    // is AoVertex or PrtVertex; `values`: all vertices of the mesh, `stride` numbers each.
    void previewVertices(BakeKind kind, Id mesh, int stride, std::span<const float> values);
    void previewTexels(Id material, int size, std::span<const float> values); // whole texture
    void clearPreview();
    // Radiance per vertex that a surface of albedo 1 sends out by way of other surfaces in
    // transferLight(): replaces what the attached bake holds of it (LightingMode::Prt) until it is
    // cleared or another bake is attached. Lights near by are added to it, through the bake.
    void setBouncedLight(Id mesh, std::span<const glm::vec3> radiance,
                         LightId light = kDocumentLight);
    void clearBouncedLight(); // of all meshes and lights
    // Shadows of the document's local lights under transfer (core/bake/local/NearShadows.h), sharp
    // and complete, instead of what the bake's bands know of them; null: none. They hold until they
    // are set again: those of a light that has moved, or of other geometry, are still shown. What
    // has none (another bake, a light that was added) shows what the bands know.
    void setNearShadows(const NearShadowsPtr& shadows);
    // Under LightingMode::Radiosity, in the document's own light; null: nothing is solved yet, and
    // image-based light stands in for it.
    void setRadiosity(const ShownRadiosityPtr& radiosity);
    // Whether a picture or view showed local lights by way of a bake since the last call.
    [[nodiscard]] bool takeNearShadowUse();

    // --- Programs --------------------------------------------------------------------------------
    // What the driver has compiled so far: files and #defines of each program.
    [[nodiscard]] std::vector<ProgramKey> programs() const;
    // Recompiles shaders that changed on disk; a shader that does not compile keeps the last good
    // program. Returns the messages (file, line) of what failed.
    std::vector<std::string> reloadShaders();

    // What has been done since it was made, to see that nothing is done twice.
    struct Counts {
        std::size_t shadowMaps = 0;      // drawn
        std::uint64_t relitElements = 0; // vertices and texels under transfer
        std::uint64_t scenes = 0;        // frames whose surfaces were drawn, not displayed again
    };
    [[nodiscard]] Counts counts() const;

  private:
    friend class ViewRenderer;
    friend class SheetRenderer;
    struct Impl;
    explicit SceneRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
