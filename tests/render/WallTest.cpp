// The cells of a wall: each as if it were alone, at the cost of what it differs in.
#include "core/cells/WallAxes.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightMix.h"
#include "render/WallRenderer.h"
#include "render/gl/Uploads.h"
#include "render/scene/Blocks.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <cstring>
#include <gmock/gmock.h>
#include <map>
#include <memory>

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

class WallTest : public RenderTest {
  protected:
    WallTest() {
        document = makeScene(gridPlane(4));
        document.nextId = 10;
        document.environment().source = "first.hdr";
        document.environment().image = sky(0);
        MeshInstance ball = document.meshes[0];
        ball.id = document.takeId();
        ball.mesh = makeSphere(12);
        ball.placement.setPosition({0.0f, 1.0f, 0.0f});
        Material metal;
        metal.name = "Metal";
        metal.metallic = 1.0f;
        metal.perceptualRoughness = 0.3f;
        metal.baseColorMap.image =
            makeImage(32, 32, 3, PixelType::U8, ColorEncoding::Srgb,
                      [](int x, int y, int) { return (x / 4 + y / 4) % 2 == 0 ? 0.9f : 0.3f; });
        ball.material = addMaterial(document, metal);
        document.meshes.push_back(ball);
        Light sun;
        sun.type = LightType::Directional;
        sun.intensity = 2.0f;
        addLight(document, sun);
        document.bakes = {openBake(document, 3, 0.2f)};
        document.view.background = BackgroundMode::Environment;
        document.view.camera.pitchDeg = 35.0f;
        document.view.camera.distance = 6.0f;
    }
    static ImagePtr sky(int which) {
        return makeEnvironment(8, [=](const glm::vec3& d) {
            return glm::vec3(0.4f + 0.3f * d[which % 3], 0.5f - 0.03f * static_cast<float>(which),
                             0.6f - 0.2f * d[(which + 1) % 3]);
        });
    }
    Id addSky(int which) {
        Environment environment;
        environment.source = std::to_string(which) + ".hdr";
        environment.image = sky(which);
        return addEnvironment(document, environment);
    }
    // Each picture's once.
    EnvironmentTexelsPtr texelsOf(const ImagePtr& image) {
        EnvironmentTexelsPtr& known = m_texels[image];
        if (!known) {
            const auto light = computeIbl(*image, {.cubeSize = 8, .levels = 3}, JobContext());
            EXPECT_TRUE(light.ok());
            known = std::make_shared<const EnvironmentTexels>(
                makeEnvironmentTexels(image, *light, *makeBackground(*image, JobContext())));
        }
        return known;
    }
    CellView viewOf(const Cell& cell, int samples = 4) {
        CellView view;
        const Result<Document> shown = documentOf(document, cell);
        EXPECT_TRUE(shown.ok());
        view.document = *shown;
        resolveCell(view.document, document);
        if (!environmentParts(view.document).empty())
            view.light = texelsOf(shownEnvironment(view.document).image);
        view.frame.samples = samples;
        view.frame.width = 40;
        view.frame.height = 32;
        view.frame.camera = view.document.view.camera;
        return view;
    }
    std::vector<CellView> viewsOf(std::vector<WallAxis> axes) {
        const Result<Wall> wall = makeWall(std::move(axes));
        EXPECT_TRUE(wall.ok());
        std::vector<CellView> views;
        for (const WallCell& cell : cellsOf(*wall))
            views.push_back(viewOf(cell.cell));
        return views;
    }
    static Picture read(const ViewRenderer& view) {
        return {view.readLinear(), view.readDisplayed()};
    }
    // By a renderer that has never seen anything else, in the light of its document.
    Picture alone(const CellView& cell) {
        auto made = SceneRenderer::create(context());
        EXPECT_TRUE(made.ok());
        if (cell.light)
            (*made)->setEnvironment(cell.light);
        (*made)->setDocument(cell.document);
        ViewRenderer view(**made);
        const Result<void> done = view.render(cell.frame, 0);
        EXPECT_TRUE(done.ok());
        return read(view);
    }
    // Draws the wall; returns uploaded bytes and shadow maps.
    std::pair<std::uint64_t, std::size_t> cost(WallRenderer& wall,
                                               std::span<const CellView> cells) {
        const std::uint64_t bytes = gl::uploadedBytes();
        const std::size_t maps = sceneRenderer().counts().shadowMaps;
        const Result<void> drawn = wall.draw(cells);
        EXPECT_TRUE(drawn.ok()) << (drawn.ok() ? std::string() : drawn.error().text());
        return {gl::uploadedBytes() - bytes, sceneRenderer().counts().shadowMaps - maps};
    }
    WallAxis wedge(const char* text) {
        Result<WallAxis> axis = wedgeAxis(document, *parseWedge(text));
        EXPECT_TRUE(axis.ok());
        return *axis;
    }

