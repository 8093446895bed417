#include "app/editor/job/BounceUpdater.h"
#include "core/material/Material.h"

#include "app/editor/Session.h"
#include "app/editor/job/LivePreview.h"
#include "core/bake/Bake.h"
#include "core/bake/bounce/HitCache.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/EditSession.h"
#include "tests/support/Events.h"

#include <QDir>
#include <QStandardPaths>
#include <QTest>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

struct Bounces : ::testing::Test {
    void SetUp() override {
        controller.openScene(QStringLiteral("builtin:cornell-box"));
        ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.tasks().busy(); }, 60'000));
        for (const Material& material : document().materials)
            if (material.baseColor.r > 2.0f * material.baseColor.g)
                red = {Scope::Material, material.id};
        ASSERT_NE(red.id, 0u);
    }

    [[nodiscard]] const Document& document() const { return controller.document(); }
    [[nodiscard]] BakeArtifactPtr attached() const { return document().bakes.at(0); }
    BakeArtifact bake(TileSink& sink, int times = 2) const {
        PrtSettings settings;
        settings.order = 2;
        settings.samples = 32;
        settings.transfer = TransferKind::Interreflected;
        settings.bounces = times;
        settings.bounceSamples = 16;
        settings.seed = 5;
        return *bakePrtVertex(bakeInputs(document()), settings, sink, {});
    }
    BakeArtifact bake() const {
        TileSink sink;
        return bake(sink);
    }
    void attach() { controller.attachBake(std::make_shared<const BakeArtifact>(bake())); }
    [[nodiscard]] bool ready() const {
        return QTest::qWaitFor([&] { return bounces.upToDate(); }, 60'000);
    }

    // What the light shown is to be, from a bake of so many bounces.
    [[nodiscard]] BouncedLight lit(std::span<const glm::vec3> light, int times) const {
        TileSink sink;
        const BakeArtifact anew = bake(sink, times);
        BouncedLight result;
        for (const VertexBake& mesh : anew.vertices)
            for (std::size_t v = 0; v < mesh.bounced.size(); v += 12) {
                glm::vec3 sum(0.0f);
                for (std::size_t i = 0; i < 4; ++i)
                    for (int c = 0; c < 3; ++c)
                        sum[c] += mesh.bounced[v + 3 * i + std::size_t(c)] * light[i][c];
                result[mesh.mesh].push_back(sum);
            }
        return result;
    }
    static void expectSame(const BouncedLight& shown, const BouncedLight& expected) {
        ASSERT_EQ(shown.size(), expected.size());
        for (const auto& [mesh, radiance] : expected) {
            ASSERT_EQ(shown.at(mesh).size(), radiance.size());
            for (std::size_t v = 0; v < radiance.size(); ++v)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(shown.at(mesh)[v][c], radiance[v][c], 1e-5f) << v;
        }
    }

    const ParameterInfo& baseColor = parameter("material.baseColor");
    Session session;
    DocumentController& controller = session.controller;
    BounceUpdater& bounces = session.bounces;
    Target red;
};

TEST_F(Bounces, FollowAnEditOfAlbedoAsIfBakedAnew) {
    attach();
    ASSERT_TRUE(ready()); // hits traced in the background
    const BakeArtifactPtr before = attached();
    const int steps = controller.undoStack().count();

    // A drag: many edits, one step.
    const DragSession drag = controller.newDragSession();
    for (int i = 0; i <= 10; ++i) {
        controller.setParameter(baseColor, red, glm::vec3(0.05f, 0.05f, 0.07f * float(i)), drag);
        test::handleEvents();
    }
    ASSERT_TRUE(ready());
    const BakeArtifact anew = bake();
    EXPECT_EQ(attached()->albedo, anew.albedo);
    EXPECT_NE(attached()->albedo, before->albedo);
    EXPECT_EQ(*attached(), anew);
    EXPECT_EQ(controller.undoStack().count(), steps + 1);

    // Blue bleeds where red did.
    double redBefore = 0.0, redAfter = 0.0, blueAfter = 0.0;
    for (std::size_t m = 0; m < anew.vertices.size(); ++m)
        for (std::size_t i = 0; i < anew.vertices[m].bounced.size(); i += 12) {
            redBefore += before->vertices[m].bounced[i];
            redAfter += attached()->vertices[m].bounced[i];
            blueAfter += attached()->vertices[m].bounced[i + 2];
        }
    EXPECT_LT(redAfter, 0.9 * redBefore);
    EXPECT_GT(blueAfter, redAfter);

    controller.undoStack().undo();
    ASSERT_TRUE(ready());
    EXPECT_EQ(*attached(), *before);
}

// The last edit of a drag is shown before its coefficients are in the document, and not after.
TEST_F(Bounces, ShowTheLightOfTheNewestEditFirst) {
    attach();
    ASSERT_TRUE(ready());
    const std::vector<glm::vec3> light{{1, 2, 3}, {0.3f, 0, 0.2f}, {0, 0.1f, 0}, {0.4f, 0, 0.5f}};
    bounces.setLight(light);
    EXPECT_EQ(bounces.shown(), nullptr) << "the bake is right as it is";
    const BakeArtifactPtr before = attached();
    std::vector<std::pair<BouncedLightPtr, BakeArtifactPtr>> shown;
    QObject here;
    QObject::connect(&bounces, &BounceUpdater::shownChanged, &here,
                     [&] { shown.emplace_back(bounces.shown(), attached()); });
    const DragSession drag = controller.newDragSession();
    for (int i = 0; i <= 10; ++i)
        controller.setParameter(baseColor, red, glm::vec3(0.05f, 0.05f, 0.07f * float(i)), drag);
    ASSERT_TRUE(ready());
    // The first that was asked for, the newest when that was done, and none.
    ASSERT_EQ(shown.size(), 3u);
    EXPECT_EQ(shown[1].second, before);
    ASSERT_NE(shown[1].first, nullptr);
    expectSame(*shown[1].first, lit(light, 2));
    EXPECT_EQ(shown[2].first, nullptr);
    EXPECT_NE(attached(), before);
}

