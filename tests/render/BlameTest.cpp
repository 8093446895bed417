// Scenes in which a single shortcut of image-based light makes all of the error: blame finds it.
#include "core/trace/blame/Blame.h"

#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/material/ShadingModel.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "render/TermPictures.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <random>

namespace patina::render {
namespace {

constexpr int kBlamedSize = 32;

class BlameOfScenes : public RenderTest {
  protected:
    // Of a document that is lit by images; its environment's light is computed as the editor's is.
    Blame blameIn(const Document& document, std::uint32_t paths) {
        const Result<TraceScene> scene = TraceScene::build(traceInputs(document), {});
        EXPECT_TRUE(scene.ok());
        TraceView view;
        view.camera = document.view.camera;
        view.width = view.height = kBlamedSize;
        view.background = [](const glm::vec3&) { return glm::vec3(0.0f); };
        Film film(kBlamedSize, kBlamedSize);
        EXPECT_TRUE(tracePaths(*scene, view, {}, film, 0, paths, {}).ok());
        const Result<BlameFilm> traced = traceBlame(*scene, view, document.model, 0, paths, {});
        EXPECT_TRUE(traced.ok());

        WallRenderer cells(sceneRenderer());
        CellView cell;
        cell.frame.width = cell.frame.height = kBlamedSize;
        cell.frame.samples = 1;
        cell.frame.accumulate = cell.frame.floats = true;
        cell.frame.camera = document.view.camera;
        if (const ImagePtr& image = document.environment().image) {
            const auto maps = computeIbl(*image, {.cubeSize = m_cubeSize}, JobContext());
            EXPECT_TRUE(maps.ok());
            cell.light = std::make_shared<const EnvironmentTexels>(
                makeEnvironmentTexels(image, *maps, *makeBackground(*image, JobContext())));
        }
        cell.document = document;
        const Result<DrawnTerms> terms = drawTerms(
            cells, sceneRenderer(), cell, *drawFinePicture(cells, sceneRenderer(), cell, {}), {});
        EXPECT_TRUE(terms.ok());
        Result<Blame> made = blame(*terms, *traced, film, document.view, {}, {});
        EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
        expectSum(*made, terms->picture, film);
        return *std::move(made);
    }

    static void expectSum(const Blame& blame, const Image& picture, const Film& film) {
        for (std::size_t i = 0; i < film.pixels().size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = static_cast<double>(picture.f32()[4 * i + c]);
                for (const Image& step : blame.steps)
                    sum += static_cast<double>(step.f32()[3 * i + c]);
                const Film::Pixel& pixel = film.pixels()[i];
                const double traced = pixel.sum[static_cast<int>(c)] / pixel.samples;
                EXPECT_NEAR(sum, traced, 1e-3 * (1.0 + traced)) << i;
            }
    }

    static void expectAlone(const Blame& blame, BlameCause cause) {
        ASSERT_TRUE(blame.whole.isKnown) << "relative " << blame.whole.relative;
        EXPECT_EQ(blame.whole.largest(), cause);
        for (const BlameCauseInfo& info : blameCauses())
            if (info.cause == cause)
                EXPECT_GE(blame.whole.of(cause).share, 0.95) << info.name;
            else
                EXPECT_LE(std::abs(blame.whole.of(info.cause).share), 0.05) << info.name;
    }

    int m_cubeSize = 128;
};

// So near that no edge is seen: each renderer samples those in its own way.
void approach(Document& document) {
    document.view.camera.distance = 2.2f;
}

ImagePtr blackSky() {
    return makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(0.0f); });
}

// Reflects nothing but diffuse light: a dielectric of the air's index has no specular layer.
Document dullScene(const MeshPtr& mesh) {
    Document document = makeScene(mesh);
    document.model.fresnel = Fresnel::Dielectric;
    document.model.ior = 1.0f;
    document.view.background = BackgroundMode::Off;
    document.materials[0].metallic = 0.0f;
    document.materials[0].baseColor = glm::vec3(0.7f);
    document.materials[0].perceptualRoughness = 1.0f;
    return document;
}

// Reflects each colour in full at all angles.
Document metalScene(float roughness) {
    Document document = makeScene(makeSphere(128));
    document.view.background = BackgroundMode::Off;
    document.materials[0].metallic = 1.0f;
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].perceptualRoughness = roughness;
    approach(document);
    return document;
}

// A square over the plane y = 0, seen by nobody from above: it faces down.
void addCeiling(Document& document, const Material& material) {
    document.materials.push_back(material);
    document.materials.back().id = 12;
    MeshInstance instance;
    instance.id = 11;
    instance.mesh = makePlane();
    instance.material = 12;
    instance.placement = glm::mat4(0.4f, 0, 0, 0, 0, -0.4f, 0, 0, 0, 0, -0.4f, 0, 0, 0.5f, 0, 1);
    document.meshes.push_back(instance);
    document.nextId = 13;
}

} // namespace

