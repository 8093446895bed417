// The explanation of a pixel: that its numbers are the picture's, and that it notices when they are
// not.
#include "render/view/Explanation.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/MaterialInputs.h"
#include "render/FollowedRadiosity.h"
#include "render/view/Recombine.h"
#include "tests/core/document/RandomDocument.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

using namespace patina;
using namespace patina::render;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

constexpr int kSize = 64;

FrameSettings oneSample() {
    FrameSettings settings;
    settings.samples = 1;
    return settings;
}

Light light(Document& document, LightType type, const glm::vec3& position, float intensity) {
    Light result;
    result.id = document.takeId();
    result.name = "Light " + std::to_string(result.id);
    result.type = type;
    result.position = position;
    result.intensity = intensity;
    return result;
}

// One light of each type.
void addLights(Document& document) {
    Light sun = light(document, LightType::Directional, {}, 2.0f);
    sun.azimuthDeg = 50.0f;
    sun.elevationDeg = 30.0f;
    Light bulb = light(document, LightType::Point, {-1.5f, 1.0f, 1.5f}, 4.0f);
    bulb.range = 6.0f;
    bulb.color = {1.0f, 0.6f, 0.3f};
    Light spot = light(document, LightType::Spot, {1.5f, 2.0f, 2.0f}, 9.0f);
    setDirectionToLight(spot, spot.position);
    Light ball = light(document, LightType::Sphere, {2.0f, 0.5f, 1.0f}, 3.0f);
    Light panel = light(document, LightType::Rectangle, {-2.0f, 0.5f, 1.0f}, 5.0f);
    setDirectionToLight(panel, -panel.position);
    panel.azimuthDeg += 180.0f;
    document.lights = {sun, bulb, spot, ball, panel};
}

Document litScene() {
    Document document = makeScene(makeSphere(20));
    document.environment().image = makeEnvironment(32, [](const glm::vec3& d) {
        return glm::vec3(0.4f + 0.3f * d.y, 0.5f + 0.2f * d.x, 0.8f + 0.5f * d.z);
    });
    document.view.background = BackgroundMode::Environment;
    document.environment().rotationDeg = 25.0f;
    document.environment().exposureEv = 0.5f;
    document.view.camera.distance = 4.2f;
    addLights(document);
    return document;
}

ImagePtr noise(int channels, ColorEncoding encoding) {
    return makeImage(32, 16, channels, PixelType::U8, encoding, [](int x, int y, int c) {
        return static_cast<float>((x * 37 + y * 61 + c * 97) % 200 + 40) / 255.0f;
    });
}

// Five materials that use different parts of the equation.
void applyMaterial(Document& document, int which) {
    Material& m = document.materials[0];
    m.baseColor = {0.8f, 0.5f, 0.2f};
    switch (which) {
    case 0: // every map
        m.baseColorMap.image = noise(4, ColorEncoding::Srgb);
        m.baseColorMap.uvScale = {2.0f, 3.0f};
        m.baseColorMap.uvRotationDeg = 30.0f;
        m.metallic = m.perceptualRoughness = 1.0f;
        m.metallicMap.image = m.perceptualRoughnessMap.image = m.occlusionMap.image =
            noise(3, ColorEncoding::Data);
        m.metallicMap.channel = MapChannel::B;
        m.perceptualRoughnessMap.channel = MapChannel::G;
        m.normalMap.image = noise(3, ColorEncoding::Data);
        m.normalStrength = 0.3f;
        m.emissive = {0.2f, 0.3f, 0.1f};
        m.emissiveMap.image = noise(3, ColorEncoding::Srgb);
        break;
    case 1: // a smooth metal
        m.metallic = 1.0f;
        m.perceptualRoughness = 0.12f;
        break;
    case 2: // rough, by the exact equations
        m.perceptualRoughness = 0.9f;
        m.diffuseRoughness = 0.7f;
        document.model.diffuse = Diffuse::Eon;
        document.model.fresnel = Fresnel::Dielectric;
        document.model.ior = 1.8f;
        break;
    case 3: // half transparent
        m.opacity = 0.6f;
        m.alphaMode = AlphaMode::Blend;
        m.perceptualRoughness = 0.3f;
        m.metallic = 0.5f;
        break;
    default: // other terms
        m.metallic = 0.7f;
        m.perceptualRoughness = 0.5f;
        document.model.distribution = Distribution::Beckmann;
        document.model.visibility = Visibility::SmithSeparable;
        document.model.diffuse = Diffuse::Burley;
        document.model.multiScatter = false;
        document.model.lobeDirection = LobeDirection::Mirror;
    }
}

