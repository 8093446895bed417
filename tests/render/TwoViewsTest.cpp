// Several pictures of one scene: each as if it were alone, at the cost of its pixels.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/gl/Uploads.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <memory>
#include <random>

namespace patina::render {
namespace {

struct Picture {
    Image linear, displayed;
    [[nodiscard]] bool operator==(const Picture& other) const {
        const auto floats = linear.f32(), others = other.linear.f32();
        return floats.size() == others.size() &&
               std::memcmp(floats.data(), others.data(), floats.size_bytes()) == 0 &&
               displayed == other.displayed;
    }
};

EnvironmentTexelsPtr prepare(const ImagePtr& image) {
    const auto light = computeIbl(*image, {.cubeSize = 8, .levels = 3}, JobContext());
    EXPECT_TRUE(light.ok());
    return std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(image, *light, *makeBackground(*image, JobContext())));
}

class TwoViews : public RenderTest {
  protected:
    // A ball over a plane in two materials, a light with a shadow, a lamp, a bake with bounces.
    static Document scene() {
        Document document = makeScene(gridPlane(4));
        document.nextId = 10;
        document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(2.0f));
        document.materials[0].perceptualRoughness = 0.3f;
        MeshInstance ball;
        ball.mesh = makeSphere(12);
        ball.placement = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 1.0f, 0.0f));
        ball.id = document.takeId();
        Material metal;
        metal.id = document.takeId();
        metal.metallic = 1.0f;
        metal.perceptualRoughness = 0.4f;
        ball.material = metal.id;
        document.materials.push_back(metal);
        document.meshes.push_back(ball);
        for (const LightType type : {LightType::Directional, LightType::Point}) {
            Light light;
            light.id = document.takeId();
            light.type = type;
            light.intensity = 2.0f;
            light.position = glm::vec3(0.5f, 3.0f, 1.0f);
            document.lights.push_back(light);
        }
        document.bakes = {openBake(document, 3, 0.2f)};
        document.view.background = BackgroundMode::Environment;
        document.view.camera.pitchDeg = 35.0f;
        document.view.camera.distance = 7.0f;
        return document;
    }
    static ImagePtr sky(int axis) {
        return makeEnvironment(8, [=](const glm::vec3& d) {
            return glm::vec3(0.4f + 0.3f * d[axis], 0.5f, 0.6f - 0.2f * d[(axis + 1) % 3]);
        });
    }
    static Picture render(ViewRenderer& view, const FrameSettings& frame) {
        const auto done = view.render(frame, 0);
        EXPECT_TRUE(done.ok()) << (done.ok() ? std::string() : done.error().text());
        return {view.readLinear(), view.readDisplayed()};
    }
    // By a renderer that has never seen anything else.
    Picture alone(const Document& document, const EnvironmentTexelsPtr& light,
                  const FrameSettings& frame) {
        auto made = SceneRenderer::create(context());
        EXPECT_TRUE(made.ok());
        (*made)->setDocument(document);
        (*made)->setEnvironment(light);
        ViewRenderer view(**made);
        return render(view, frame);
    }
};

// One way of looking at the scene.
struct Cell {
    EnvironmentTexelsPtr light;
    Environment environment;
    View look;
    FrameSettings frame;
};

