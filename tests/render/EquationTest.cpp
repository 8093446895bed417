// The equation bar's sums and products, from the numbers that the views read back.

#include "core/document/Equation.h"
#include "core/document/ViewChoices.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <map>

using namespace patina;
using namespace patina::render;

namespace {

using namespace patina::shading;

constexpr int kSize = 48;

struct Deviation {
    float largest = 0.0f; // |made - whole| / max(1, whole)
    float brightest = 0.0f;
    int surfaces = 0;
};

ImagePtr pattern(int channels, const std::function<float(int x, int y, int channel)>& value,
                 ColorEncoding encoding = ColorEncoding::Data) {
    return makeImage(16, 16, channels, PixelType::F32, encoding, value);
}

// A built-in environment in 64 × 32 pixels: its light is not what is judged here.
ImagePtr sky(const std::string& name) {
    static std::map<std::string, ImagePtr> kept;
    ImagePtr& small = kept[name];
    if (!small) {
        const auto whole = library::environment(name);
        EXPECT_TRUE(whole.ok());
        const int of = (*whole)->width() / 64;
        EXPECT_EQ((*whole)->height(), 32 * of);
        small =
            makeImage(64, 32, 3, PixelType::F32, ColorEncoding::Linear, [&](int x, int y, int c) {
                float sum = 0.0f;
                for (int j = 0; j < of; ++j)
                    for (int i = 0; i < of; ++i)
                        sum += (*whole)->sample(of * x + i, of * y + j, c);
                return sum / static_cast<float>(of * of);
            });
    }
    return small;
}

Material material(const char* name) {
    Material m;
    m.name = name;
    return m;
}

// Dielectric; metal; rough; textured with normal map and occlusion; emissive and see-through.
std::vector<Material> fiveMaterials() {
    std::vector<Material> all;
    Material& plastic = all.emplace_back(material("dielectric"));
    plastic.baseColor = {0.1f, 0.35f, 0.7f};
    plastic.perceptualRoughness = 0.25f;
    Material& gold = all.emplace_back(material("metal"));
    gold.baseColor = {1.0f, 0.77f, 0.34f};
    gold.metallic = 1.0f;
    gold.perceptualRoughness = 0.35f;
    Material& rough = all.emplace_back(material("rough"));
    rough.baseColor = {0.8f, 0.6f, 0.5f};
    rough.metallic = 0.5f;
    rough.perceptualRoughness = 1.0f;
    Material& textured = all.emplace_back(material("textured"));
    textured.baseColorMap.image = pattern(
        3, [](int x, int y, int c) { return (x + y) % 2 != 0 ? 0.9f : 0.1f + 0.2f * float(c); },
        ColorEncoding::Linear);
    textured.metallicMap.image = textured.perceptualRoughnessMap.image =
        textured.occlusionMap.image = pattern(3, [](int x, int y, int c) {
            return c == 0 ? 0.3f + 0.04f * float(y) : 0.06f * float(c == 1 ? x : y);
        });
    textured.metallic = 1.0f;
    textured.perceptualRoughness = 1.0f;
    textured.normalMap.image = pattern(3, [](int x, int y, int c) {
        return c == 2 ? 0.95f : 0.5f + 0.15f * float((c == 0 ? x : y) % 3 - 1);
    });
    Material& lamp = all.emplace_back(material("emissive"));
    lamp.baseColor = {0.3f, 0.8f, 0.4f};
    lamp.opacity = 0.4f;
    lamp.alphaMode = AlphaMode::Blend;
    lamp.emissive = {2.0f, 0.6f, 0.1f};
    return all;
}

// A sun with a shadow, a bulb, a glowing sphere and a glowing rectangle.
std::vector<Light> lights(Document& document) {
    std::vector<Light> all(4);
    for (Light& light : all)
        light.id = document.takeId();
    all[0].type = LightType::Directional;
    all[0].intensity = 3.0f;
    all[0].azimuthDeg = 40.0f;
    all[0].elevationDeg = 30.0f;
    all[1].type = LightType::Point;
    all[1].intensity = 4.0f;
    all[1].position = {-1.5f, 1.5f, 2.0f};
    all[2].type = LightType::Sphere;
    all[2].position = {2.0f, 0.5f, 1.5f};
    all[3].type = LightType::Rectangle;
    all[3].position = {0.0f, 2.5f, 1.0f};
    all[3].elevationDeg = 80.0f;
    return all;
}

class Equations : public RenderTest {
  protected:
    // A sphere, and a small one that throws its shadow on it.
    static Document scene(const Material& material) {
        Document document = makeScene(makeSphere());
        const Id id = document.materials[0].id;
        document.materials[0] = material;
        document.materials[0].id = id;
        MeshInstance small = document.meshes[0];
        small.id = document.takeId();
        small.placement = glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(0.9f, 0.8f, 1.1f)),
                                     glm::vec3(0.25f));
        document.meshes.push_back(small);
        document.view.background = BackgroundMode::Color;
        document.view.backgroundColor = glm::vec3(0.0f);
        return document;
    }

    const Image& view(ViewKind kind) {
        auto [found, isNew] = m_views.try_emplace(kind);
        if (isNew) {
            auto image = renderer().readView(kind);
            EXPECT_TRUE(image.ok()) << viewInfo(kind).id;
            if (image.ok())
                found->second = std::move(image).value();
        }
        return found->second;
    }
    Image drawNew(const Document& document, const ViewSettings& look = {}) {
        m_views.clear();
        FrameSettings settings;
        settings.samples = 1;
        settings.view = look;
        return draw(document, kSize, settings);
    }

    glm::vec3 evaluate(const Equation& equation, int x, int y) {
        glm::vec3 made(0.0f);
        for (const EquationPart& part : equation.parts) {
            const glm::vec3 number = part.constant * glm::vec3(pixel(view(part.kind), x, y));
            made = part.join == Join::Plus    ? made + number
                   : part.join == Join::Times ? made * number
                                              : made / number;
        }
        return made;
    }

    // Against the result's view; or against the picture that is shown.
    Deviation deviation(const Equation& equation, const Image* picture = nullptr) {
        Deviation result;
        const Image& whole = picture ? *picture : view(equation.result);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                if (pixel(view(kViewNoV), x, y).a == 0.0f)
                    continue;
                ++result.surfaces;
                const glm::vec3 made = evaluate(equation, x, y), wanted(pixel(whole, x, y));
                for (int c = 0; c < 3; ++c) {
                    const float off = std::abs(made[c] - wanted[c]) / std::max(1.0f, wanted[c]);
                    result.largest = off <= result.largest ? result.largest : off; // NaN counts
                    result.brightest = std::max(result.brightest, wanted[c]);
                }
            }
        return result;
    }

  private:
    std::map<ViewKind, Image> m_views;
};