// Names of the steps that the CPU does not come out with.
std::string disagreements(const Explanation& explanation) {
    std::string names;
    for (const ExplainedSection& section : explanation.sections)
        for (const ExplainedStep& step : section.steps)
            if (!step.agrees)
                names += section.key + "." + step.key + " ";
    return names;
}

const ExplainedSection* section(const Explanation& explanation, const std::string& key) {
    for (const ExplainedSection& section : explanation.sections)
        if (section.key == key)
            return &section;
    return nullptr;
}

const ExplainedStep* step(const Explanation& explanation, const std::string& in,
                          const std::string& key) {
    if (const ExplainedSection* found = section(explanation, in))
        for (const ExplainedStep& step : found->steps)
            if (step.key == key)
                return &step;
    return nullptr;
}

class Explanations : public RenderTest {
  protected:
    Inspection inspect(int x, int y) {
        Result<Inspection> result = renderer().inspect(x, y);
        EXPECT_TRUE(result.ok()) << result.error().text();
        return std::move(*result);
    }
    Inspection inspectCenter(const Document& document) {
        setIblOf(document);
        draw(document, kSize, oneSample());
        return inspect(kSize / 2, kSize / 2);
    }
};

TEST_F(Explanations, RecombineToThePictureAtAThousandPixels) {
    std::mt19937 random(4);
    const auto coordinate = [&] { return static_cast<int>(random() % kSize); };
    int surfaces = 0;
    float largest = 0.0f;
    for (int material = 0; material < 5; ++material)
        for (int curve = 0; curve < static_cast<int>(ToneMap::OpenColorIo); ++curve) {
            Document document = litScene();
            applyMaterial(document, material);
            document.view.toneMap = static_cast<ToneMap>(curve);
            document.view.exposureEv = material % 2 == 0 ? -1.0f : 0.4f;
            if (curve % 2 == 1)
                document.view.exposureMode = ExposureMode::Automatic;
            if (material == 1)
                document.view.displayTransfer = DisplayTransfer::Gamma;
            if (curve == 0)
                setIblOf(document);
            draw(document, kSize, oneSample());
            const Image shown = renderer().readDisplayed();
            for (int i = 0; i < 30;) {
                const int x = coordinate(), y = coordinate();
                const glm::vec2 off(static_cast<float>(x) - 31.5f, static_cast<float>(y) - 31.5f);
                if (glm::length(off) > 27.0f)
                    continue;
                ++i;
                const Inspection pixel = inspect(x, y);
                ASSERT_TRUE(pixel.onSurface()) << x << ' ' << y;
                ++surfaces;
                const RebuiltPixel rebuilt = recombine(pixel, document);
                ASSERT_TRUE(rebuilt.displayed.has_value());
                for (int c = 0; c < 3; ++c) {
                    const float apart =
                        std::abs((*rebuilt.displayed)[c] - shown.sample(x, y, c)) * 255.0f;
                    largest = std::max(largest, apart);
                    ASSERT_LE(apart, 1.0f) << material << ' ' << curve << ' ' << x << ' ' << y;
                }
                const Explanation explanation = explain(pixel, document);
                ASSERT_EQ(disagreements(explanation), "") << toText(explanation);
                glm::vec3 sum(0.0f);
                for (const Contribution& part : explanation.contributions)
                    sum += part.radiance;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(sum[c], pixel.radiance[c], 1e-3f * std::max(0.1f, sum[c]));
            }
        }
    EXPECT_GE(surfaces, 1000);
    printf("%d pixels, largest difference %.3f of 255\n", surfaces, double(largest));
}

