#include "core/document/ViewChoices.h"
#include "core/light/DfgTable.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <cmath>

using namespace patina;
using namespace patina::render;

namespace {

using namespace patina::shading;

FrameSettings oneSample() {
    FrameSettings settings;
    settings.samples = 1;
    return settings;
}

class Views : public RenderTest {
  protected:
    // A rough metal-ish sphere under a lit sky, a sun with a shadow and a bulb.
    Document lit() {
        Document document = makeScene(makeSphere());
        Material& m = document.materials[0];
        m.baseColor = {0.8f, 0.5f, 0.2f};
        m.metallic = 0.4f;
        m.perceptualRoughness = 0.45f;
        m.emissive = {0.02f, 0.03f, 0.05f};
        document.environment().image = makeEnvironment(32, [](const glm::vec3& d) {
            return glm::vec3(0.4f + 0.3f * d.y, 0.5f + 0.2f * d.x, 0.8f + 0.5f * d.z);
        });
        document.view.background = BackgroundMode::Environment;
        Light sun;
        sun.id = document.takeId();
        sun.type = LightType::Directional;
        sun.intensity = 2.0f;
        sun.azimuthDeg = 40.0f;
        sun.elevationDeg = 35.0f;
        Light bulb;
        bulb.id = document.takeId();
        bulb.type = LightType::Point;
        bulb.intensity = 3.0f;
        bulb.position = {-2.0f, 1.0f, 1.5f};
        bulb.castsShadow = false;
        document.lights = {sun, bulb};
        return document;
    }

    Image view(ViewKind kind, ViewMode mode = ViewMode::Raw) {
        auto image = renderer().readView(kind, mode);
        EXPECT_TRUE(image.ok()) << (image.ok() ? std::string() : image.error().text());
        return image.ok() ? *image : Image();
    }
};

TEST_F(Views, TermsAddUpToThePicture) {
    Document document = lit();
    document.bakes = {openBake(document, 4, 0.2f)};
    setIblOf(document);
    for (const LightingMode mode :
         {LightingMode::Ibl, LightingMode::Unshadowed, LightingMode::Prt}) {
        document.view.lighting = mode;
        draw(document, 64, oneSample());
        const Image final = view(kViewFinal);
        std::array<Image, kTermCount> terms;
        for (std::size_t i = 0; i < terms.size(); ++i)
            terms[i] = view(kTermViews[i]);
        int surfaces = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                if (pixel(terms[0], x, y).a == 0.0f)
                    continue;
                ++surfaces;
                glm::vec3 sum(0.0f);
                for (const Image& term : terms)
                    sum += glm::vec3(pixel(term, x, y));
                const glm::vec3 whole(pixel(final, x, y));
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(sum[c], whole[c], 1e-5f * std::max(1.0f, whole[c]))
                        << x << ' ' << y;
            }
        EXPECT_GT(surfaces, 1000);
    }
}

TEST_F(Views, RecordTheTermsOfTheOrdinaryPicture) {
    const Document document = lit();
    setIblOf(document);
    const Image picture = draw(document, 64, oneSample()); // half floats
    const Image final = view(kViewFinal);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(pixel(picture, x, y)[c], pixel(final, x, y)[c],
                            1e-3f * std::max(0.05f, pixel(final, x, y)[c]))
                    << x << ' ' << y;
}