// A black square hides a part of an even sky, and reflects nothing.
TEST_F(BlameOfScenes, OcclusionAlone) {
    Document document = dullScene(makePlane());
    document.view.camera = cameraAbove();
    document.environment().image =
        makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(1.0f); });
    Material black = document.materials[0];
    black.baseColor = glm::vec3(0.0f);
    addCeiling(document, black);
    const Blame blame = blameIn(document, 64);
    expectAlone(blame, BlameCause::Occlusion);
    EXPECT_GT(blame.whole.of(BlameCause::Occlusion).bias, 0.05) << "it is too bright";
    EXPECT_EQ(infoOf(BlameCause::Occlusion).remedy, BlameRemedy::BakeTransfer);
}

// An occlusion map that darkens what nothing hides: the half that the viewport does wrong itself.
TEST_F(BlameOfScenes, OcclusionMapAlone) {
    Document document = metalScene(0.4f);
    document.materials[0].metallic = 0.0f;
    document.materials[0].occlusionMap.image =
        makeImage(4, 4, 1, PixelType::U8, ColorEncoding::Data, [](int, int, int) { return 0.4f; });
    document.environment().image =
        makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(1.0f); });
    const Blame blame = blameIn(document, 64);
    expectAlone(blame, BlameCause::Occlusion);
    EXPECT_LT(blame.whole.of(BlameCause::Occlusion).bias, -0.3) << "it is too dark";
}

// A sphere's shadow, which the viewport does not have.
TEST_F(BlameOfScenes, LightsAlone) {
    Document document = dullScene(makePlane());
    document.view.camera = cameraAbove();
    Material black = document.materials[0];
    black.baseColor = glm::vec3(0.0f);
    addCeiling(document, black);
    Light lamp;
    lamp.id = 100;
    lamp.type = LightType::Sphere;
    lamp.radius = 0.2f;
    lamp.position = {0.8f, 1.5f, 0.3f};
    lamp.intensity = 10.0f;
    document.environment().image = blackSky();
    document.lights = {lamp};
    expectAlone(blameIn(document, 64), BlameCause::Lights);
}

// A small bright patch. A ball hides none of it from itself. Lambert's lobe makes no error; another
// one prefers directions, which an irradiance does not know.
TEST_F(BlameOfScenes, IrradianceAlone) {
    Document document = dullScene(makeSphere(128));
    approach(document);
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(glm::dot(d, glm::normalize(glm::vec3(1, 1, 1))) > 0.97f ? 20.0f : 0.02f);
    });
    const Blame lambert = blameIn(document, 64);
    EXPECT_LT(std::abs(lambert.whole.of(BlameCause::Irradiance).bias), 5e-3);
    EXPECT_LT(lambert.whole.of(BlameCause::Irradiance).relative, 0.01);
    document.model.diffuse = Diffuse::OrenNayar;
    document.materials[0].diffuseRoughness = 1.0f;
    expectAlone(blameIn(document, 64), BlameCause::Irradiance);
}

// Edges in a mirror, which the cube's coarse texels blur.
TEST_F(BlameOfScenes, FilteringAlone) {
    m_cubeSize = 16;
    Document document = metalScene(0.05f);
    document.environment().image = makeEnvironment(128, [](const glm::vec3& d) {
        return glm::vec3(std::sin(12.0f * d.x) * std::sin(12.0f * d.y) > 0.0f ? 1.0f : 0.1f);
    });
    const Blame blame = blameIn(document, 64);
    expectAlone(blame, BlameCause::Filtering);
    EXPECT_EQ(infoOf(BlameCause::Filtering).remedy, BlameRemedy::PathTracing);
}

// Rough metal under a sky that is bright on one side.
TEST_F(BlameOfScenes, LobeDirectionAlone) {
    Document document = metalScene(0.6f);
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(1.0f / (1.0f + std::exp(-6.0f * (d.x + d.y - 0.8f))));
    });
    expectAlone(blameIn(document, 128), BlameCause::LobeDirection);
}

// A glowing square, whose light no rasteriser sends to the plane.
TEST_F(BlameOfScenes, BouncesAlone) {
    Document document = dullScene(makePlane());
    document.view.camera = cameraAbove();
    Material glow = document.materials[0];
    glow.baseColor = glm::vec3(0.0f);
    glow.emissive = glm::vec3(4.0f);
    addCeiling(document, glow);
    document.environment().image = blackSky();
    expectAlone(blameIn(document, 64), BlameCause::Bounces);
}