// Any values of the material and of the shading model that the parameter table takes, and any maps.
TEST_F(Explanations, RecombineForRandomMaterials) {
    const char* seedText = std::getenv("PATINA_TEST_SEED");
    const char* countText = std::getenv("PATINA_EXPLAINED_MATERIALS");
    const int first = seedText != nullptr ? std::atoi(seedText) : 1;
    const int count = countText != nullptr ? std::atoi(countText) : 2; // each compiles
    const ImagePtr color = noise(4, ColorEncoding::Srgb), data = noise(3, ColorEncoding::Data);
    int surfaces = 0;
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE("PATINA_TEST_SEED=" + std::to_string(seed));
        RandomDocument random(static_cast<std::uint32_t>(seed));
        Document document = litScene();
        for (const ParameterInfo& info : parameters())
            for (const Id id : RandomDocument::idsOf(document, info.scope)) {
                if (info.scope != Scope::Material && info.scope != Scope::Model)
                    continue;
                if (info.type == ParameterType::Float)
                    info.set(document, id, random.between(info.softMin, info.softMax));
                else if (info.type != ParameterType::Map)
                    info.set(document, id, random.value(info, document));
            }
        Material& m = document.materials[0];
        for (const MaterialInputInfo& info : kMaterialInputs) {
            if (random.below(3) == 0)
                continue;
            MapSlot& map = m.*info.map;
            map.source = std::string(info.id) + ".png";
            map.image = info.encoding == ColorEncoding::Srgb ? color : data;
            map.channel = info.role == InputRole::Normal || random.below(2) == 0
                              ? info.channel
                              : static_cast<MapChannel>(random.below(4)); // no alpha in data
            if (random.below(2) == 0)
                map.uvScale = {random.between(0.5f, 3.0f), random.between(0.5f, 3.0f)};
        }
        setIblOf(document);
        draw(document, kSize, oneSample());
        for (const glm::ivec2 at : {glm::ivec2(32, 32), {20, 24}, {44, 36}, {30, 50}}) {
            const Inspection pixel = inspect(at.x, at.y);
            if (!pixel.onSurface()) // a hole, or nothing but glass
                continue;
            ++surfaces;
            const Explanation explanation = explain(pixel, document);
            EXPECT_EQ(disagreements(explanation), "") << toText(explanation);
            glm::vec3 sum(0.0f);
            for (const Contribution& part : explanation.contributions)
                sum += part.radiance;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum[c], pixel.radiance[c], 2e-3f * std::max(0.1f, std::abs(sum[c])));
            for (const MaterialInputInfo& info : kMaterialInputs)
                EXPECT_EQ(step(explanation, "maps", std::string(info.view)) != nullptr,
                          (m.*info.map).assigned())
                    << info.id;
        }
    }
    EXPECT_GE(surfaces, count);
}

// Shading reads every number and every map of the table.
TEST_F(Explanations, EveryInputReachesThePicture) {
    Document document = litScene();
    Material& m = document.materials[0];
    m.emissive = glm::vec3(0.5f);
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.role == InputRole::Number)
            m.*info.number = 0.8f;
        (m.*info.map).image = noise(3, info.encoding);
        (m.*info.map).channel = info.channel;
    }
    setIblOf(document);
    const Image whole = draw(document, kSize, oneSample());
    for (const MaterialInputInfo& info : kMaterialInputs) {
        Document changed = document;
        (changed.materials[0].*info.map).image = nullptr;
        EXPECT_NE(draw(changed, kSize, oneSample()), whole) << "the map of " << info.id;
        changed = document;
        if (info.color != nullptr)
            changed.materials[0].*info.color *= 0.5f;
        else
            changed.materials[0].*info.number *= 0.5f;
        EXPECT_NE(draw(changed, kSize, oneSample()), whole) << info.id;
    }
}

