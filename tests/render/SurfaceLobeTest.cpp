// The lobe that the editor draws on the surface: where it stands, which way it looks, and what
// hides it.
#include "core/light/LensCurves.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace patina::render {
namespace {

constexpr int kSize = 256;

class SurfaceLobes : public RenderTest {
  protected:
    SurfaceLobes() {
        m_document = makeScene(makePlane());
        m_document.view.camera.target = glm::vec3(0.0f, 0.4f, 0.0f);
        m_document.view.camera.pitchDeg = 15.0f;
        m_document.view.camera.yawDeg = 0.0f;
        m_document.view.camera.distance = 4.0f;
        // Above the middle of the plane: light from -X, 45° high.
        DfgTables tables;
        const BrdfLens lens({}, {glm::vec3(0.8f), 0.0f, 0.4f, 0.0f}, tables.of({}));
        const glm::vec3 light = lensDirection(-0.785f);
        LobeScale scale;
        scale.lobe = LensLobe::Specular;
        const float peak = lobePeak(lens, light, LobeEnd::Light, scale);
        auto lobe = std::make_shared<SurfaceLobe>();
        lobe->mesh = std::make_shared<const LobeMesh>(
            makeLobeMesh(lens, light, LobeEnd::Light, scale, peak));
        lobe->tangent = {1, 0, 0};
        lobe->bitangent = {0, 0, -1};
        lobe->normal = {0, 1, 0};
        lobe->toFixed = glm::normalize(glm::vec3(-1, 1, 0));
        lobe->color = {0.2f, 0.6f, 1.0f};
        m_lobe = lobe;
    }
    // What the lobe changes of the displayed picture, by half: left and right of the point.
    struct Seen {
        int left = 0, right = 0, below = 0;
        double change = 0; // mean of all pixels
    };
    Seen seen() {
        FrameSettings frame;
        frame.showOverlays = true;
        frame.samples = 1;
        draw(m_document, kSize, frame);
        const Image without = renderer().readDisplayed();
        frame.lobe = m_lobe;
        draw(m_document, kSize, frame);
        const Image with = renderer().readDisplayed();
        Seen result;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const glm::vec4 d = glm::abs(pixel(with, x, y) - pixel(without, x, y));
                result.change += double(d.x + d.y + d.z) / (3.0 * kSize * kSize);
                if (d.x + d.y + d.z < 0.05f)
                    continue;
                if (y > kSize * 3 / 4)
                    ++result.below;
                ++(x < kSize / 2 ? result.left : result.right);
            }
        return result;
    }
    SurfaceLobe& lobe() { return *m_lobe; }

    Document m_document;
    std::shared_ptr<SurfaceLobe> m_lobe;
};

TEST_F(SurfaceLobes, StandsOnThePointAndLeansAwayFromTheLight) {
    const Seen mirrored = seen();
    EXPECT_GT(mirrored.right, 2 * mirrored.left) << "the highlight is opposite the light";
    EXPECT_GT(mirrored.left, 30) << "the ray to the light";
    EXPECT_EQ(mirrored.below, 0) << "nothing goes into the surface";
    // In a frame turned by half a circle it leans the other way.
    lobe().tangent = {-1, 0, 0};
    lobe().bitangent = {0, 0, 1};
    lobe().toFixed = glm::normalize(glm::vec3(1, 1, 0));
    const Seen turned = seen();
    EXPECT_NEAR(turned.left, mirrored.right, 0.05 * mirrored.right);
}

TEST_F(SurfaceLobes, KeepsItsSizeAtAnyDistance) {
    const Seen near = seen();
    m_document.view.camera.distance = 8.0f;
    const Seen far = seen();
    EXPECT_NEAR(far.left + far.right, near.left + near.right, 0.15 * (near.left + near.right));
}

TEST_F(SurfaceLobes, IsFaintBehindTheSceneAndGoneWithTheOverlays) {
    const double before = seen().change;
    ASSERT_GT(before, 0.01);
    // A wall between the camera and the lobe.
    MeshInstance wall = m_document.meshes[0];
    wall.id = m_document.takeId() + 10;
    wall.placement = glm::mat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 1);
    m_document.meshes.push_back(wall);
    const double hidden = seen().change;
    EXPECT_LT(hidden, 0.5 * before);
    EXPECT_GT(hidden, 0.0);
    m_document.meshes.pop_back();

    FrameSettings frame;
    frame.lobe = m_lobe;
    draw(m_document, kSize, frame);
    const Image with = renderer().readDisplayed();
    frame.lobe = nullptr;
    draw(m_document, kSize, frame);
    EXPECT_EQ(renderer().readDisplayed(), with) << "no overlays, no lobe";
}

TEST_F(SurfaceLobes, BehindTheCameraOrEmptyItIsNothing) {
    lobe().position = m_document.view.camera.position() - 2.0f * m_document.view.camera.forward();
    EXPECT_EQ(seen().change, 0.0);
    lobe().position = glm::vec3(0.0f);
    lobe().mesh = std::make_shared<const LobeMesh>();
    EXPECT_LT(seen().change, 0.005) << "its rays are left";
    lobe().mesh = nullptr;
    EXPECT_LT(seen().change, 0.005);
}

} // namespace
} // namespace patina::render
