// A light moved about in the window under radiance transfer: its shadows follow, traced behind the
// input, and end complete.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/app/editor/UnderSky.h"

#include "app/editor/job/NearShadowUpdater.h"
#include "app/editor/widget/BusyIndicator.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/EditSession.h"
#include "core/math/Shading.h"
#include "core/mix/TransferLight.h"

#include <QLabel>
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

namespace patina::editor {
namespace {

struct NearShadowWindow : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(360, 300); // software OpenGL pays for each pixel
        controller().openScene(QStringLiteral("builtin:cornell-box"));
        ASSERT_TRUE(settled(*session));
        putUnderSky(*session);
        Camera camera = document().view.camera;
        camera.yawDeg = 0.0f;
        camera.pitchDeg = 10.0f;
        controller().setCamera(frameBounds(camera, document().bounds(), 1.2f));
        set("environment.enabled", {Scope::Environment, 0}, false);
        set("view.reflectionMix", {Scope::View, 0}, 0.0f); // diffuse light alone
        TileSink sink;
        PrtSettings settings;
        settings.order = 8;
        settings.samples = 32;
        controller().attachBake(std::make_shared<const BakeArtifact>(
            *bakePrtVertex(bakeInputs(document()), settings, sink, {})));
        set("view.lighting", {Scope::View, 0}, static_cast<int>(LightingMode::Shadowed));
        controller().addLight(LightType::Point);
        lamp = {Scope::Light, document().lights.back().id};
        shadows().setMaxBytes(0);
        move(corner(0.15f, 0.75f, 0.5f));
        set("light.intensity", lamp, 1.0f);
    }
    void TearDown() override { shadows().setMaxBytes(0); }

    static NearShadowUpdater& shadows() { return session->nearShadows; }
    static ViewportWidget& viewport() { return window->viewport(); }
    static void set(const char* name, Target target, const ParameterValue& value,
                    quint64 drag = 0) {
        controller().setParameter(parameter(name), target, value, drag);
    }
    void move(const glm::vec3& place, quint64 drag = 0) const {
        set("light.position", lamp, place, drag);
    }
    // A place of the box by shares of its width, height and depth.
    static glm::vec3 corner(float x, float y, float z) {
        const Bounds bounds = document().bounds();
        return bounds.min + glm::vec3(x, y, z) * (bounds.max - bounds.min);
    }
    static bool atRest() {
        return eventually([] { return viewport().isSettled() && shadows().upToDate(); });
    }

    // Pixels of the picture that show vertices which lie in the light's full shadow, as do all
    // their neighbours, and which the open light would reach; and those that are all lit.
    struct Seen {
        std::vector<QPoint> umbra, lit;
    };
    Seen seen() const {
        Seen result;
        const NearShadowRequest request = nearShadowRequest(document());
        const BakeScene scene = std::move(*BakeScene::build(request.inputs, {}));
        const std::vector<BakePoint> points = vertexPoints(*scene.geometry, {});
        const Camera& camera = document().view.camera;
        NearEmitter eye;
        eye.position = camera.position();
        const auto share = [&](const NearEmitter& emitter) {
            return *nearVisibility(scene, points, emitter, {});
        };
        const std::vector<float> arrives = share(request.lights.at(0).emitter),
                                 visible = share(eye);
        const QImage picture = viewport().grabFramebuffer();
        const glm::mat4 toClip =
            camera.projectionMatrix(float(picture.width()) / float(picture.height()),
                                    document().bounds()) *
            camera.viewMatrix();
        std::size_t first = 0;
        for (const BakeGeometryMesh& mesh : scene.geometry->meshes) {
            for (std::size_t v = 0; v < mesh.positions.size(); v += 5) {
                const glm::vec3 place =
                    glm::vec3(glm::dvec3(mesh.positions[v]) / scene.geometry->unitsPerMetre +
                              scene.geometry->centre);
                const glm::vec3 toLight = request.lights.at(0).emitter.position - place;
                const glm::vec3 toEye = eye.position - place;
                const auto faces = [&](const glm::vec3& d) {
                    return glm::dot(glm::normalize(d), mesh.normals[v]) > 0.15f;
                };
                if (!faces(toLight) || !faces(toEye) || visible[first + v] < 1.0f)
                    continue;
                bool dark = true, bright = true;
                for (std::size_t o = 0; o < mesh.positions.size(); ++o)
                    if (glm::distance(mesh.positions[o], mesh.positions[v]) < 0.12f) {
                        dark &= arrives[first + o] == 0.0f;
                        bright &= arrives[first + o] == 1.0f;
                    }
                const glm::vec4 clip = toClip * glm::vec4(place, 1.0f);
                const QPoint pixel(int((0.5f + 0.5f * clip.x / clip.w) * float(picture.width())),
                                   int((0.5f - 0.5f * clip.y / clip.w) * float(picture.height())));
                if (!picture.rect().contains(pixel))
                    continue;
                if (dark)
                    result.umbra.push_back(pixel);
                if (bright)
                    result.lit.push_back(pixel);
            }
            first += mesh.positions.size();
        }
        return result;
    }
    // 0…255
    static double mean(const std::vector<QPoint>& pixels) {
        const QImage picture = viewport().grabFramebuffer();
        double sum = 0.0;
        for (const QPoint& p : pixels)
            sum += qGray(picture.pixel(p));
        return sum / double(std::max<std::size_t>(pixels.size(), 1));
    }
    static void keep(const char* name) {
        const QString target = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (!target.isEmpty())
            window->grab().save(target + QLatin1Char('/') + QLatin1String(name));
    }
    Target lamp;
};