// Of the table of views: what is looked at is recorded by the shader, and the pixel panel tells it.
TEST_F(Explanations, EveryViewThatAppliesIsRecordedAndExplained) {
    std::set<ViewKind> applied;
    for (const LightingMode mode :
         {LightingMode::Ibl, LightingMode::Prt, LightingMode::Radiosity}) {
        Document document = litScene();
        applyMaterial(document, 0);
        document.materials[0].transmission = 0.5f;
        document.view.lighting = mode;
        BakeArtifact bake = *openBake(document, 5, 0.2f);
        for (VertexBake& element : bake.vertices) {
            const std::size_t vertices = document.meshes[0].mesh->vertexCount();
            element.sky.assign(vertices, 0.5f);
            element.error.assign(vertices, 0.01f);
        }
        document.bakes = {std::make_shared<const BakeArtifact>(std::move(bake))};
        FollowedRadiosity radiosity;
        ASSERT_TRUE(radiosity.update(sceneRenderer(), document, {}, {}));
        const Inspection pixel = inspectCenter(document);
        const Explanation explanation = explain(pixel, document);
        std::set<std::string> told;
        for (const ExplainedSection& section : explanation.sections) {
            for (const ExplainedValue& value : section.values)
                told.insert(value.key);
            for (const ExplainedStep& step : section.steps) {
                told.insert(step.key);
                told.insert(step.result.key);
                for (const ExplainedValue& factor : step.factors)
                    told.insert(factor.key);
            }
        }
        for (const Contribution& part : explanation.contributions)
            told.insert(part.key);
        for (const ViewInfo& info : views()) {
            if (!info.isRecorded() || !whyEmpty(info.kind, document).empty() ||
                (info.ofElements && mode != LightingMode::Radiosity))
                continue;
            applied.insert(info.kind);
            if (info.kind == shading::kViewFinal || !info.coversSurface)
                continue; // the sum; a pattern
            EXPECT_TRUE(pixel.recorded[static_cast<std::size_t>(info.kind)])
                << info.id << " has no record() in shaders/include/records.glsl";
            EXPECT_THAT(told, testing::Contains(std::string(info.id)))
                << "no row of the explanation is about it";
        }
    }
    for (const ViewInfo& info : views())
        EXPECT_EQ(applied.count(info.kind), info.isRecorded() ? 1u : 0u)
            << info.id << " applies to neither scene: give one of them what it needs";
}

// The frames of a drag have fewer triangles, whose texture coordinates and normals are others.
TEST_F(Explanations, RecombineAtPixelsOfACoarseFrame) {
    Document document = litScene();
    document.meshes[0].mesh = makeSphere(128);
    applyMaterial(document, 0);
    setIblOf(document);
    FrameSettings frame = oneSample();
    const Image fine = draw(document, kSize, frame);
    frame.coarse = true;
    ASSERT_NE(draw(document, kSize, frame), fine);
    for (const glm::ivec2 at : {glm::ivec2(32, 32), {20, 24}, {44, 36}, {30, 50}, {41, 45}}) {
        const Explanation explanation = explain(inspect(at.x, at.y), document);
        EXPECT_EQ(disagreements(explanation), "") << toText(explanation);
    }
}

TEST_F(Explanations, RecombineUnderTransferWithLights) {
    float largest = 0.0f;
    for (const int material : {0, 2, 3})
        for (const LightingMode mode :
             {LightingMode::Unshadowed, LightingMode::Shadowed, LightingMode::Prt}) {
            Document document = litScene();
            applyMaterial(document, material);
            document.view.exposureEv = -1.0f;
            document.view.reflectionMix = material == 2 ? 0.3f : 0.5f;
            document.view.lighting = mode;
            document.bakes = {openBake(document, 5, 0.2f)};
            setIblOf(document);
            draw(document, kSize, oneSample());
            const Image shown = renderer().readDisplayed();
            for (const glm::ivec2 at : {glm::ivec2(32, 32), {20, 24}, {44, 36}, {30, 50}}) {
                const Inspection pixel = inspect(at.x, at.y);
                ASSERT_TRUE(pixel.onSurface());
                ASSERT_EQ(pixel.lights.size(), 5u);
                const RebuiltPixel rebuilt = recombine(pixel, document);
                EXPECT_TRUE(rebuilt.transfer);
                for (int c = 0; c < 3; ++c) {
                    const float apart =
                        std::abs((*rebuilt.displayed)[c] - shown.sample(at.x, at.y, c)) * 255.0f;
                    largest = std::max(largest, apart);
                    EXPECT_LE(apart, 1.0f) << material << ' ' << static_cast<int>(mode);
                }
                const Explanation explanation = explain(pixel, document);
                EXPECT_EQ(disagreements(explanation), "") << toText(explanation);
                EXPECT_THAT(toText(explanation), HasSubstr("In Diffuse IBL"));
                EXPECT_EQ(
                    step(explanation, "light" + std::to_string(pixel.lights[3].light), "diffuse"),
                    nullptr);
                glm::vec3 sum(0.0f);
                for (const Contribution& part : explanation.contributions)
                    sum += part.radiance;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(sum[c], pixel.radiance[c], 1e-3f * std::max(0.1f, sum[c]));
            }
        }
    printf("largest difference under transfer %.3f of 255\n", double(largest));
}