TEST_F(TwoViews, EachIsItsSinglePictureByteForByte) {
    Document document = scene();
    std::mt19937 random(7);
    std::vector<Cell> cells;
    for (const LightingMode lighting :
         {LightingMode::Ibl, LightingMode::Prt, LightingMode::Shadowed, LightingMode::Cosine,
          LightingMode::Unshadowed}) {
        Cell cell;
        const int i = static_cast<int>(cells.size());
        cell.light = prepare(sky(i % 3));
        cell.environment.image = cell.light->image;
        cell.environment.rotationDeg = 70.0f * static_cast<float>(i);
        cell.environment.exposureEv = 0.3f * static_cast<float>(i);
        cell.environment.id = document.mix.first;
        cell.look.background = i == 2   ? BackgroundMode::Blurred
                               : i == 3 ? BackgroundMode::Color
                                        : BackgroundMode::Environment;
        cell.look.lighting = lighting;
        cell.look.toneMap = i % 2 == 0 ? ToneMap::PbrNeutral : ToneMap::AgX;
        cell.look.exposureMode = i == 1 ? ExposureMode::Automatic : ExposureMode::Fixed;
        cell.look.reflectionMix = 0.5f - 0.1f * static_cast<float>(i);
        cell.frame.width = 40 + 8 * i;
        cell.frame.height = 48 - 4 * i;
        cell.frame.samples = i % 2 == 0 ? 1 : 4;
        cell.frame.camera = document.view.camera;
        cell.frame.camera.yawDeg = 25.0f * static_cast<float>(i);
        if (i == 4)
            cell.frame.view.shown.kind = shading::kViewSpecularIbl;
        cells.push_back(cell);
    }
    std::vector<Picture> expected;
    for (const Cell& cell : cells) {
        Document single = document;
        single.environment() = cell.environment;
        single.view = cell.look;
        expected.push_back(alone(single, cell.light, cell.frame));
    }

    // The first is the document's own.
    document.environment() = cells[0].environment;
    document.view = cells[0].look;
    sceneRenderer().setDocument(document);
    sceneRenderer().setEnvironment(cells[0].light);
    std::vector<std::unique_ptr<ViewRenderer>> views;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        views.push_back(std::make_unique<ViewRenderer>(sceneRenderer()));
        if (i == 0)
            continue;
        cells[i].frame.light = sceneRenderer().addLight(cells[i].environment);
        sceneRenderer().setEnvironment(cells[i].light, cells[i].frame.light);
        cells[i].frame.look = cells[i].look;
    }
    for (int round = 0; round < 3; ++round) // in whatever order
        for (std::size_t n = 0; n < 2 * cells.size(); ++n) {
            const std::size_t i = n < cells.size() ? n : random() % cells.size();
            EXPECT_EQ(render(*views[i], cells[i].frame), expected[i])
                << "cell " << i << " in round " << round;
        }
}

TEST_F(TwoViews, AFrameOfSlicesIsItsOwn) {
    const Document document = scene();
    sceneRenderer().setDocument(document);
    const EnvironmentTexelsPtr light = prepare(sky(0));
    sceneRenderer().setEnvironment(light);
    FrameSettings frame;
    frame.width = frame.height = 96;
    frame.samples = 1;
    frame.camera = document.view.camera;
    const Picture expected = alone(document, light, frame);
    FrameSettings other = frame;
    other.width = 50;
    other.camera.yawDeg += 40.0f;
    other.view.furnace = glm::vec3(1.0f);
    ViewRenderer beside(sceneRenderer());
    const Picture furnace = render(beside, other);
    int slices = 0;
    for (bool complete = false; !complete; ++slices) {
        const auto done = renderer().prepare(frame, 0.0, 1000.0);
        ASSERT_TRUE(done.ok());
        complete = *done;
        ASSERT_EQ(render(beside, other), furnace) << slices;
    }
    EXPECT_GT(slices, 3);
    EXPECT_TRUE(renderer().isPrepared(frame));
    EXPECT_EQ(render(renderer(), frame), expected);
}

TEST_F(TwoViews, ASecondViewUploadsAndDrawsNothingOfTheSceneAgain) {
    Document document = scene();
    const EnvironmentTexelsPtr light = prepare(sky(0));
    document.environment().image = light->image;
    document.view.lighting = LightingMode::Prt;
    sceneRenderer().setDocument(document);
    sceneRenderer().setEnvironment(light);
    FrameSettings frame;
    frame.width = frame.height = 32;
    frame.samples = 1;
    frame.camera = document.view.camera;
    // Uploads of a frame, maps of shadows, elements under transfer.
    const auto cost = [&](ViewRenderer& view) {
        const std::uint64_t bytes = gl::uploadedBytes();
        const SceneRenderer::Counts before = sceneRenderer().counts();
        render(view, frame);
        const SceneRenderer::Counts after = sceneRenderer().counts();
        return std::tuple(gl::uploadedBytes() - bytes, after.shadowMaps - before.shadowMaps,
                          after.relitElements - before.relitElements);
    };
    cost(renderer());
    const auto again = cost(renderer());
    EXPECT_EQ(std::get<1>(again), 0u);
    EXPECT_EQ(std::get<2>(again), 0u);
    EXPECT_LT(std::get<0>(again), 64u << 10) << "blocks of a frame";
    ViewRenderer second(sceneRenderer());
    EXPECT_EQ(cost(second), again);

    // Another environment of the same texels, turned: its textures are shared, surfaces under
    // transfer are lit once.
    Environment turned = document.environment();
    turned.rotationDeg = 90.0f;
    const std::uint64_t bytes = gl::uploadedBytes();
    frame.light = sceneRenderer().addLight(turned);
    const std::uint64_t grey = gl::uploadedBytes() - bytes; // that stands in at first
    sceneRenderer().setEnvironment(light, frame.light);
    EXPECT_EQ(gl::uploadedBytes() - bytes, grey);
    EXPECT_LT(grey, 1024u);
    ViewRenderer third(sceneRenderer());
    const auto first = cost(third);
    EXPECT_EQ(std::get<1>(first), 0u) << "shadows are the same";
    EXPECT_GT(std::get<2>(first), 0u);
    EXPECT_EQ(cost(third), again);
    frame.light = kDocumentLight;
    EXPECT_EQ(cost(second), again) << "the other's light was not lost";
}