    Document document;

  private:
    std::map<ImagePtr, EnvironmentTexelsPtr> m_texels;
};

// Of the light of an environment, as it is on the GPU: half floats.
std::uint64_t bytesOf(const EnvironmentTexels& texels) {
    std::uint64_t samples = texels.prefiltered.texels.size();
    for (const HalfPicture& level : *texels.background)
        samples += level.texels.size();
    return samples * sizeof(std::uint16_t);
}

TEST_F(WallTest, EachCellIsItsSinglePictureByteForByte) {
    std::vector<CellView> cells;
    const auto add = [&](const Cell& cell, int samples = 4) {
        cells.push_back(viewOf(cell, samples));
    };
    std::vector<Id> skies{document.mix.first, addSky(1), addSky(2)};
    std::vector<Id> materials{document.materials[0].id, document.materials[1].id};
    const auto addAll = [&](std::vector<WallAxis> axes) {
        for (CellView& cell : viewsOf(std::move(axes)))
            cells.push_back(std::move(cell));
    };
    addAll({environmentAxis(document, skies), materialAxis(document, materials)});
    addAll({wedge("material.perceptualRoughness=0.1:1:3"),
            *choiceAxis(document, "view.lighting",
                        std::vector<std::string>{"ibl", "cosine", "shadowed", "prt"})});
    addAll({wedge("environment.rotationDeg=0:180:3"), environmentAxis(document, skies)});
    addAll({*choiceAxis(document, "view.toneMap", std::vector<std::string>{"agx", "clamp"}),
            wedge("light.azimuthDeg=0:90:2")});
    Cell automatic;
    automatic.own.push_back({{Scope::View, 0},
                             findParameter("view.exposureMode"),
                             static_cast<int>(ExposureMode::Automatic)});
    automatic.own.push_back(
        {{Scope::Environment, 0}, findParameter("environment.exposureEv"), 3.0f});
    add(automatic, 1);
    Cell dark;
    dark.own.push_back({{Scope::Environment, 0}, findParameter("environment.enabled"), false});
    add(dark);
    Cell generated;
    generated.own.push_back({{Scope::Environment, 0},
                             findParameter("environment.kind"),
                             static_cast<int>(EnvironmentKind::Softboxes)});
    add(generated);
    Cell fade; // two environments at once
    fade.own.push_back(
        {{Scope::Environment, 0}, findParameter("environment.second"), static_cast<int>(skies[1])});
    fade.own.push_back({{Scope::Environment, 0}, findParameter("environment.fade"), 0.25f});
    add(fade);
    Cell nearer;
    nearer.camera = document.view.camera;
    nearer.camera->distance = 4.0f;
    nearer.environment = skies[2];
    add(nearer);

    WallRenderer wall(sceneRenderer());
    for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(wall.draw(cells).ok());
        for (std::size_t i = 0; i < cells.size(); ++i)
            EXPECT_EQ(read(wall.picture(i)), alone(cells[i])) << "cell " << i;
        std::ranges::reverse(cells);
    }
    EXPECT_EQ(wall.counts().pictures, cells.size()) << "they took their pictures along";
}