TEST_F(Explanations, NoticeANumberThatIsNotThePictures) {
    Document document = litScene();
    document.materials[0].metallic = 0.3f;
    document.materials[0].perceptualRoughness = 0.8f;
    const Inspection pixel = inspectCenter(document);
    EXPECT_TRUE(explain(pixel, document).agrees());

    // Each of these records is one factor of what is named beside it.
    const struct {
        int record;
        const char *in, *step;
    } cases[] = {{shading::kViewIrradiance, "environment", "diffuseIbl"},
                 {shading::kViewPrefiltered, "environment", "specularIbl"},
                 {shading::kViewF0, "surface", "f0"},
                 {shading::kRecordDiffuseColor, "surface", "diffuseColor"},
                 {shading::kRecordSpecularAlbedo, "environment", "specularAlbedo"},
                 {shading::kViewTransmission, "environment", "kd"},
                 {shading::kViewSpecularOcclusion, "environment", "specularOcclusion"}};
    for (const auto& c : cases) {
        Inspection changed = pixel;
        for (int i = 0; i < 3; ++i)
            changed.values[static_cast<std::size_t>(c.record)][i] *= 1.02f;
        const Explanation explanation = explain(changed, document);
        const ExplainedStep* found = step(explanation, c.in, c.step);
        ASSERT_NE(found, nullptr) << c.step;
        EXPECT_FALSE(found->agrees) << c.step;
        EXPECT_THAT(toText(explanation), HasSubstr("differs: the CPU computes"));
    }
    int bright = 0;
    for (std::size_t i = 0; i < pixel.lights.size(); ++i) {
        if (pixel.lights[i].specular.x < 0.02f * pixel.radiance.x)
            continue;
        ++bright;
        Inspection changed = pixel;
        changed.lights[i].specular *= 1.02f;
        const std::string key = "light" + std::to_string(pixel.lights[i].light);
        EXPECT_THAT(disagreements(explain(changed, document)), HasSubstr(key + ".specular"));
    }
    EXPECT_GE(bright, 2);
}

TEST_F(Explanations, ShowTheTexelOfEachMap) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    Material& m = document.materials[0];
    m.perceptualRoughness = 0.8f;
    // u grows to the right, v downwards: the left half is texel 0, the right half texel 1.
    m.perceptualRoughnessMap.source = "rough.png";
    m.perceptualRoughnessMap.channel = MapChannel::G;
    m.perceptualRoughnessMap.image =
        makeImage(2, 1, 3, PixelType::U8, ColorEncoding::Data,
                  [](int x, int, int c) { return c == 1 ? (x == 0 ? 0.2f : 0.6f) : 1.0f; });
    const auto texelAt = [&](int x) {
        draw(document, kSize, oneSample());
        return explain(inspect(x, 32), document);
    };
    const auto textOf = [&](const Explanation& explanation, const std::string& key) {
        const ExplainedStep* found = step(explanation, "maps", "perceptualRoughness");
        for (const ExplainedValue& factor : found->factors)
            if (factor.key == key)
                return factor.text;
        return std::string();
    };
    EXPECT_EQ(textOf(texelAt(24), "texel"), "0, 0 of 2 × 1");
    EXPECT_EQ(textOf(texelAt(24), "stored"), "255 51 255 of 255");
    EXPECT_EQ(textOf(texelAt(40), "texel"), "1, 0 of 2 × 1");
    EXPECT_EQ(textOf(texelAt(40), "stored"), "255 153 255 of 255");
    EXPECT_EQ(textOf(texelAt(40), "channel"), "green");
    EXPECT_EQ(textOf(texelAt(40), "file"), "rough.png");
    // Shifted by half, the texels change places.
    document.materials[0].perceptualRoughnessMap.uvOffset = {0.5f, 0.0f};
    EXPECT_EQ(textOf(texelAt(24), "texel"), "1, 0 of 2 × 1");
    // A file that could not be read says why.
    document.materials[0].perceptualRoughnessMap.image = nullptr;
    document.materials[0].perceptualRoughnessMap.problem = "it is no picture";
    EXPECT_THAT(step(texelAt(24), "maps", "perceptualRoughness")->note,
                HasSubstr("it is no picture"));
}