TEST_F(TwoViews, AnEnvironmentThatWasShownIsShownAgainWithoutAnUpload) {
    Document document = scene();
    document.view.lighting = LightingMode::Ibl;
    FrameSettings frame;
    frame.width = frame.height = 32;
    frame.samples = 1;
    frame.camera = document.view.camera;
    std::vector<EnvironmentTexelsPtr> lights{prepare(sky(0)), prepare(sky(1)), prepare(sky(2))};
    const auto show = [&](const EnvironmentTexelsPtr& light) {
        document.environment().image = light->image;
        sceneRenderer().setDocument(document);
        const std::uint64_t bytes = gl::uploadedBytes();
        sceneRenderer().setEnvironment(light);
        return gl::uploadedBytes() - bytes;
    };
    for (const EnvironmentTexelsPtr& light : lights)
        EXPECT_GT(show(light), 0u);
    for (const EnvironmentTexelsPtr& light : lights) {
        EXPECT_EQ(show(light), 0u);
        EXPECT_TRUE(render(renderer(), frame) == alone(document, light, frame));
    }
    // Of one that was beside the document's, too.
    const EnvironmentTexelsPtr beside = prepare(sky(1));
    Environment other = document.environment();
    other.image = beside->image;
    const LightId id = sceneRenderer().addLight(other);
    sceneRenderer().setEnvironment(beside, id);
    sceneRenderer().removeLight(id);
    EXPECT_EQ(show(beside), 0u);
    // What nobody can ask for again is not kept.
    show(lights[0]);
    const std::weak_ptr<const Image> gone = lights[1]->image;
    lights[1].reset();
    sceneRenderer().setDocument(document);
    EXPECT_TRUE(gone.expired());
}

TEST_F(TwoViews, OneEnvironmentsEditsLeaveTheOthersPicture) {
    Document document = scene();
    sceneRenderer().setDocument(document);
    sceneRenderer().setEnvironment(prepare(sky(0)));
    Environment environment;
    const EnvironmentTexelsPtr light = prepare(sky(1));
    environment.image = light->image;
    FrameSettings frame;
    frame.width = frame.height = 24;
    frame.samples = 1;
    frame.accumulate = true;
    frame.camera = document.view.camera;
    FrameSettings own = frame;
    own.look = document.view;
    own.light = sceneRenderer().addLight(environment);
    sceneRenderer().setEnvironment(light, own.light);
    ViewRenderer other(sceneRenderer());
    // Whether the pictures go on adding frames up after an edit.
    const auto goesOn = [&](const std::function<void()>& edit) {
        for (int i = 0; i < 2; ++i) {
            render(renderer(), frame);
            render(other, own);
        }
        edit();
        render(renderer(), frame);
        render(other, own);
        return std::pair(renderer().accumulatedFrames() > 1, other.accumulatedFrames() > 1);
    };
    const auto editDocument = [&](const std::function<void()>& edit) {
        return goesOn([&] {
            edit();
            sceneRenderer().setDocument(document);
        });
    };
    EXPECT_EQ(goesOn([] {}), std::pair(true, true));
    EXPECT_EQ(editDocument([&] { document.environment().rotationDeg = 10.0f; }),
              std::pair(false, true));
    EXPECT_EQ(editDocument([&] { document.view.exposureEv = 1.0f; }), std::pair(false, true));
    EXPECT_EQ(editDocument([&] { document.materials[0].metallic = 0.5f; }),
              std::pair(false, false));
    EXPECT_EQ(editDocument([&] { document.environment().solo = true; }), std::pair(false, false))
        << "lights go out";
    environment.exposureEv = 1.0f;
    EXPECT_EQ(goesOn([&] { sceneRenderer().changeLight(own.light, environment); }),
              std::pair(true, false));
    EXPECT_EQ(goesOn([&] { sceneRenderer().changeLight(own.light, environment); }),
              std::pair(true, true))
        << "nothing has changed";
    EXPECT_EQ(goesOn([&] { own.look->exposureEv = 2.0f; }), std::pair(true, false));
}

