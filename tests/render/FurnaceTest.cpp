// The white furnace in the viewport's own picture: what a sphere returns of an environment that is
// 1 everywhere, from its centre to its rim, through the whole chain of an environment.
#include "core/light/DfgTable.h"
#include "core/material/BrdfModel.h"
#include "core/material/Material.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

constexpr int kSize = 129;

class Furnace : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        m_document = makeScene(makeSphere(160));
        m_document.environment().image = makeEnvironment(16, [](auto) { return glm::vec3(1.0f); });
        setIblOf(m_document);
        material().baseColor = glm::vec3(1.0f);
        material().metallic = 1.0f;
    }
    Material& material() { return m_document.materials.front(); }
    ShadingModel& model() { return m_document.model; }

    // Every pixel of the picture's middle row on the sphere: its green value and N·V.
    void forEachPixel(const std::function<void(float NoV, float seen)>& visit) {
        FrameSettings settings;
        settings.samples = 1; // a pixel is its centre
        const Image image = draw(m_document, kSize, settings);
        const Camera& camera = m_document.view.camera;
        int count = 0;
        for (int x = kSize / 2; x < kSize; ++x) {
            // The ray of the pixel's centre meets the unit sphere around the origin.
            const float t = (2.0f * (static_cast<float>(x) + 0.5f) / kSize - 1.0f) *
                            std::tan(glm::radians(0.5f * camera.fovDeg));
            const glm::vec3 d = glm::normalize(glm::vec3(t, 0.0f, -1.0f));
            const glm::vec3 o(0.0f, 0.0f, camera.distance);
            const float b = glm::dot(o, d), root = b * b - glm::dot(o, o) + 1.0f;
            if (root < 0.0f)
                break;
            const float NoV = glm::dot(o + (-b - std::sqrt(root)) * d, -d);
            if (NoV < 0.08f) // the rim's last pixel is half air
                break;
            visit(NoV, pixel(image, x, kSize / 2).y);
            ++count;
        }
        EXPECT_GT(count, 40);
    }

  private:
    Document m_document;
};

TEST_F(Furnace, WhiteMetalReturnsEverythingAtEveryRoughness) {
    for (const float r : {0.0f, 0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.75f, 0.9f, 1.0f}) {
        material().perceptualRoughness = r;
        forEachPixel([&](float NoV, float seen) {
            EXPECT_NEAR(seen, 1.0f, 5e-3f) << "r " << r << ", N·V " << NoV;
        });
    }
}