// Rotation and brightness are numbers of the light, not another upload.
TEST_F(WallTest, TwelveEnvironmentsCostOneSceneAndOneShadowPass) {
    std::vector<Id> skies{document.mix.first};
    while (skies.size() < 12)
        skies.push_back(addSky(static_cast<int>(skies.size())));
    const std::vector<CellView> cells = viewsOf({environmentAxis(document, skies)});
    WallRenderer wall(sceneRenderer());
    const auto first = cost(wall, std::span(cells).first(1));
    EXPECT_EQ(first.second, 1u);
    EXPECT_GT(first.first, 32u * 32 * 3) << "the scene with its map";
    const auto rest = cost(wall, cells);
    EXPECT_EQ(rest.second, 0u) << "shadows do not depend on the environment";
    std::uint64_t lights = 0;
    for (const CellView& cell : std::span(cells).subspan(1))
        lights += bytesOf(*cell.light);
    const std::uint64_t blocks = (rest.first - lights) / 11;
    EXPECT_GE(rest.first, lights);
    EXPECT_LT(blocks, 20u << 10) << "blocks of a frame";
    EXPECT_EQ(wall.counts().lights, 12u);
    EXPECT_EQ(wall.counts().pictures, 12u);

    EXPECT_EQ(cost(wall, cells), std::pair(std::uint64_t{0}, std::size_t{0}))
        << "nothing has changed";
    EXPECT_EQ(wall.counts().pictures, 12u);
    EXPECT_EQ(wall.counts().lights, 12u);

    // One that changes is drawn anew, alone.
    std::vector<CellView> edited = cells;
    edited[4].document.environment().rotationDeg = 40.0f;
    const auto turned = cost(wall, edited);
    EXPECT_LT(turned.first, blocks + 1024) << "its textures are there";
    EXPECT_EQ(turned.second, 0u);
    EXPECT_EQ(wall.counts().pictures, 13u);
}

TEST_F(WallTest, ANumberUploadsItsBlock) {
    const auto perCell = [&](WallAxis axis) {
        const std::vector<CellView> cells = viewsOf({std::move(axis)});
        WallRenderer wall(sceneRenderer());
        cost(wall, std::span(cells).first(1));
        std::vector<std::uint64_t> bytes;
        for (std::size_t n = 2; n <= cells.size(); ++n) {
            const auto more = cost(wall, std::span(cells).first(n));
            EXPECT_EQ(more.second, 0u);
            bytes.push_back(more.first);
        }
        EXPECT_THAT(bytes, testing::Each(bytes.front()));
        return bytes.front();
    };
    const std::uint64_t frame = perCell(wedge("view.exposureEv=-1:1:4"));
    EXPECT_LT(frame, 20u << 10) << "blocks of a frame";
    EXPECT_EQ(perCell(wedge("material[Metal].perceptualRoughness=0:1:4")),
              frame + sizeof(MaterialBlock));
    // Another light of the same environment: a texel of the grey sky stands in at first.
    EXPECT_LT(perCell(wedge("environment.rotationDeg=10:40:4")), frame + 1024);
    const std::vector<Id> materials{document.materials[0].id, document.materials[1].id};
    EXPECT_EQ(perCell(materialAxis(document, materials)), frame + 2 * sizeof(InstanceBlock))
        << "of both meshes";
}

TEST_F(WallTest, EnvironmentsThatNoCellHasAreLetGo) {
    const std::vector<Id> skies{addSky(1), addSky(2)};
    std::vector<CellView> cells = viewsOf({environmentAxis(document, skies)});
    WallRenderer wall(sceneRenderer());
    cost(wall, cells);
    std::swap(cells[0], cells[1]);
    cells.pop_back();
    cost(wall, cells);
    EXPECT_EQ(wall.counts().lights, 2u) << "it is there for another cell";
    cost(wall, {});
    cost(wall, cells);
    EXPECT_EQ(wall.counts().lights, 3u) << "it was let go";
}