// What the view asks for is no edit of the bake.
TEST_F(Bounces, ShowAsManyAsTheViewAsksForInAnyLight) {
    attach();
    ASSERT_TRUE(ready());
    const BakeArtifactPtr before = attached();
    const auto follows = [&](std::span<const glm::vec3> light, int times) {
        const BouncedLight expected = lit(light, times);
        const BouncedLightPtr old = bounces.shown();
        bounces.setLight(light);
        ASSERT_TRUE(
            QTest::qWaitFor([&] { return bounces.shown() != old && bounces.upToDate(); }, 60'000));
        ASSERT_NE(bounces.shown(), nullptr);
        expectSame(*bounces.shown(), expected);
    };
    const Target view{Scope::View, 0};
    controller.setParameter(parameter("view.bounces"), view, 1.0f);
    const std::vector<glm::vec3> day{{3, 3, 3}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    const std::vector<glm::vec3> night(4, glm::vec3(0.01f));
    follows(day, 1);
    follows(night, 1);
    controller.setParameter(parameter("view.bounces"), view, 4.0f);
    follows(day, 4);
    EXPECT_EQ(attached(), before);

    controller.setParameter(parameter("view.bounces"), view, 2.0f); // those of the bake
    EXPECT_EQ(bounces.shown(), nullptr);
    controller.setParameter(parameter("view.bounces"), view, 3.0f);
    ASSERT_TRUE(QTest::qWaitFor([&] { return bounces.shown() != nullptr; }, 60'000));
    controller.removeBake(BakeKind::PrtVertex);
    EXPECT_EQ(bounces.shown(), nullptr);
}

// Hits belong to a bake: they are found by it, whoever hears first that it is attached, and whether
// or not a bake runs then.
TEST_F(Bounces, TakeTheHitsOfABakeThatHasJustEnded) {
    LivePreview preview(BakeKind::PrtVertex);
    preview.begin(bakeInputs(document()), 2, 16);
    const auto artifact = std::make_shared<const BakeArtifact>(bake(preview));
    ASSERT_NE(preview.bounceHits(), nullptr);
    FinishedHits& ended = session.bakes.hits();
    ended.keep(artifact, preview.bounceHits());
    EXPECT_EQ(ended.take(std::make_shared<const BakeArtifact>(*artifact)), nullptr)
        << "not its own";
    EXPECT_EQ(ended.take(nullptr), nullptr);
    ASSERT_EQ(session.bakes.preview(), nullptr) << "of old they were looked for there";
    controller.attachBake(artifact);
    ASSERT_TRUE(ready());
    EXPECT_EQ(bounces.hits(), preview.bounceHits().get());
    EXPECT_EQ(ended.take(artifact), nullptr) << "they are large: nobody else keeps them";
}

TEST_F(Bounces, AreHandedTheHitsOfABakeThatRan) {
    ASSERT_TRUE(QDir(QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
                     QStringLiteral("/bakes"))
                    .removeRecursively());
    std::shared_ptr<LivePreview> preview;
    QObject here;
    QObject::connect(&session.bakes, &BakeService::previewChanged, &here, [&] {
        if (session.bakes.preview())
            preview = session.bakes.preview();
    });
    BakeRequest request;
    request.kind = BakeKind::PrtVertex;
    request.prt.order = 2;
    request.prt.samples = 32;
    request.prt.transfer = TransferKind::Interreflected;
    request.prt.bounces = 2;
    request.prt.bounceSamples = 16;
    session.bakes.start(request);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session.jobs.runningCount() == 0; }, 60'000));
    ASSERT_TRUE(ready());
    EXPECT_EQ(session.bakes.preview(), nullptr);
    ASSERT_NE(preview, nullptr);
    ASSERT_NE(preview->bounceHits(), nullptr);
    EXPECT_EQ(bounces.hits(), preview->bounceHits().get());
}

TEST_F(Bounces, LeaveABakeOfOtherGeometryAlone) {
    attach();
    ASSERT_TRUE(ready());
    const BakeArtifactPtr before = attached();
    controller.editStructure(QStringLiteral("Move"), [](Document& moved) {
        moved.meshes[0].placement = glm::translate(glm::mat4(1.0f), glm::vec3(0.1f, 0, 0));
    });
    controller.setParameter(baseColor, red, glm::vec3(0.1f, 0.6f, 0.1f));
    QTest::qWait(100); // nothing to wait for: it shows that nothing comes
    EXPECT_FALSE(bounces.upToDate());
    EXPECT_EQ(bounces.hits(), nullptr);
    EXPECT_EQ(attached(), before);
    // Back where it was, the edit of albedo takes effect.
    controller.undoStack().undo();
    controller.undoStack().undo();
    controller.setParameter(baseColor, red, glm::vec3(0.1f, 0.6f, 0.1f));
    ASSERT_TRUE(ready());
    EXPECT_EQ(*attached(), bake());
}

TEST_F(Bounces, HoldNothingWithoutAnInterreflectedBake) {
    EXPECT_EQ(bounces.hits(), nullptr);
    attach();
    ASSERT_TRUE(ready());
    EXPECT_NE(bounces.hits(), nullptr);
    controller.removeBake(BakeKind::PrtVertex);
    EXPECT_EQ(bounces.hits(), nullptr);
    EXPECT_FALSE(bounces.upToDate());
}

} // namespace
} // namespace patina::editor
