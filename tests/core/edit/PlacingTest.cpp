#include "core/edit/Placing.h"

#include "core/document/SceneModels.h"
#include "core/edit/EditSession.h"
#include "core/edit/Looks.h"
#include "core/library/Meshes.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

// Two spheres of radius ½ of one model, one of another.
class PlacingTest : public testing::Test {
  protected:
    PlacingTest() {
        const auto ball = std::make_shared<const Mesh>(library::makeSphere(24, 12));
        for (int i = 0; i < 3; ++i) {
            MeshInstance& mesh = m_document.meshes.emplace_back();
            mesh.id = m_document.takeId();
            mesh.name = "ball " + std::to_string(i);
            mesh.source = i < 2 ? "/models/two.obj" : "/models/one.obj";
            mesh.sourceIndex = i % 2;
            mesh.mesh = ball;
            mesh.placement =
                glm::translate(glm::mat4(1.0f), glm::vec3(2.0f * static_cast<float>(i), 1, 0));
            m_ids.push_back(mesh.id);
        }
        m_session.replace(m_document);
    }
    [[nodiscard]] const Placement& placed(std::size_t mesh) const {
        return m_session.document().meshes[mesh].placement;
    }
    [[nodiscard]] Bounds boundsOf(std::size_t mesh) const {
        return exactBounds(m_session.document(), std::span(&m_ids[mesh], 1));
    }

    Document m_document;
    std::vector<Id> m_ids;
    EditSession m_session;
};

TEST_F(PlacingTest, ParametersMoveRotateAndScale) {
    const Target target{Scope::Mesh, m_ids[0]};
    m_session.setParameter(parameter("mesh.position"), target, glm::vec3(0, 5, 0));
    m_session.setParameter(parameter("mesh.rotationDeg"), target, glm::vec3(0, 0, 450));
    m_session.setParameter(parameter("mesh.scale"), target, glm::vec3(2, 1, 1));
    EXPECT_EQ(placed(0).rotationDeg(), glm::vec3(0, 0, 90)) << "angles wrap";
    const Bounds bounds = boundsOf(0); // its X is the world's Y
    EXPECT_NEAR(bounds.max.y - bounds.min.y, 2.0f * (bounds.max.x - bounds.min.x), 1e-4f);
    EXPECT_NEAR(bounds.center().y, 5.0f, 1e-5f);
    m_session.resetParameter(parameter("mesh.position"), target);
    EXPECT_EQ(placed(0).position(), glm::vec3(0, 1, 0)) << "a reset is the file's place";
    for (int i = 0; i < 4; ++i)
        m_session.undo();
    EXPECT_EQ(m_session.document(), m_document);
}

TEST_F(PlacingTest, ADragIsOneStepAndReturningIsNone) {
    const DragSession session = m_session.newDragSession();
    const Placements before = placementsOf(m_session.document(), m_ids);
    for (int i = 1; i <= 5; ++i)
        m_session.placeMeshes(moved(before, {0.1f * static_cast<float>(i), 0, 0}), "Move", session);
    EXPECT_EQ(m_session.count(), 1);
    EXPECT_FLOAT_EQ(placed(2).position().x, 4.5f);
    m_session.placeMeshes(before, "Move", session);
    EXPECT_EQ(m_session.count(), 0);
    EXPECT_EQ(m_session.document(), m_document);
}

TEST_F(PlacingTest, DroppedMeshesStandOnTheGroundTogether) {
    const std::vector<Id> model = meshesOfModel(m_document, m_ids[1]);
    ASSERT_EQ(model, (std::vector<Id>{m_ids[0], m_ids[1]}));
    m_session.setParameter(parameter("mesh.position"), {Scope::Mesh, m_ids[1]}, glm::vec3(2, 4, 0));
    m_session.placeMeshes(droppedToGround(m_session.document(), model), "Drop");
    EXPECT_NEAR(boundsOf(0).min.y, 0.0f, 1e-6f);
    EXPECT_NEAR(boundsOf(1).min.y, 3.0f, 1e-5f) << "as far above the other as before";
    EXPECT_EQ(placed(2).position().y, 1.0f);
    // By its vertices: the box of a rotated ball would stand below it.
    m_session.setParameter(parameter("mesh.rotationDeg"), {Scope::Mesh, m_ids[2]},
                           glm::vec3(30, 0, 45));
    m_session.placeMeshes(droppedToGround(m_session.document(), std::span(&m_ids[2], 1)), "Drop");
    EXPECT_NEAR(boundsOf(2).min.y, 0.0f, 1e-6f);
}

