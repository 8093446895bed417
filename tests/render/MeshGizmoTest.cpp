// Where selected meshes can be taken hold of, and what dragging does, without a window.
#include "render/scene/MeshGizmo.h"

#include "core/math/Bounds.h"
#include "core/math/Camera.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina::render {
namespace {

class MeshGizmoTest : public testing::Test {
  protected:
    MeshGizmoTest() {
        m_scene.add(glm::vec3(-1));
        m_scene.add(glm::vec3(1));
        m_camera.distance = 8.0f;
        m_camera.yawDeg = 35.0f;
        m_camera.pitchDeg = 25.0f;
        m_handles.pivot = {0.4f, 0.2f, -0.3f};
    }
    [[nodiscard]] GizmoView view() const {
        return {m_camera.projectionMatrix(1.0f, m_scene) * m_camera.viewMatrix(),
                glm::vec2(1000.0f)};
    }
    [[nodiscard]] glm::vec2 at(const glm::vec3& point) const { return *project(view(), point); }
    MeshMotion motion(GizmoHandle held, const glm::vec2& from, const glm::vec2& to,
                      bool snap = false) {
        m_handles.held = held;
        return meshMotion(m_handles, view(),
                          {from, to, m_camera.right(), m_camera.up(), snap, 0.1f});
    }

    Bounds m_scene;
    Camera m_camera;
    MeshHandles m_handles;
};

TEST_F(MeshGizmoTest, EachHandleIsFoundWhereItIsDrawn) {
    const MeshGizmo gizmo = meshGizmo(m_handles, view());
    ASSERT_EQ(gizmo.handles.size(), 8u); // centre, 3 knobs, 3 squares, scale all
    for (const GizmoPoint& handle : gizmo.handles)
        EXPECT_EQ(pickMeshGizmo(m_handles, view(), handle.at), handle.handle);
    for (const GizmoAxis& axis : kGizmoAxes) {
        int found = 0, lines = 0;
        for (const GizmoLine& line : gizmo.lines)
            if (line.handle == axis.rotate) {
                ++lines;
                found +=
                    pickMeshGizmo(m_handles, view(), 0.5f * (line.from + line.to)) == axis.rotate;
            }
        EXPECT_GT(lines, 10);
        EXPECT_GT(found, lines / 2) << "where no knob or other ring is nearer";
    }
    EXPECT_EQ(pickMeshGizmo(m_handles, view(), {10, 10}), GizmoHandle::None);
    m_handles.several = true;
    EXPECT_EQ(meshGizmo(m_handles, view()).handles.size(), 5u) << "several scale alike";
    m_handles.pivot = m_camera.position() - 3.0f * m_camera.forward();
    EXPECT_TRUE(meshGizmo(m_handles, view()).handles.empty()) << "behind the camera";
}

TEST_F(MeshGizmoTest, AKnobFollowsThePointerAlongItsAxis) {
    for (const GizmoAxis& axis : kGizmoAxes) {
        const glm::vec3 from = m_handles.pivot + 0.5f * axis.direction;
        const glm::vec3 to = m_handles.pivot + 1.7f * axis.direction;
        const MeshMotion moved = motion(axis.move, at(from), at(to));
        EXPECT_LT(glm::distance(moved.move, 1.2f * axis.direction), 1e-3f)
            << "perspective does not make it slip";
        EXPECT_EQ(moved.factors, glm::vec3(1));
        EXPECT_EQ(motion(axis.move, at(from), at(from)).move, glm::vec3(0));
        const MeshMotion snapped =
            motion(axis.move, at(from), at(m_handles.pivot + 1.72f * axis.direction), true);
        EXPECT_LT(glm::distance(snapped.move, 1.2f * axis.direction), 1e-5f);
    }
}

TEST_F(MeshGizmoTest, AnAxisSeenEndOnMovesNothing) {
    m_camera.yawDeg = m_camera.pitchDeg = 0.0f; // along -Z
    m_camera.target = m_handles.pivot;
    EXPECT_EQ(motion(GizmoHandle::AxisZ, {500, 500}, {700, 800}).move, glm::vec3(0));
}

TEST_F(MeshGizmoTest, TheCentreFollowsThePointerInThePlaneOfThePicture) {
    const glm::vec3 to = m_handles.pivot + 0.3f * m_camera.right() - 0.6f * m_camera.up();
    const MeshMotion moved = motion(GizmoHandle::Mark, at(m_handles.pivot), at(to));
    EXPECT_LT(glm::distance(moved.move, to - m_handles.pivot), 2e-3f);
}

TEST_F(MeshGizmoTest, RingsTurnAsThePointerGoesRound) {
    // A quarter turn about each axis, seen along it and from behind.
    for (const GizmoAxis& axis : kGizmoAxes)
        for (const float side : {1.0f, -1.0f}) {
            m_camera.target = m_handles.pivot;
            m_camera.pitchDeg = axis.direction.y * side * 89.0f;
            m_camera.yawDeg = axis.direction.x != 0.0f ? 90.0f * side : side > 0.0f ? 0.0f : 180.0f;
            const glm::vec3 from =
                std::abs(axis.direction.x) > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const glm::vec3 to = glm::cross(axis.direction, from);
            const MeshMotion turned = motion(axis.rotate, at(m_handles.pivot + 0.3f * from),
                                             at(m_handles.pivot + 0.3f * to));
            EXPECT_EQ(turned.axis, axis.direction);
            EXPECT_NEAR(turned.angleDeg, 90.0f, 1.5f) << side;
        }
}

TEST_F(MeshGizmoTest, ARingSeenFromItsSideTurnsAlongIt) {
    m_camera.yawDeg = m_camera.pitchDeg = 0.0f;
    m_camera.target = m_handles.pivot;
    // What faces the eye goes to the right: positive about Y.
    EXPECT_GT(motion(GizmoHandle::RotateY, {500, 500}, {560, 500}).angleDeg, 20.0f);
    EXPECT_LT(motion(GizmoHandle::RotateY, {500, 500}, {440, 500}).angleDeg, -20.0f);
    const float snapped = motion(GizmoHandle::RotateY, {500, 500}, {560, 500}, true).angleDeg;
    EXPECT_FLOAT_EQ(snapped, 15.0f * std::round(snapped / 15.0f));
}

TEST_F(MeshGizmoTest, SquaresScaleAlongTheAxesOfTheMesh) {
    m_handles.axes = glm::mat3(glm::rotate(glm::mat4(1.0f), 0.8f, glm::vec3(0, 1, 0)));
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 axis = m_handles.axes[i];
        const MeshMotion scaled =
            motion(kGizmoAxes[static_cast<std::size_t>(i)].scale, at(m_handles.pivot + 0.3f * axis),
                   at(m_handles.pivot + 0.75f * axis));
        glm::vec3 expected(1.0f);
        expected[i] = 2.5f;
        EXPECT_LT(glm::distance(scaled.factors, expected), 1e-2f);
        EXPECT_EQ(scaled.move, glm::vec3(0));
    }
    EXPECT_NEAR(motion(GizmoHandle::ScaleAll, {500, 500}, {550, 550}).factors.y, 2.0f, 1e-5f);
    EXPECT_GT(motion(GizmoHandle::ScaleAll, {500, 500}, {100, 100}).factors.y, 0.0f)
        << "never to nothing, nor inside out";
}

} // namespace
} // namespace patina::render