// What is seen through glass is a wall, where the viewport shows the environment.
TEST_F(BlameOfScenes, TransmissionAlone) {
    Document document = metalScene(0.05f);
    document.materials[0].metallic = 0.0f;
    document.materials[0].transmission = 1.0f;
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(0.2f + 0.8f / (1.0f + std::exp(-8.0f * d.y)));
    });
    Material wall;
    wall.id = 12;
    wall.baseColor = {0.9f, 0.1f, 0.05f};
    document.materials.push_back(wall);
    MeshInstance instance;
    instance.id = 11;
    instance.mesh = makePlane();
    instance.material = 12;
    instance.placement = glm::mat4(9, 0, 0, 0, 0, 0, 1, 0, 0, -9, 0, 0, 0, 0, -3, 1);
    document.meshes.push_back(instance);
    document.nextId = 13;
    for (const bool thin : {false, true}) {
        SCOPED_TRACE(thin ? "thin" : "solid");
        document.materials[0].thinWalled = thin;
        const Blame blame = blameIn(document, 64);
        ASSERT_TRUE(blame.whole.isKnown);
        EXPECT_GT(blame.whole.of(BlameCause::Transmission).share, 0.9);
        // The rim mirrors the wall, and the second face of thin glass reflects, too.
        EXPECT_LT(std::abs(blame.whole.of(BlameCause::Bounces).share), 0.1) << "no bake is offered";
        EXPECT_LT(std::abs(blame.whole.of(BlameCause::Irradiance).share), 0.01);
        EXPECT_LT(std::abs(blame.whole.of(BlameCause::Rest).share), 0.01);
    }
    EXPECT_EQ(infoOf(BlameCause::Transmission).remedy, BlameRemedy::PathTracing);
}

// Whatever a scene is made of, the causes make up the whole difference at each pixel (blameIn()
// asserts it), and their shares the whole error.
TEST_F(BlameOfScenes, PartsAddUpInRandomScenes) {
    std::mt19937 random(47);
    const auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const auto color = [&] { return glm::vec3(number(0, 1), number(0, 1), number(0, 1)); };
    int known = 0;
    for (int round = 0; round < 10; ++round) {
        SCOPED_TRACE(round);
        Document document = makeScene(makeSphere(48));
        const glm::vec3 top = color(), bottom = color();
        const glm::vec3 sun = glm::normalize(color() + glm::vec3(-0.5f, 0.1f, 0.2f));
        document.environment().image = makeEnvironment(32, [&](const glm::vec3& d) {
            return glm::mix(bottom, top, 0.5f + 0.5f * d.y) +
                   (glm::dot(d, sun) > 0.95f ? glm::vec3(8.0f) : glm::vec3(0.0f));
        });
        document.environment().rotationDeg = number(-180, 180);
        document.view.background = BackgroundMode::Off;
        document.view.camera.yawDeg = number(-180, 180);
        document.view.camera.distance = 3.0f;
        document.model.diffuse = round % 2 == 0 ? Diffuse::Lambert : Diffuse::OrenNayar;
        const auto vary = [&](Material& material) {
            material.baseColor = color();
            material.metallic = number(0, 1) < 0.3f ? 1.0f : number(0, 1) * 0.3f;
            material.perceptualRoughness = number(0.05f, 1);
            material.transmission = number(0, 1) < 0.4f ? number(0.3f, 1) : 0.0f;
            material.thinWalled = number(0, 1) < 0.5f;
            material.doubleSided = true;
            material.emissive = number(0, 1) < 0.3f ? color() : glm::vec3(0.0f);
            if (const float kind = number(0, 1); kind < 0.4f) {
                material.alphaMode = kind < 0.2f ? AlphaMode::Blend : AlphaMode::Mask;
                material.opacity = number(0.2f, 1);
            }
        };
        vary(document.materials[0]);
        for (Id i = 0; i < 2; ++i) {
            document.materials.emplace_back().id = 20 + i;
            vary(document.materials.back());
            MeshInstance instance;
            instance.id = 30 + i;
            instance.mesh = i == 0 ? makePlane() : makeSphere(24);
            instance.material = 20 + i;
            instance.placement = glm::translate(
                glm::mat4(1.0f), {number(-1, 1), number(-1, 1), number(-1.5f, -0.5f)});
            document.meshes.push_back(instance);
        }
        Light lamp;
        lamp.id = 100;
        lamp.type = round % 3 == 0 ? LightType::Sphere : LightType::Directional;
        lamp.position = {number(-2, 2), 3.0f, number(-2, 2)};
        lamp.elevationDeg = number(10, 80);
        lamp.azimuthDeg = number(-180, 180);
        document.lights = {lamp};
        document.nextId = 101;
        const Blame blame = blameIn(document, 16);
        if (!blame.whole.isKnown)
            continue;
        ++known;
        double shares = 0.0;
        for (const BlameShare& share : blame.whole.causes) {
            EXPECT_TRUE(std::isfinite(share.share));
            shares += share.share;
        }
        EXPECT_NEAR(shares, 1.0, 1e-3);
    }
    EXPECT_GE(known, 5) << "scenes whose error is larger than its noise";
}

// A ball in uniform light: nothing is hidden, and nothing bounces.
TEST_F(BlameOfScenes, AConvexBodyHasNeitherOcclusionNorBounces) {
    Document document = metalScene(0.4f);
    document.materials[0].metallic = 0.0f;
    document.environment().image =
        makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(1.0f); });
    const Blame blame = blameIn(document, 64);
    EXPECT_LT(blame.whole.of(BlameCause::Bounces).relative, 1e-3);
    EXPECT_LT(std::abs(blame.whole.of(BlameCause::Occlusion).bias), 2e-3);
}

} // namespace patina::render