TEST_F(Equations, TermsAddUpToThePictureForFiveMaterialsInThreeEnvironments) {
    const Equation sum = *equationOf(kViewFinal, {});
    Deviation worst, worstShown;
    for (const char* name : {"studio", "clear-sky", "night"}) {
        const ImagePtr image = sky(name);
        Document first = scene({});
        first.environment().image = image;
        setIblOf(first);
        for (const Material& material : fiveMaterials())
            for (const bool lit : {false, true}) {
                Document document = scene(material);
                document.environment().image = image;
                if (lit)
                    document.lights = lights(document);
                const Image picture = drawNew(document);
                const Deviation numbers = deviation(sum), shown = deviation(sum, &picture);
                const std::string where =
                    name + (" " + material.name) + (lit ? " with lights" : " without lights");
                EXPECT_LE(numbers.largest, 1e-3f) << where;
                EXPECT_LE(shown.largest, 1e-3f) << where; // half floats
                EXPECT_GT(numbers.surfaces, 600) << where;
                EXPECT_GT(numbers.brightest, 1e-3f) << where;
                worst.largest = std::max(worst.largest, numbers.largest);
                worstShown.largest = std::max(worstShown.largest, shown.largest);
            }
    }
    std::printf(
        "[ figures  ] |sum - final| / max(1, final): %.2e of the view, %.2e of the picture\n",
        double(worst.largest), double(worstShown.largest));
}