TEST_F(NearShadowWindow, AMovedLightEndsWithCompleteShadows) {
    ASSERT_TRUE(atRest());
    // Dragged across the box: each step is shown before the next, whatever is being traced.
    int frames = 0, arrivals = 0;
    QObject here;
    QObject::connect(&viewport(), &ViewportWidget::frameRendered, &here, [&] { ++frames; });
    QObject::connect(&shadows(), &NearShadowUpdater::shownChanged, &here, [&] { ++arrivals; });
    const quint64 drag = 77;
    for (int step = 0; step <= 12; ++step) {
        const int before = frames;
        move(corner(0.15f + 0.03f * float(step), 0.75f, 0.6f), drag);
        ASSERT_TRUE(eventually([&] { return frames > before; })) << step;
    }
    move(corner(0.12f, 0.8f, 0.62f), drag);
    ASSERT_TRUE(atRest());
    EXPECT_GT(frames, 0);
    EXPECT_GT(arrivals, 0);
    ASSERT_TRUE(shadows().shown());
    EXPECT_EQ(shadows().shown()->request.lights.at(0).emitter.position,
              document().light(lamp.id)->position);
    const Seen places = seen();
    ASSERT_GT(places.umbra.size(), 10u);
    ASSERT_GT(places.lit.size(), 50u);
    const double umbra = mean(places.umbra), lit = mean(places.lit);
    keep("near-shadows.png");

    // Without rays, which memory can forbid: then it is said, and bands stand in.
    std::vector<UserNotice> notices;
    QObject::connect(&controller(), &DocumentController::noticed, &here,
                     [&](const UserNotice& notice) { notices.push_back(notice); });
    shadows().setMaxBytes(1000);
    controller().addLight(LightType::Point); // of more lights than before
    const Target second{Scope::Light, document().lights.back().id};
    set("light.intensity", second, 0.0f);
    ASSERT_TRUE(eventually([&] { return !notices.empty(); }));
    ASSERT_TRUE(atRest());
    EXPECT_FALSE(shadows().shown());
    EXPECT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Warning);
    EXPECT_TRUE(notices[0].text.contains(QStringLiteral("stay soft")))
        << notices[0].text.toStdString();
    const double leaked = mean(places.umbra);
    keep("near-shadows-refused.png");
    std::printf("umbra %.1f of 255 by rays, %.1f in bands; lit surface %.1f\n", umbra, leaked, lit);
    EXPECT_LT(umbra, 2.0);
    EXPECT_GT(leaked, 5.0);
    EXPECT_GT(lit, 60.0);
    // Moving on says nothing more, and with memory they come back.
    move(corner(0.13f, 0.8f, 0.62f), drag + 1);
    ASSERT_TRUE(atRest());
    EXPECT_EQ(notices.size(), 1u);
    shadows().setMaxBytes(0);
    controller().removeLight(second.id);
    ASSERT_TRUE(atRest());
    ASSERT_TRUE(shadows().shown());
}

TEST_F(NearShadowWindow, FollowsWhatShadowsDependOnAndNothingElse) {
    ASSERT_TRUE(atRest());
    const NearShadowsPtr first = shadows().shown();
    ASSERT_TRUE(first);
    set("light.intensity", lamp, 2.0f);
    set("light.color", lamp, glm::vec3(1.0f, 0.5f, 0.2f));
    set("view.exposureEv", {Scope::View, 0}, 0.5f);
    ASSERT_TRUE(atRest());
    EXPECT_EQ(shadows().shown(), first);
    // Undo leads back to the same shadows.
    move(corner(0.6f, 0.7f, 0.6f));
    ASSERT_TRUE(atRest());
    const NearShadowsPtr moved = shadows().shown();
    EXPECT_NE(*moved->shares[0][0], *first->shares[0][0]);
    EXPECT_EQ(moved->scene, first->scene);
    controller().undoStack().undo();
    ASSERT_TRUE(atRest());
    for (std::size_t p = 0; p < first->shares[0].size(); ++p)
        EXPECT_EQ(*shadows().shown()->shares[0][p], *first->shares[0][p]);
    // Geometry.
    const Id block = document().meshes.back().id;
    controller().setMeshVisible(block, false);
    ASSERT_TRUE(atRest());
    EXPECT_NE(shadows().shown()->scene, first->scene);
    // Off, or in another light: nothing is left to trace.
    set("light.enabled", lamp, false);
    ASSERT_TRUE(atRest());
    EXPECT_FALSE(shadows().shown());
}

// In light that no bake has a say in, nobody traces.
TEST_F(NearShadowWindow, WaitsUntilSomebodyLooks) {
    set("view.lighting", {Scope::View, 0}, static_cast<int>(LightingMode::Ibl));
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    const NearShadowsPtr before = shadows().shown();
    move(corner(0.7f, 0.7f, 0.7f));
    ASSERT_TRUE(eventually([] { return viewport().isSettled(); }));
    QTest::qWait(50); // nothing to wait for: it shows that nothing comes
    EXPECT_EQ(shadows().shown(), before);
    set("view.lighting", {Scope::View, 0}, static_cast<int>(LightingMode::Shadowed));
    ASSERT_TRUE(atRest());
    ASSERT_TRUE(shadows().shown());
    EXPECT_EQ(shadows().shown()->request.lights.at(0).emitter.position,
              document().light(lamp.id)->position);
}

} // namespace
} // namespace patina::editor