TEST_F(Explanations, SayWhichTermsAreSwitchedOff) {
    const Document document = litScene();
    setIblOf(document);
    FrameSettings settings = oneSample();
    settings.view.terms = {true, false, true, false, true};
    draw(document, kSize, settings);
    const Inspection pixel = inspect(32, 32);
    const Explanation explanation = explain(pixel, document);
    EXPECT_TRUE(explanation.agrees()) << disagreements(explanation);
    EXPECT_LE(explanation.difference.value_or(255.0f), 1.0f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(explanation.sum[c], pixel.radiance[c], 1e-4f);
    for (const Contribution& part : explanation.contributions) {
        EXPECT_EQ(part.on, part.key != "specularIbl") << part.key;
        if (part.key.starts_with("light")) {
            EXPECT_EQ(part.specular, glm::vec3(0.0f));
        }
    }
    EXPECT_THAT(toText(explanation),
                HasSubstr(std::string(viewInfo(shading::kViewSpecularIbl).label) + " (off)"));
}

TEST_F(Explanations, NameEachOfSixtyFourLights) {
    Document document = litScene();
    document.lights.clear();
    for (int i = 0; i < 64; ++i) {
        Light bulb = light(document, LightType::Point, {0.1f * static_cast<float>(i - 32), 1, 3},
                           0.1f + 0.01f * static_cast<float>(i));
        bulb.castsShadow = false;
        document.lights.push_back(bulb);
    }
    const Inspection pixel = inspectCenter(document);
    ASSERT_EQ(pixel.lights.size(), 64u);
    const Explanation explanation = explain(pixel, document);
    EXPECT_EQ(disagreements(explanation), "");
    EXPECT_LE(explanation.difference.value_or(255.0f), 1.0f);
    // Two terms of image-based light, the lights, emission.
    EXPECT_EQ(explanation.contributions.size(), 67u);
}

TEST_F(Explanations, ExplainTheBackground) {
    Document document = litScene();
    document.environment().exposureEv = 1.0f;
    document.environment().rotationDeg = 90.0f;
    setIblOf(document);
    draw(document, kSize, oneSample());
    const Inspection pixel = inspect(2, 3);
    EXPECT_FALSE(pixel.onSurface());
    const Explanation explanation = explain(pixel, document);
    const ExplainedSection* background = section(explanation, "background");
    ASSERT_NE(background, nullptr);
    const auto value = [&](const std::string& key) {
        for (const ExplainedValue& v : background->values)
            if (v.key == key)
                return glm::vec3(v.numbers[0], v.numbers[1], v.numbers[2]);
        return glm::vec3(-1.0f);
    };
    // The direction looks down on the environment turned by a quarter.
    const glm::vec3 d = value("direction"), turned(-d.z, d.y, d.x), texel = value("texel");
    EXPECT_LT(d.z, 0.0f);
    EXPECT_LT(d.x, 0.0f);
    EXPECT_GT(d.y, 0.0f);
    const glm::vec3 truth(0.4f + 0.3f * turned.y, 0.5f + 0.2f * turned.x, 0.8f + 0.5f * turned.z);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(texel[c], truth[c], 0.01f);
        EXPECT_NEAR(value("background")[c], 2.0f * truth[c], 0.02f);
    }
    EXPECT_TRUE(explanation.agrees());
    EXPECT_THAT(toText(explanation), HasSubstr("background"));

    document.view.background = BackgroundMode::Off;
    draw(document, kSize, oneSample());
    EXPECT_THAT(toText(explain(inspect(2, 3), document)), HasSubstr("transparent"));
}