// Transfer holds the diffuse light of the lights, whose own term is then nothing; their highlights
// stay. The big sphere is baked, the small one only where every mesh is.
TEST_F(Equations, TermsAndFactorsAddUpUnderTransfer) {
    const Equation sum = *equationOf(kViewFinal, {});
    Document lit = scene({});
    lit.environment().image = sky("studio");
    setIblOf(lit);
    const std::vector<Material> materials = fiveMaterials();
    for (const LightingMode mode :
         {LightingMode::Unshadowed, LightingMode::Shadowed, LightingMode::Prt})
        for (const std::size_t i : {0u, 3u, 4u}) {
            Document document = scene(materials[i]);
            document.environment().image = lit.environment().image;
            document.lights = lights(document);
            document.view.lighting = mode;
            document.bakes = {openBake(document, 4, 0.3f)};
            const std::string where = materials[i].name + " " + std::to_string(int(mode));
            ViewSettings look;
            look.light = document.lights[0].id;
            const Image picture = drawNew(document, look);
            EXPECT_LE(deviation(sum).largest, 1e-3f) << where;
            EXPECT_LE(deviation(sum, &picture).largest, 1e-3f) << where;
            for (const ViewKind none : {kViewDirectDiffuse, kViewLightDiffuse}) {
                const EquationPart part{Join::Plus, none};
                EXPECT_EQ(deviation({none, none, {&part, 1}}).brightest, 0.0f) << where;
                EXPECT_NE(whyEmpty(none, document), "") << where;
            }
            EXPECT_EQ(whyEmpty(kViewDirectSpecular, document), "");
            for (const ViewKind opened : {kViewDiffuseIbl, kViewDirectSpecular}) {
                if (materials[i].alphaMode == AlphaMode::Blend)
                    continue; // its terms are weighed by opacity
                const Deviation off = deviation(*equationOf(opened, {}));
                EXPECT_LE(off.largest, 1e-3f) << viewInfo(opened).id << ' ' << where;
                EXPECT_GT(off.brightest, 1e-3f) << viewInfo(opened).id << ' ' << where;
            }
            if (mode == LightingMode::Unshadowed)
                continue;
            // A mesh that no bake lights has its lights' diffuse light as ever.
            auto half = std::make_shared<BakeArtifact>(*document.bakes[0]);
            half->vertices.pop_back();
            document.bakes = {half};
            drawNew(document);
            EXPECT_LE(deviation(sum).largest, 1e-3f) << where;
            const EquationPart part{Join::Plus, kViewDirectDiffuse};
            EXPECT_GT(deviation({kViewDirectDiffuse, kViewDirectDiffuse, {&part, 1}}).brightest,
                      1e-3f);
            EXPECT_EQ(whyEmpty(kViewDirectDiffuse, document), "");
        }
}

TEST_F(Equations, SwitchedOffTermsAreMissingInTheSum) {
    const Equation sum = *equationOf(kViewFinal, {});
    Document document = scene(fiveMaterials()[4]);
    document.materials[0].alphaMode = AlphaMode::Opaque;
    document.lights = lights(document);
    document.environment().image = sky("studio");
    setIblOf(document);
    for (std::size_t off = 0; off < kTermCount; ++off) {
        ViewSettings look;
        look.terms[off] = false;
        drawNew(document, look);
        std::vector<EquationPart> others(sum.parts.begin(), sum.parts.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(off));
        EXPECT_LE(deviation({kViewFinal, kViewFinal, others}).largest, 1e-5f) << off;
        EXPECT_GT(deviation(sum).largest, 0.01f) << off << ": the term is worth something";
    }
}

