// Whatever is edited, the renderer that has seen all edits draws the same bytes as one that is
// given the document at once. By default a few values of each parameter; PATINA_INCREMENTAL_VALUES
// and PATINA_INCREMENTAL_EDITS ask for more.
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"
#include "tests/core/document/RandomDocument.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"
#include "tests/support/SecondEnvironment.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <ostream>

namespace patina::render {
namespace {

constexpr int kSize = 24;

int setting(const char* name, int otherwise) {
    const char* value = std::getenv(name);
    return value ? std::atoi(value) : otherwise;
}

ImagePtr checks(int channels, ColorEncoding encoding, int cells) {
    return makeImage(8, 8, channels, PixelType::U8, encoding, [=](int x, int y, int c) {
        const bool odd = (x * cells / 8 + y * cells / 8) % 2 == 1;
        return c == 3 ? (odd ? 1.0f : 0.2f) : (odd ? 0.9f : 0.3f) - 0.1f * static_cast<float>(c);
    });
}

struct Picture {
    Image linear, displayed;
    [[nodiscard]] bool operator==(const Picture& other) const {
        const auto floats = linear.f32(), others = other.linear.f32(); // NaN, too
        return std::memcmp(floats.data(), others.data(), floats.size_bytes()) == 0 &&
               displayed == other.displayed;
    }
};

// In a failure's message.
void PrintTo(const Picture& picture, std::ostream* out) {
    const glm::vec4 mean = [&] {
        glm::vec4 sum(0.0f);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                sum += pixel(picture.linear, x, y);
        return sum / static_cast<float>(kSize * kSize);
    }();
    *out << "a picture of mean " << mean.x << ' ' << mean.y << ' ' << mean.z << ' ' << mean.w;
}

class Incremental : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        auto made = SceneRenderer::create(context());
        ASSERT_TRUE(made.ok()) << made.error().text();
        m_otherScene = std::move(*made);
        m_other = std::make_unique<ViewRenderer>(*m_otherScene);
        for (int i = 0; i < 3; ++i) {
            const ImagePtr image = makeEnvironment(8, [=](const glm::vec3& d) {
                return glm::vec3(0.4f + 0.3f * d[i], 0.5f, 0.6f - 0.2f * d[(i + 1) % 3]);
            });
            const auto light = computeIbl(*image, {.cubeSize = 8, .levels = 3}, JobContext());
            ASSERT_TRUE(light.ok());
            m_environments.push_back(std::make_shared<const EnvironmentTexels>(
                makeEnvironmentTexels(image, *light, *makeBackground(*image, JobContext()))));
        }
        m_maps = {checks(4, ColorEncoding::Srgb, 2), checks(3, ColorEncoding::Data, 4),
                  checks(1, ColorEncoding::Data, 8)};
    }
    void TearDown() override {
        m_other.reset();
        m_otherScene.reset();
        RenderTest::TearDown();
    }

