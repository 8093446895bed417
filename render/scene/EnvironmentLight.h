// An environment on the GPU: prefiltered radiance, lat-long background, and the SH coefficients
// turned and scaled for the frame.
#pragma once

#include "core/document/Document.h"
#include "core/light/EnvironmentTexels.h"
#include "core/mix/LightMix.h"
#include "render/gl/Texture.h"
#include "render/scene/Blocks.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace patina::render {

using ProjectionSh = std::array<glm::vec3, kMaxTransferCount>; // of a picture's radiance

// What one environment needs on the GPU, complete; copies share its textures.
struct EnvironmentTextures {
    std::shared_ptr<const gl::Texture> prefiltered; // a CubeAtlas
    std::shared_ptr<const gl::Texture> background;
    std::weak_ptr<const EnvironmentTexels> source; // that they were made of
    ImagePtr image;                                // that the background shows; null: grey
    std::array<glm::vec3, 9> irradianceSh{};
    ProjectionSh radianceSh{};
    int side = 1, levels = 1, irradianceSide = 1, irradianceTop = 0; // of the atlas
    std::size_t clamped = 0; // texels of the light that exceeded 65504, the largest half float

    [[nodiscard]] std::size_t bytes() const; // of the textures
};

class EnvironmentLight {
  public:
    explicit EnvironmentLight(gl::Context& context); // a grey sky until something is set

    // Light and the picture behind the scene, at once.
    void set(const EnvironmentTexels& texels);
    void setIbl(const IblMaps& maps); // light alone; the picture stays

    // Textures that are there already.
    void share(const EnvironmentTextures& textures);
    [[nodiscard]] const EnvironmentTextures& textures() const { return m_textures; }

    // set() in pieces that hold no frame up. What is there stays until all of the new is; an
    // environment that begins takes the place of an unfinished one. A picture that is there
    // already, or partly, is not uploaded again.
    void begin(EnvironmentTexelsPtr texels);
    // Uploads about so many bytes more, at least one row; true when nothing is left to do.
    bool proceed(std::size_t bytes);

    // How the picture is to be turned and scaled: shownEnvironment() of the document. While it is
    // of another role than the picture that is there, that one stays as it was shown.
    void show(const EnvironmentPart& part);
    // Rotation, scale and coefficients of what is shown for this frame.
    void fill(FrameBlock& frame) const;

    // Coefficients of a picture that is part of a cross-fade: with those of both parts transfer
    // is lit by exactly their mix, whatever picture of both is shown meanwhile. Those of a picture
    // that is shown come with it.
    void setProjection(const ImagePtr& image, const ProjectionSh& coefficients);
    [[nodiscard]] bool knowsProjection(const ImagePtr& image) const;
    // Radiance coefficients of these environments in the world, order² of them; of what is shown,
    // as it is shown, where those of a part are not known.
    [[nodiscard]] std::vector<glm::vec3> transferLight(std::span<const EnvironmentPart> parts,
                                                       int order) const;

    // A CubeAtlas; its side and levels are in the frame's block.
    [[nodiscard]] const gl::Texture& prefiltered() const { return *m_textures.prefiltered; }
    [[nodiscard]] const gl::Texture& background() const { return *m_textures.background; }
    [[nodiscard]] std::size_t memoryBytes() const; // of the textures
    [[nodiscard]] std::size_t clampedTexels() const { return m_textures.clamped; }

  private:
    [[nodiscard]] glm::vec3 scale() const; // of radiance
    void adopt(EnvironmentTextures textures);
    // A texture that is filled row by row, from the top of level 0.
    struct Filling {
        gl::Texture texture;
        int level = 0, row = 0; // next
    };
    struct Arriving {
        EnvironmentTexelsPtr texels;
        Filling prefiltered;
        std::optional<Filling> background; // none: the one shown stays
    };

    gl::Context& m_context;
    EnvironmentTextures m_textures; // that are shown
    std::optional<Arriving> m_arriving;
    std::map<std::weak_ptr<const Image>, ProjectionSh, std::owner_less<>> m_projections;
    EnvironmentPart m_wanted, m_shown;
};

// Irradiance coefficients as FrameBlock has them, times its radianceScale: 16 bits relative to the
// largest.
void packIrradiance(const std::array<glm::vec3, 9>& coefficients, FrameBlock& frame);

// Light of the same radiance from everywhere, as setIbl() takes it.
[[nodiscard]] IblMaps uniformIbl(const glm::vec3& radiance);

} // namespace patina::render