TEST_F(Views, AnInspectedPixelHasTheNumbersOfTheViews) {
    const Document document = lit();
    setIblOf(document);
    draw(document, 64, oneSample());
    std::vector<Image> images;
    for (ViewKind kind = 0; kind < kViewCount; ++kind)
        images.push_back(view(kind));
    for (const auto& [x, y] : {std::pair{32, 32}, {20, 40}, {44, 24}}) {
        const auto inspection = renderer().inspect(x, y);
        ASSERT_TRUE(inspection.ok()) << inspection.error().text();
        EXPECT_EQ(inspection->mesh, document.meshes[0].id);
        EXPECT_EQ(inspection->material, document.materials[0].id);
        ASSERT_EQ(inspection->lights.size(), 2u);
        for (const ViewInfo& info : views()) {
            // Judgements of the picture have no number, flat shading and other light are other
            // pictures, what has nothing to show says so in a pattern, and derivatives over a quad
            // of one pixel may differ.
            if (info.value == ViewValue::Picture || info.kind == kViewFlat ||
                info.group == ViewGroup::Lighting || info.kind == kViewUvChecker ||
                !whyEmpty(info.kind, document).empty())
                continue;
            const glm::vec4 seen = pixel(images[static_cast<std::size_t>(info.kind)], x, y);
            const glm::vec4 told = inspection->value(info.kind);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(told[c], seen[c], 2e-3f * std::max(1e-2f, std::abs(seen[c])))
                    << info.id << ' ' << x << ' ' << y;
        }
        glm::vec3 direct(0.0f);
        for (const LightShare& light : inspection->lights)
            direct += light.diffuse + light.specular;
        const glm::vec3 told(inspection->value(kViewDirect));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(direct[c], told[c], 1e-5f * std::max(1.0f, told[c]));
    }
    const auto background = renderer().inspect(0, 0);
    ASSERT_TRUE(background.ok());
    EXPECT_FALSE(background->onSurface());
    EXPECT_GT(background->radiance.g, 0.1f);
}

TEST_F(Views, FactorsAreThoseOfTheSharedFunctions) {
    const Document document = lit();
    setIblOf(document);
    FrameSettings settings = oneSample();
    settings.view.light = document.lights[0].id;
    draw(document, 64, settings);
    int lit = 0;
    for (int i = 0; i < 200; ++i) {
        const int x = 8 + (i * 29) % 48, y = 8 + (i * 17) % 48;
        const auto p = renderer().inspect(x, y);
        ASSERT_TRUE(p.ok());
        if (!p->onSurface() || p->value(kViewNoL).x <= 0.0f)
            continue;
        ++lit;
        const float NoV = p->value(kViewNoV).x, NoL = p->value(kViewNoL).x,
                    NoH = p->value(kViewNoH).x, VoH = p->value(kViewVoH).x;
        const float alpha = alphaFromPerceptualRoughness(p->value(kViewPerceptualRoughness).x);
        EXPECT_NEAR(p->value(kViewD).x / D_GGX(NoH, alpha), 1.0f, 1e-3f);
        EXPECT_NEAR(p->value(kViewG).x / (V_SmithGGXCorrelated(NoV, NoL, alpha) * 4.0f * NoL * NoV),
                    1.0f, 1e-3f);
        const glm::vec3 f0(p->value(kViewF0));
        EXPECT_NEAR(p->value(kViewF).x / F_Schlick(f0, 1.0f, VoH).x, 1.0f, 1e-3f);
    }
    EXPECT_GT(lit, 40);
}

TEST_F(Views, SwitchedOffTermsAreMissingInThePicture) {
    const Document document = lit();
    setIblOf(document);
    const Image whole = draw(document, 32, oneSample());
    const Image specular = view(kViewSpecularIbl);
    FrameSettings settings = oneSample();
    settings.view.terms[1] = false;
    const Image without = draw(document, 32, settings);
    const glm::vec4 a = centerPixel(whole), b = centerPixel(specular), c = centerPixel(without);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i] - b[i], c[i], 2e-3f);
    EXPECT_GT(b.x, 0.02f);
}

TEST_F(Views, ASplitShowsAViewOnEachSide) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.materials[0].metallic = 1.0f;
    document.materials[0].perceptualRoughness = 0.0f;
    FrameSettings settings = oneSample();
    settings.view.shown.kind = kViewMetallic; // left: white
    settings.view.split =
        ViewSplit{{kViewPerceptualRoughness, ViewMode::Raw, {}}, {0.5f, 0.5f}, 0.0f};
    draw(document, 64, settings);
    const Image straight = renderer().readDisplayed();
    EXPECT_GT(pixel(straight, 20, 32).x, 0.9f);
    EXPECT_LT(pixel(straight, 44, 32).x, 0.1f);
    // A quarter turn clockwise: what was right is below.
    settings.view.split->angleDeg = 90.0f;
    draw(document, 64, settings);
    const Image turned = renderer().readDisplayed();
    EXPECT_GT(pixel(turned, 32, 20).x, 0.9f);
    EXPECT_LT(pixel(turned, 32, 44).x, 0.1f);
}