std::vector<ShadingModel> models() {
    std::vector<ShadingModel> all(5);
    all[1].diffuse = Diffuse::Burley;
    all[1].visibility = Visibility::SchlickDirect;
    all[2].diffuse = Diffuse::Eon;
    all[2].fresnel = Fresnel::Dielectric;
    all[3].diffuse = Diffuse::OrenNayar;
    all[3].fresnel = Fresnel::SchlickF90;
    all[3].f90 = 0.7f;
    all[3].distribution = Distribution::Beckmann;
    all[4].fresnel = Fresnel::Conductor;
    all[4].multiScatter = false;
    all[4].lobeDirection = LobeDirection::Mirror;
    return all;
}

TEST_F(Equations, FactorsMultiplyToTheirTerms) {
    Document document = scene({});
    document.environment().image = sky("studio");
    setIblOf(document);
    const std::vector<Material> materials = fiveMaterials();
    float worst = 0.0f;
    const std::vector<ShadingModel> all = models();
    for (std::size_t m = 0; m < all.size(); ++m)
        for (std::size_t i = 0; i < 4; ++i) { // opaque ones
            // All with the first model; with each other one the rough one, which has every term,
            // and one that its own terms show on.
            if (m > 0 && i != 2 && i != (m == 4 ? 1u : 0u))
                continue;
            const ShadingModel& model = all[m];
            document = scene(materials[i]);
            document.materials[0].diffuseRoughness = 0.6f;
            document.model = model;
            document.lights = lights(document);
            for (const std::size_t lamp : {0u, 1u}) {
                ViewSettings look;
                look.light = document.lights[lamp].id;
                drawNew(document, look);
                for (const ViewKind opened :
                     {kViewDiffuseIbl, kViewSpecularIbl, kViewSingleScatterAlbedo,
                      kViewDirectDiffuse, kViewDirectSpecular}) {
                    const Deviation off = deviation(*equationOf(opened, model));
                    EXPECT_LE(off.largest, 1e-3f) << viewInfo(opened).id << ' ' << materials[i].name
                                                  << ", light " << lamp << ", model " << m;
                    EXPECT_GT(off.brightest, materials[i].metallic == 1.0f ? -1.0f : 1e-3f);
                    worst = std::max(worst, off.largest);
                }
            }
        }
    std::printf("[ figures  ] |product - term| / max(1, term): %.2e\n", double(worst));
}

// With one light, its share is the whole term.
TEST_F(Equations, TheOnlyLightIsTheWholeOfDirectLight) {
    Document document = scene(fiveMaterials()[0]);
    document.lights = {lights(document)[0]};
    ViewSettings look;
    look.light = document.lights[0].id;
    drawNew(document, look);
    for (const auto& [whole, share] : {std::pair{kViewDirectDiffuse, kViewLightDiffuse},
                                       std::pair{kViewDirectSpecular, kViewLightSpecular}}) {
        const EquationPart part{Join::Plus, share};
        const Deviation off = deviation({whole, whole, {&part, 1}});
        EXPECT_EQ(off.largest, 0.0f);
        EXPECT_GT(off.brightest, 0.1f);
    }
}

TEST(Equation, SumsThatAreMultipliedStandInBrackets) {
    ShadingModel exact;
    exact.fresnel = Fresnel::Dielectric;
    const Equation mean = *equationOf(kViewSingleScatterAlbedo, exact); // (A + B) x F
    EXPECT_FALSE(closesBracket(mean, 0));
    EXPECT_FALSE(closesBracket(mean, 1));
    EXPECT_TRUE(closesBracket(mean, 2));
    for (const ViewKind opened : {kViewFinal, kViewSingleScatterAlbedo, kViewDirectSpecular}) {
        const Equation flat = *equationOf(opened, {}); // F0 x A + B
        for (std::size_t i = 0; i < flat.parts.size(); ++i)
            EXPECT_FALSE(closesBracket(flat, i)) << viewInfo(opened).id << ' ' << i;
    }
    EXPECT_FALSE(equationOf(kViewMetallic, {}));
}

} // namespace