// Frames are added to a cell's after others have been drawn, and each is what it would be alone.
TEST_F(WallTest, CellsAreRefinedFrameByFrame) {
    std::vector<CellView> cells = viewsOf(
        {wedge("material[Metal].perceptualRoughness=0:1:2"), wedge("light.azimuthDeg=0:90:2")});
    for (CellView& cell : cells) {
        cell.frame.samples = 1;
        cell.frame.accumulate = true;
    }
    WallRenderer wall(sceneRenderer());
    wall.set(cells, false);
    EXPECT_EQ(wall.due(), cells.size());
    EXPECT_FALSE(wall.hasPicture(0));
    for (std::size_t left = cells.size(); left > 0; --left) { // each call draws at least one
        ASSERT_TRUE(wall.proceed(0.0).ok());
        EXPECT_EQ(wall.due(), left - 1) << "none is refined before all are there";
    }
    for (int calls = 0; !wall.complete(); ++calls) {
        ASSERT_LT(calls, 100);
        ASSERT_TRUE(wall.proceed(0.0).ok());
    }
    EXPECT_EQ(wall.counts().pictures, cells.size() * ViewRenderer::kSteadyFrames);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        auto made = SceneRenderer::create(context());
        ASSERT_TRUE(made.ok());
        (*made)->setEnvironment(cells[i].light);
        (*made)->setDocument(cells[i].document);
        ViewRenderer view(**made);
        for (int frame = 0; frame < ViewRenderer::kSteadyFrames; ++frame)
            ASSERT_TRUE(view.render(cells[i].frame, 0).ok());
        EXPECT_EQ(read(wall.picture(i)), read(view)) << i;
    }
    wall.invalidate();
    EXPECT_EQ(wall.due(), cells.size());
    EXPECT_TRUE(wall.hasPicture(0)) << "until it is drawn anew";
}

TEST_F(WallTest, NoPictureIsShownForAnotherCell) {
    std::vector<CellView> cells = viewsOf({wedge("material[Metal].metallic=0:1:3")});
    WallRenderer wall(sceneRenderer());
    ASSERT_TRUE(wall.draw(cells).ok());
    const Picture second = read(wall.picture(1));
    CellView other = cells[0];
    other.document.view.exposureEv = 1.0f;
    const std::vector<CellView> edited{cells[0], other, cells[2]};
    wall.set(edited, true);
    EXPECT_TRUE(wall.hasPicture(1)) << "the same cell, edited, shows what it did";
    ASSERT_TRUE(wall.draw(cells).ok());
    const std::vector<CellView> changed{cells[1], other};
    wall.set(changed, false);
    EXPECT_TRUE(wall.hasPicture(0));
    EXPECT_EQ(read(wall.picture(0)), second) << "it took its picture along";
    EXPECT_FALSE(wall.hasPicture(1));
    std::vector<CellView> waiting = changed;
    waiting[1].waits = true;
    wall.set(waiting, true);
    EXPECT_TRUE(wall.complete()) << "nothing can be drawn yet";
    wall.set(changed, true);
    ASSERT_TRUE(wall.proceed().ok());
    EXPECT_EQ(read(wall.picture(1)), alone(other));
}

// The scene shows one cell after the other: looking at one is right after show().
TEST_F(WallTest, ACellCanBeLookedAtAfterTheOthers) {
    const std::vector<CellView> cells = viewsOf({wedge("material[Metal].metallic=0:1:3")});
    WallRenderer wall(sceneRenderer());
    ASSERT_TRUE(wall.draw(cells).ok());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        wall.show(i);
        const Result<Image> metallic = wall.picture(i).readView(shading::kViewMetallic);
        ASSERT_TRUE(metallic.ok());
        float most = 0.0f;
        for (int y = 0; y < metallic->height(); ++y)
            for (int x = 0; x < metallic->width(); ++x)
                most = std::max(most, metallic->sample(x, y, 0));
        EXPECT_FLOAT_EQ(most, 0.5f * static_cast<float>(i));
    }
}

} // namespace
} // namespace patina::render