TEST_F(Views, AWhiteMetalVanishesInTheFurnace) {
    Document document = makeScene(makeSphere());
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].metallic = 1.0f;
    document.materials[0].perceptualRoughness = 0.6f;
    document.lights.push_back({});
    document.lights[0].id = document.takeId();
    FrameSettings settings = oneSample();
    settings.view.furnace = glm::vec3(0.5f);
    const Image picture = draw(document, 64, settings);
    for (int y = 0; y < 64; y += 3)
        for (int x = 0; x < 64; x += 3)
            ASSERT_NEAR(pixel(picture, x, y).g, 0.5f, 0.5f * 0.006f) << x << ' ' << y;
}

// What hides the environment is as bright as it is: occlusion darkens nothing.
TEST_F(Views, AWhiteBodyWithOcclusionVanishesInTheFurnace) {
    Document document = makeScene(makeSphere());
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].metallic = 0.0f;
    Image dark(2, 2, 3, PixelType::U8, ColorEncoding::Data);
    std::fill(dark.u8().begin(), dark.u8().end(), std::uint8_t{40});
    document.materials[0].occlusionMap.image = std::make_shared<const Image>(dark);
    document.environment().image = makeEnvironment(8, [](auto) { return glm::vec3(0.5f); });
    setIblOf(document);
    FrameSettings settings = oneSample();
    settings.view.furnace = glm::vec3(0.5f, 0.25f, 1.0f);
    const Image picture = draw(document, 64, settings);
    for (int y = 0; y < 64; y += 3)
        for (int x = 0; x < 64; x += 3) {
            ASSERT_NEAR(pixel(picture, x, y).g, 0.25f, 0.25f * 0.006f) << x << ' ' << y;
            ASSERT_NEAR(pixel(picture, x, y).b, 1.0f, 0.006f) << x << ' ' << y;
        }
    settings.view = {};
    EXPECT_LT(pixel(draw(document, 64, settings), 32, 32).g, 0.2f); // elsewhere it darkens
}

TEST_F(Views, RangesFollowThePictureOrAreLocked) {
    const Document document = lit();
    setIblOf(document);
    FrameSettings settings = oneSample();
    settings.view.shown.kind = kViewDepth;
    draw(document, 64, settings);
    const auto range = renderer().shownRange();
    ASSERT_TRUE(range.has_value());
    const float distance = glm::length(document.view.camera.position());
    EXPECT_NEAR(range->min, distance - 1.0f, 0.05f);
    EXPECT_LT(range->max, distance + 0.5f);
    settings.view.shown.range = ViewRange{1.0f, 2.0f};
    draw(document, 64, settings);
    EXPECT_EQ(renderer().shownRange(), (ViewRange{1.0f, 2.0f}));
    settings.view.shown = {};
    draw(document, 64, settings);
    EXPECT_FALSE(renderer().shownRange().has_value());
}

TEST_F(Views, ASheetShowsWhatTheFrameWould) {
    const Document document = lit();
    setIblOf(document);
    FrameSettings settings = oneSample();
    settings.width = settings.height = 48;
    ViewSheet sheet{{kViewMetallic, kViewShadingNormal, kViewFlat, kViewDiffuseIbl, kViewD,
                     kViewFurnace, kViewMeshId, kViewNoV, kViewIrradiance, kViewAmbient},
                    ViewMode::Raw,
                    48,
                    48};
    draw(document, 48, settings);
    settings.camera = document.view.camera;
    const auto pictures = SheetRenderer(sceneRenderer()).draw(settings, sheet, renderer());
    ASSERT_TRUE(pictures.ok()) << pictures.error().text();
    ASSERT_EQ(pictures->size(), sheet.kinds.size());
    for (std::size_t i = 0; i < sheet.kinds.size(); ++i) {
        settings.view.shown.kind = sheet.kinds[i];
        draw(document, 48, settings);
        const Image alone = renderer().readDisplayed();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(centerPixel((*pictures)[i])[c], centerPixel(alone)[c], 2.01f / 255.0f)
                << viewInfo(sheet.kinds[i]).id;
    }
}

} // namespace