TEST_F(Explanations, SurviveALightThatIsGone) {
    Document document = litScene();
    const Inspection pixel = inspectCenter(document);
    document.lights.erase(document.lights.begin());
    const Explanation explanation = explain(pixel, document);
    EXPECT_EQ(section(explanation, "light" + std::to_string(pixel.lights[0].light)), nullptr);
    EXPECT_NE(section(explanation, "light" + std::to_string(document.lights[0].id)), nullptr);
    document.materials.clear();
    EXPECT_EQ(explain(pixel, document).material, "");
}

TEST_F(Explanations, JsonIsKeyedByViews) {
    Document document = litScene();
    const Inspection pixel = inspectCenter(document);
    const auto json = nlohmann::json::parse(toJson(explain(pixel, document)));
    EXPECT_THAT(json["pixel"], ElementsAre(32, 32));
    EXPECT_THAT(json["size"], ElementsAre(kSize, kSize));
    const auto& surface = json["sections"]["surface"]["values"];
    EXPECT_NEAR(surface["nov"].get<float>(), pixel.value(shading::kViewNoV).x, 1e-6f);
    EXPECT_NEAR(surface["shadingNormal"][1].get<float>(),
                pixel.value(shading::kViewShadingNormal).y, 1e-6f);
    const auto& diffuse = json["sections"]["environment"]["steps"]["diffuseIbl"];
    EXPECT_EQ(diffuse["formula"], "ρd · kD · AO · E(n) / π");
    // The product of what is shown is what is shown.
    const float product = diffuse["factors"]["diffuseAlbedo"][0].get<float>() *
                          diffuse["factors"]["kd"][0].get<float>() *
                          diffuse["factors"]["ao"].get<float>() *
                          diffuse["factors"]["irradiance"][0].get<float>() / 3.14159265f;
    EXPECT_NEAR(diffuse["result"][0].get<float>() / product, 1.0f, 1e-4f);
    const auto& sun = json["sections"]["light" + std::to_string(document.lights[0].id)];
    const auto& factors = sun["steps"]["specular"]["factors"];
    const float specular = factors["d"].get<float>() * factors["visibility"].get<float>() *
                           factors["f"][2].get<float>() *
                           factors["multiScatterGain"][2].get<float>() *
                           factors["arriving"][2].get<float>() * factors["nol"].get<float>();
    EXPECT_NEAR(sun["steps"]["specular"]["result"][2].get<float>() / specular, 1.0f, 1e-3f);
    EXPECT_NEAR(sun["values"]["g"].get<float>(),
                4.0f * sun["values"]["nol"].get<float>() * sun["values"]["nov"].get<float>() *
                    factors["visibility"].get<float>(),
                1e-5f);
    EXPECT_EQ(json["agrees"], true);
    EXPECT_EQ(json["hex"].get<std::string>().size(), 7u);
}

TEST(ExplanationNumbers, AreShortAndHideNothing) {
    EXPECT_EQ(numberText(0.0f), "0.0000");
    EXPECT_EQ(numberText(0.5f), "0.5000");
    EXPECT_EQ(numberText(-12.25f), "-12.2500");
    EXPECT_EQ(numberText(0.00012f), "1.20e-04");
    EXPECT_EQ(numberText(2.5e7f), "2.50e+07");
    EXPECT_EQ(numberText(std::nanf("")), "NaN");
    EXPECT_EQ(numberText(INFINITY), "+Inf");
    EXPECT_EQ(numberText(-INFINITY), "-Inf");
    EXPECT_EQ(hexText({0.0f, 0.5f, 1.2f}), "#0080ff");
}

} // namespace