    // A plate with holes over a plane, a ball, one light of each type, a bake.
    Document scene() {
        Document document = makeScene(gridPlane(4));
        document.nextId = 10;
        document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(2.0f));
        addMesh(document, gridPlane(2), {0.0f, 1.0f, 0.0f});
        addMesh(document, makeSphere(8), {0.8f, 0.4f, 0.8f});
        for (Material& material : document.materials) {
            material.baseColorMap.image = m_maps[0]; // half of it is hardly there
            material.opacity = 0.8f;
        }
        document.materials[1].alphaMode = AlphaMode::Mask;
        for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot,
                                     LightType::Sphere, LightType::Rectangle}) {
            Light light;
            light.type = type;
            light.intensity = 2.0f;
            addLight(document, light);
        }
        test::addSecond(document, "/second.hdr", m_environments[1]->image);
        test::addSecond(document, "/third.hdr", m_environments[2]->image);
        document.environment().image = m_environments[0]->image;
        document.mix.blended = m_environments[2]->image;
        document.environment().softboxes.emplace_back().id = document.takeId();
        document.view.camera.pitchDeg = 35.0f;
        document.view.camera.distance = 7.0f;
        document.bakes = {openBake(document, 3, 0.2f)};
        return document;
    }
    static void addMesh(Document& document, const MeshPtr& mesh, const glm::vec3& at) {
        Material material;
        material.baseColor = {0.7f, 0.5f, 0.3f};
        MeshInstance instance;
        instance.mesh = mesh;
        instance.placement = glm::translate(glm::mat4(1.0f), at);
        instance.material = addMaterial(document, material);
        instance.id = document.takeId();
        document.meshes.push_back(instance);
    }

    Picture show(SceneRenderer& scene, ViewRenderer& renderer, const Document& document) {
        scene.setDocument(document);
        // What others prepare comes with the document each time.
        const ImagePtr image = shownEnvironment(document).image;
        for (const EnvironmentTexelsPtr& texels : m_environments) {
            scene.setProjection(texels->image, texels->radianceSh);
            if (texels->image == image)
                scene.setEnvironment(texels);
        }
        FrameSettings frame;
        frame.width = frame.height = kSize;
        frame.samples = 1;
        frame.camera = document.view.camera;
        const auto done = renderer.render(frame, 0);
        EXPECT_TRUE(done.ok()) << (done.ok() ? std::string() : done.error().text());
        return {renderer.readLinear(), renderer.readDisplayed()};
    }
    // By a renderer that holds nothing of any scene.
    Picture fresh(const Document& document) {
        m_otherScene->setDocument(Document{});
        return show(*m_otherScene, *m_other, document);
    }
    // By one that has just been made.
    Picture afresh(const Document& document) {
        auto made = SceneRenderer::create(context());
        EXPECT_TRUE(made.ok());
        ViewRenderer renderer(**made);
        return show(**made, renderer, document);
    }

    std::vector<EnvironmentTexelsPtr> m_environments;
    std::vector<ImagePtr> m_maps;

  private:
    std::unique_ptr<SceneRenderer> m_otherScene;
    std::unique_ptr<ViewRenderer> m_other;
};

TEST_F(Incremental, AnyValueOfAnyParameterDrawsLikeAFreshScene) {
    const int values = setting("PATINA_INCREMENTAL_VALUES", 1);
    RandomDocument random(11);
    const Document start = scene();
    int edits = 0, seen = 0;
    const Picture first = show(sceneRenderer(), renderer(), start);
    ASSERT_EQ(first, afresh(start));
    for (const ParameterInfo& info : parameters()) {
        SCOPED_TRACE(std::string(info.id));
        Document document = start;
        Picture before = first;
        const std::vector<Id> ids = RandomDocument::idsOf(document, info.scope);
        // Every choice there is, and then whatever comes.
        const int count = std::max(values, static_cast<int>(info.choices.size()));
        for (int i = 0; i < count; ++i) {
            const Target target{info.scope, i < count - values ? ids[1 % ids.size()]
                                                               : ids[random.below(ids.size())]};
            ParameterValue value = random.value(info, document);
            if (info.type == ParameterType::Choice)
                value = (std::get<int>(info.get(start, target.id)) + i + 1) %
                        static_cast<int>(info.choices.size());
            if (MapSlot* map = std::get_if<MapSlot>(&value); map && random.below(4) > 0) {
                map->image = info.scope == Scope::Environment
                                 ? m_environments[random.below(m_environments.size())]->image
                                 : m_maps[random.below(m_maps.size())];
                map->uvScale = glm::vec2(random.between(0.5f, 2.0f));
                map->uvOffset = glm::vec2(0.0f);
                map->uvRotationDeg = random.between(0.0f, 90.0f);
            }
            const bool idle = !whyIdle(info, document, target.id).empty();
            ASSERT_TRUE(applyParameter(document, info, target, value));
            const Picture picture = show(sceneRenderer(), renderer(), document);
            ASSERT_EQ(picture, fresh(document)) << "value " << i;
            if (idle) {
                ASSERT_EQ(picture, before) << "but " << whyIdle(info, document, target.id);
            }
            seen += !(picture == before);
            before = picture;
            ++edits;
        }
    }
    ASSERT_EQ(show(sceneRenderer(), renderer(), start), afresh(start)) << "and back";
    EXPECT_GT(seen, edits / 4) << "most parameters show";
    std::printf("%d values, of which %d changed the picture\n", edits, seen);
}

