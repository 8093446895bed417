// Small scenes and a fixture that draws them into linear images.
#pragma once

#include "core/document/Document.h"
#include "core/mesh/Mesh.h"
#include "render/SceneRenderer.h"
#include "render/SheetRenderer.h"
#include "render/ViewRenderer.h"
#include "tests/render/GlTest.h"

#include <functional>
#include <glm/vec3.hpp>
#include <string>

namespace patina::render {

// A unit sphere around the origin, or a square in the plane y = 0 from -1 to 1 that faces +Y.
// Its texture coordinates: u grows with +X, v with +Z.
[[nodiscard]] MeshPtr makeSphere(int rings = 48);
[[nodiscard]] MeshPtr makePlane();

// One mesh with one material (ids 1 and 2), a black environment, camera in front.
[[nodiscard]] Document makeScene(const MeshPtr& mesh);
// Straight above the plane, its upper image edge towards -Z: the plane's texture appears upright.
[[nodiscard]] Camera cameraAbove();

[[nodiscard]] ImagePtr makeImage(int width, int height, int channels, PixelType type,
                                 ColorEncoding encoding,
                                 const std::function<float(int x, int y, int channel)>& value);

// A light-probe like environment: radiance(direction) sampled at the texel centres.
[[nodiscard]] ImagePtr
makeEnvironment(int height, const std::function<glm::vec3(const glm::vec3& direction)>& radiance);

[[nodiscard]] glm::vec4 pixel(const Image& image, int x, int y); // stored numbers
[[nodiscard]] glm::vec4 centerPixel(const Image& image);

class RenderTest : public gl::GlTest {
  protected:
    void SetUp() override;
    void TearDown() override;
    SceneRenderer& sceneRenderer() { return *m_scene; }
    ViewRenderer& renderer() { return *m_renderer; } // of its picture

    // Draws with the document's camera and returns the linear picture.
    Image draw(const Document& document, int size = 64, const FrameSettings& settings = {});
    // Computes and sets the image-based light of document.environment().image, and its background.
    void setIblOf(const Document& document);
    void setBackground(const ImagePtr& image, const IblMaps& light);

  private:
    std::unique_ptr<SceneRenderer> m_scene;
    std::unique_ptr<ViewRenderer> m_renderer;
};

} // namespace patina::render