TEST_F(PlacingTest, AModelRotatesAndScalesAsOneThing) {
    const std::vector<Id> model{m_ids[0], m_ids[1]};
    const glm::vec3 pivot(1, 1, 0);
    Placements after = rotated(placementsOf(m_document, model), pivot, {0, 1, 0}, 90.0f);
    after = scaled(std::move(after), pivot, glm::vec3(2.0f));
    m_session.placeMeshes(after, "Turn");
    EXPECT_LT(glm::distance(placed(0).position(), {1, 1, 2}), 1e-5f);
    EXPECT_LT(glm::distance(placed(1).position(), {1, 1, -2}), 1e-5f);
    EXPECT_NEAR(boundsOf(0).size().y, 2.0f * boundsOf(2).size().y, 1e-5f);
    m_session.placeMeshes(backInPlace(m_session.document(), model), "Back");
    EXPECT_EQ(m_session.document(), m_document);
}

TEST_F(PlacingTest, ProjectsKeepWhereMeshesStand) {
    m_session.setParameter(parameter("mesh.position"), {Scope::Mesh, m_ids[0]}, glm::vec3(1, 2, 3));
    m_session.setParameter(parameter("mesh.rotationDeg"), {Scope::Mesh, m_ids[0]},
                           glm::vec3(10, -20, 30.5f));
    m_session.setParameter(parameter("mesh.scale"), {Scope::Mesh, m_ids[1]}, glm::vec3(1, 2, 3));
    const std::string json = documentToJson(m_session.document(), "/p/scene.patina");
    EXPECT_EQ(json.find("\"position\": [4.0"), std::string::npos) << "untouched: not written";
    const Result<Document> back = documentFromJson(json, "/p/scene.patina");
    ASSERT_TRUE(back.ok()) << back.error().text();
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(back->meshes[i].placement, placed(i));
}

TEST_F(PlacingTest, LooksLeaveMeshesWhereTheyAre) {
    const Id snapshot = m_session.keepSnapshot("Before", nullptr);
    m_session.setParameter(parameter("mesh.position"), {Scope::Mesh, m_ids[0]}, glm::vec3(1, 2, 3));
    m_session.restoreSnapshot(snapshot);
    EXPECT_EQ(placed(0).position(), glm::vec3(1, 2, 3));
}

TEST_F(PlacingTest, RandomEditsAreTakenBackToTheBit) {
    std::mt19937 random(20261129);
    std::uniform_real_distribution<float> number(-2.0f, 2.0f);
    for (int i = 0; i < 200; ++i) {
        const auto mesh = static_cast<std::size_t>(random() % 3);
        const glm::vec3 v(number(random), number(random), number(random));
        const Target target{Scope::Mesh, m_ids[mesh]};
        switch (random() % 5) {
        case 0:
            m_session.setParameter(parameter("mesh.position"), target, v);
            break;
        case 1:
            m_session.setParameter(parameter("mesh.rotationDeg"), target, 90.0f * v);
            break;
        case 2:
            m_session.setParameter(parameter("mesh.scale"), target, 2.1f + v);
            break;
        case 3:
            m_session.placeMeshes(rotated(placementsOf(m_session.document(), m_ids), v,
                                          glm::normalize(v + 0.01f), 40.0f * v.x),
                                  "Turn");
            break;
        default:
            m_session.duplicateMesh(m_ids[mesh]);
            break;
        }
    }
    const Document after = m_session.document();
    EXPECT_EQ(m_session.count(), 200);
    m_session.goTo(0);
    m_document.nextId = m_session.document().nextId; // ids are never given twice
    EXPECT_EQ(m_session.document(), m_document);
    m_session.goTo(m_session.count());
    EXPECT_EQ(m_session.document(), after);
}

TEST_F(PlacingTest, ACopyIsAModelOfItsOwn) {
    const Id copy = m_session.duplicateMesh(m_ids[0]);
    const Document& document = m_session.document();
    ASSERT_EQ(document.meshes.back().id, copy);
    EXPECT_EQ(document.meshes.back().placement, placed(0));
    EXPECT_NE(document.meshes.back().name, document.meshes[0].name);
    EXPECT_EQ(meshesOfModel(document, m_ids[0]), (std::vector<Id>{m_ids[0], m_ids[1]}));
    EXPECT_EQ(meshesOfModel(document, copy), std::vector<Id>{copy});
    EXPECT_TRUE(meshesOfModel(document, 999).empty());
}

} // namespace
} // namespace patina