TEST_F(Furnace, WhiteMetalLosesWhatIsTabulatedWithoutCompensation) {
    model().multiScatter = false;
    // 1 - E of height-correlated GGX at N·V 0.1, 0.25, 0.5, 0.75, 1, by tanh-sinh quadrature.
    constexpr float kNoV[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
    const struct {
        float r;
        float loss[5];
    } rows[] = {{0.1f, {0.005876f, 0.000908f, 0.000258f, 0.000142f, 0.000101f}},
                {0.25f, {0.103230f, 0.038433f, 0.011676f, 0.006189f, 0.004312f}},
                {0.5f, {0.108378f, 0.159918f, 0.142737f, 0.108467f, 0.084188f}},
                {0.75f, {0.151644f, 0.255544f, 0.336824f, 0.367115f, 0.373114f}},
                {1.0f, {0.239790f, 0.402359f, 0.549306f, 0.635473f, 0.693147f}}};
    for (const auto& row : rows) {
        material().perceptualRoughness = row.r;
        // Between the tabulated angles, the exact integral.
        float nearest[5] = {1, 1, 1, 1, 1}, lossThere[5] = {}, expectedThere[5] = {};
        forEachPixel([&](float NoV, float seen) {
            const glm::dvec3 exact = integrateDfg(NoV, row.r);
            EXPECT_NEAR(seen, exact.x + exact.y, 5e-3) << "r " << row.r << ", N·V " << NoV;
            for (int i = 0; i < 5; ++i)
                if (std::abs(NoV - kNoV[i]) < nearest[i]) {
                    nearest[i] = std::abs(NoV - kNoV[i]);
                    lossThere[i] = 1.0f - seen;
                    const glm::dvec3 at = integrateDfg(kNoV[i], row.r);
                    expectedThere[i] =
                        row.loss[i] + static_cast<float>(at.x + at.y - exact.x - exact.y);
                }
        });
        for (int i = 0; i < 5; ++i)
            EXPECT_NEAR(lossThere[i], expectedThere[i], 5e-3f) << row.r << " " << kNoV[i];
    }
}

// Each distribution and each visibility: the table is that of the model.
TEST_F(Furnace, EveryModelHasItsOwnTable) {
    std::vector<ShadingModel> models;
    for (const Distribution d : {Distribution::Beckmann, Distribution::BlinnPhong}) {
        models.emplace_back();
        models.back().distribution = d;
    }
    for (const Visibility v : {Visibility::SmithSeparable, Visibility::SchlickDirect,
                               Visibility::SchlickIbl, Visibility::Kelemen, Visibility::Implicit}) {
        models.emplace_back();
        models.back().visibility = v;
    }
    for (const ShadingModel& each : models)
        for (const float r : {0.3f, 0.7f}) {
            material().perceptualRoughness = r;
            model() = each;
            const std::string name = "D " + std::to_string(int(each.distribution)) + ", V " +
                                     std::to_string(int(each.visibility)) + ", r " +
                                     std::to_string(r);
            forEachPixel([&](float NoV, float seen) {
                EXPECT_NEAR(seen, 1.0f, 5e-3f) << name << ", N·V " << NoV;
            });
            model().multiScatter = false;
            forEachPixel([&](float NoV, float seen) {
                const glm::dvec3 exact =
                    integrateDfg(NoV, r, each.distribution, iblVisibility(each.visibility));
                // The implicit lobe is N·V² wide at most: half a texel at N·V = 1 is 0.008.
                EXPECT_NEAR(seen, std::min(exact.x + exact.y, 1.0), 8e-3)
                    << name << ", N·V " << NoV;
            });
        }
    // Back to a model of before: its table is still there, and is the one in use.
    model() = ShadingModel{};
    model().multiScatter = false;
    material().perceptualRoughness = 0.7f;
    forEachPixel([&](float NoV, float seen) {
        const glm::dvec3 exact = integrateDfg(NoV, 0.7f);
        EXPECT_NEAR(seen, exact.x + exact.y, 5e-3) << NoV;
    });
}

TEST_F(Furnace, WhiteNonMetalReturnsNoMoreThanEverything) {
    material().metallic = 0.0f;
    for (const Diffuse diffuse :
         {Diffuse::Lambert, Diffuse::Burley, Diffuse::OrenNayar, Diffuse::Eon})
        for (const float r : {0.0f, 0.3f, 1.0f}) {
            model().diffuse = diffuse;
            material().perceptualRoughness = material().diffuseRoughness = r;
            const shading::BrdfModel terms = brdfModel(model());
            forEachPixel([&](float NoV, float seen) {
                const glm::dvec3 dfg = integrateDfg(NoV, r);
                const float layer = shading::specularAlbedo(terms, glm::vec3(0.04f), 0.0f,
                                                            glm::vec2(glm::dvec2(dfg)))
                                        .y;
                const float body = shading::diffuseReflectance(terms, glm::vec3(1.0f), r, r, NoV).y;
                EXPECT_NEAR(seen, layer + (1.0f - layer) * body, 5e-3f)
                    << "diffuse " << int(diffuse) << ", r " << r << ", N·V " << NoV;
                EXPECT_LE(seen, 1.003f);
                if (diffuse == Diffuse::Lambert || diffuse == Diffuse::Eon) {
                    EXPECT_NEAR(seen, 1.0f, 5e-3f);
                }
            });
        }
}

TEST_F(Furnace, AGreyBodyReflectsItsAlbedoOnce) {
    material().metallic = 0.0f;
    material().baseColor = glm::vec3(0.5f);
    for (const float r : {0.0f, 0.5f, 1.0f}) {
        material().perceptualRoughness = r;
        forEachPixel([&](float NoV, float seen) {
            const glm::dvec3 dfg = integrateDfg(NoV, r);
            const double E = dfg.x + dfg.y;
            const double layer = (0.04 * dfg.x + dfg.y) * (1.0 + 0.04 * (1.0 - E) / E);
            EXPECT_NEAR(seen, layer + (1.0 - layer) * 0.5, 4e-3) << r << " " << NoV;
        });
    }
}

TEST_F(Furnace, ExactFresnelShowsItsOwnReflectance) {
    // A mirror of glass and of gold: Fresnel's equations themselves.
    material().perceptualRoughness = 0.0f;
    material().baseColor = glm::vec3(0.0f);
    model().fresnel = Fresnel::Dielectric;
    model().ior = 1.8f;
    material().metallic = 0.0f;
    forEachPixel([&](float NoV, float seen) {
        EXPECT_NEAR(seen, shading::F_Dielectric(NoV, 1.8f), 6e-3f) << NoV;
    });
    model().fresnel = Fresnel::Conductor; // gold
    material().metallic = 1.0f;
    forEachPixel([&](float NoV, float seen) {
        EXPECT_NEAR(seen, shading::F_Conductor(NoV, model().conductorN, model().conductorK).y,
                    6e-3f)
            << NoV;
    });
}

} // namespace
} // namespace patina::render