// Shown again it is that picture still, whatever light and look are wanted by now.
TEST_F(TwoViews, AKeptPictureKeepsItsLightAndLook) {
    Document document = scene();
    sceneRenderer().setDocument(document);
    sceneRenderer().setEnvironment(prepare(sky(0)));
    Environment environment;
    const EnvironmentTexelsPtr light = prepare(sky(1));
    environment.image = light->image;
    FrameSettings frame;
    frame.width = frame.height = 32;
    frame.samples = 1;
    frame.camera = document.view.camera;
    FrameSettings other = frame;
    other.light = sceneRenderer().addLight(environment);
    sceneRenderer().setEnvironment(light, other.light);
    other.look = document.view;
    other.look->exposureEv = 1.0f;
    other.look->lighting = LightingMode::Prt;
    const Picture first = render(renderer(), frame);
    const glm::vec4 radiance = renderer().inspect(16, 16)->radiance;
    other.keepPicture = true;
    EXPECT_EQ(render(renderer(), other), first);
    EXPECT_EQ(renderer().inspect(16, 16)->radiance, radiance);
    EXPECT_TRUE(renderer().isCurrent(frame));
    other.keepPicture = false;
    EXPECT_FALSE(renderer().isCurrent(other));
    const Picture now = render(renderer(), other);
    EXPECT_NE(now, first);
    ViewRenderer beside(sceneRenderer());
    EXPECT_EQ(now, render(beside, other));
}

// Whoever looks at a picture changes nothing of it, nor of another.
TEST_F(TwoViews, LookingChangesNothing) {
    Document document = scene();
    document.view.exposureMode = ExposureMode::Automatic;
    const EnvironmentTexelsPtr light = prepare(sky(0));
    document.environment().image = light->image;
    const auto picture = [&](bool looks) {
        auto made = SceneRenderer::create(context());
        EXPECT_TRUE(made.ok());
        (*made)->setDocument(document);
        (*made)->setEnvironment(light);
        ViewRenderer view(**made), other(**made);
        FrameSettings frame;
        frame.width = frame.height = 40;
        frame.samples = 1;
        frame.accumulate = true;
        frame.camera = document.view.camera;
        FrameSettings numbers = frame;
        numbers.view.shown.kind = shading::kViewPerceptualRoughness;
        Picture last, shown;
        for (int i = 0; i < ViewRenderer::kSteadyFrames; ++i) {
            last = render(view, frame);
            shown = render(other, numbers);
            if (!looks)
                continue;
            const Inspection seen = *view.inspect(20, 20);
            EXPECT_TRUE(seen.onSurface());
            EXPECT_NE(other.pick(20, 20), 0u);
            EXPECT_TRUE(view.readView(shading::kViewD).ok());
            EXPECT_TRUE(other.readBackground().ok());
            EXPECT_TRUE(other.inspect(3, 3).ok());
        }
        EXPECT_EQ(view.accumulatedFrames(), ViewRenderer::kSteadyFrames);
        EXPECT_TRUE(view.isCurrent(frame));
        EXPECT_EQ(other.readLinear(), shown.linear);
        EXPECT_EQ(other.readDisplayed(), shown.displayed);
        return std::pair(last, shown);
    };
    EXPECT_EQ(picture(true), picture(false));
}

} // namespace
} // namespace patina::render