TEST_F(Incremental, AnyOrderOfStructuralEditsDrawsLikeAFreshScene) {
    const int edits = setting("PATINA_INCREMENTAL_EDITS", 30);
    RandomDocument random(5);
    Document document = scene();
    std::vector<Document> history; // undo leads anywhere
    const std::vector<MeshPtr> shapes = {gridPlane(2), makeSphere(8), gridPlane(5)};
    const auto any = [&](auto& elements) -> auto& {
        return elements[random.below(elements.size())];
    };
    const auto position = [&] {
        return glm::vec3(random.between(-1.5f, 1.5f), random.between(0.0f, 1.5f),
                         random.between(-1.5f, 1.5f));
    };
    const auto texelBake = [&] {
        auto bake = std::make_shared<BakeArtifact>();
        bake->kind = BakeKind::AoTexel;
        TexelBake& texels = bake->texels.emplace_back();
        texels.material = document.materials.empty() ? 0 : any(document.materials).id;
        texels.image = makeImage(4, 4, 1, PixelType::F32, ColorEncoding::Data,
                                 [](int x, int y, int) { return x == y ? 0.2f : 0.9f; });
        return bake;
    };
    using Edit = std::function<void()>;
    const std::vector<Edit> all = {
        [&] { addMesh(document, any(shapes), position()); },
        [&] { std::erase_if(document.meshes, [&](const auto&) { return random.below(3) == 0; }); },
        [&] {
            if (!document.meshes.empty())
                any(document.meshes).placement = glm::translate(glm::mat4(1.0f), position());
        },
        [&] {
            if (!document.meshes.empty())
                any(document.meshes).mesh = any(shapes);
        },
        [&] {
            if (!document.meshes.empty())
                any(document.meshes).visible = random.below(2) == 0;
        },
        [&] {
            if (!document.meshes.empty() && !document.materials.empty())
                any(document.meshes).material = any(document.materials).id;
        },
        [&] {
            if (!document.materials.empty())
                removeMaterial(document, any(document.materials).id);
        },
        [&] { document.materials.clear(); }, // a damaged project
        [&] {
            if (!document.materials.empty())
                any(document.materials).alphaMode = static_cast<AlphaMode>(random.below(3));
        },
        [&] {
            if (!document.materials.empty()) {
                Material& material = any(document.materials);
                (random.below(2) == 0 ? material.baseColorMap : material.metallicMap).image =
                    random.below(3) == 0 ? nullptr : any(m_maps);
            }
        },
        [&] {
            Light light;
            light.type = static_cast<LightType>(random.below(5));
            light.position = position() + glm::vec3(0.0f, 2.0f, 0.0f);
            if (document.lights.size() < 6)
                addLight(document, light);
        },
        [&] {
            if (!document.lights.empty())
                document.lights.erase(document.lights.begin());
        },
        [&] { std::ranges::reverse(document.lights); },
        [&] { std::ranges::reverse(document.meshes); },
        [&] { document.bakes = {openBake(document, 3)}; },
        [&] { document.bakes = {texelBake()}; },
        [&] { document.bakes.clear(); },
        [&] { document.view.lighting = static_cast<LightingMode>(random.below(6)); },
        [&] { document.environment().image = any(m_environments)->image; },
        [&] { document.mix.fade = random.below(2) == 0 ? 0.0f : 0.5f; },
        [&] { document.mix.first = any(document.environments).id; },
        [&] {
            document.mix.second = random.below(3) == 0 ? 0 : any(document.environments).id;
            if (document.mix.second == document.mix.first)
                document.mix.second = 0;
        },
        [&] { std::ranges::reverse(document.environments); },
        [&] { document = any(history); },
    };
    for (int i = 0; i < edits; ++i) {
        history.push_back(document);
        if (history.size() > 8)
            history.erase(history.begin());
        any(all)();
        const Picture picture = show(sceneRenderer(), renderer(), document);
        ASSERT_EQ(picture, fresh(document)) << "edit " << i;
        if (i % 16 == 0) {
            ASSERT_EQ(picture, afresh(document)) << "edit " << i;
        }
    }
}

} // namespace
} // namespace patina::render
