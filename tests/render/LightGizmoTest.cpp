// Where lights can be taken hold of, and what dragging does, without a window.
#include "render/scene/LightGizmo.h"
#include "core/light/Light.h"

#include "core/light/Lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina::render {
namespace {

class Gizmo : public testing::Test {
  protected:
    Gizmo() {
        m_scene.add(glm::vec3(-1));
        m_scene.add(glm::vec3(1));
        m_camera.distance = 8.0f;
        for (const LightType type : {LightType::Point, LightType::Directional, LightType::Spot,
                                     LightType::Sphere, LightType::Rectangle}) {
            Light light = defaultLight(type, m_scene);
            light.id = m_document.takeId();
            light.position = {-1.5f + 0.8f * static_cast<float>(light.id), 1.5f, 0.0f};
            m_document.lights.push_back(light);
        }
    }
    GizmoView view(float size = 1000.0f) const {
        return {m_camera.projectionMatrix(1.0f, m_scene) * m_camera.viewMatrix(), glm::vec2(size)};
    }
    Light& light(LightType type) {
        return *std::find_if(m_document.lights.begin(), m_document.lights.end(),
                             [&](const Light& l) { return l.type == type; });
    }
    LightGizmo gizmo(const Light& light, bool selected = true) const {
        return lightGizmo(m_document, light, m_scene, view(), selected);
    }

    Document m_document;
    Bounds m_scene;
    Camera m_camera;
};

TEST_F(Gizmo, EveryTypeHasAMarkAndTheHandlesItCanUse) {
    const auto handles = [&](LightType type) {
        std::vector<GizmoHandle> result;
        for (const GizmoPoint& point : gizmo(light(type)).handles)
            result.push_back(point.handle);
        return result;
    };
    using H = GizmoHandle;
    EXPECT_EQ(handles(LightType::Point), (std::vector{H::AxisX, H::AxisY, H::AxisZ}));
    EXPECT_EQ(handles(LightType::Sphere), (std::vector{H::AxisX, H::AxisY, H::AxisZ}));
    EXPECT_EQ(handles(LightType::Spot), (std::vector{H::AxisX, H::AxisY, H::AxisZ, H::Aim}));
    EXPECT_EQ(handles(LightType::Rectangle), (std::vector{H::AxisX, H::AxisY, H::AxisZ, H::Aim}));
    EXPECT_TRUE(handles(LightType::Directional).empty()); // its mark turns it
    for (const Light& l : m_document.lights) {
        EXPECT_TRUE(gizmo(l).visible);
        EXPECT_TRUE(gizmo(l, false).handles.empty());
    }
}

TEST_F(Gizmo, WhatIsDrawnIsWhatIsPicked) {
    for (const Light& l : m_document.lights) {
        for (const GizmoPoint& point : gizmo(l).handles) {
            const GizmoHit hit = pickGizmo(m_document, m_scene, view(), l.id, point.at);
            EXPECT_EQ(hit.light, l.id);
            EXPECT_EQ(hit.handle, point.handle);
            // Handles belong to the selected light only.
            const GizmoHit other = pickGizmo(m_document, m_scene, view(), 0, point.at);
            EXPECT_NE(other.handle, point.handle);
        }
        const GizmoHit hit = pickGizmo(m_document, m_scene, view(), 0, gizmo(l).mark + 3.0f);
        EXPECT_EQ(hit.light, l.id);
        EXPECT_EQ(hit.handle, GizmoHandle::Mark);
    }
    EXPECT_EQ(pickGizmo(m_document, m_scene, view(), 1, {5, 5}).light, 0u);
}

TEST_F(Gizmo, HandlesHaveTheSameSizeAtAnyDistance) {
    m_camera.target = light(LightType::Point).position; // straight ahead
    m_camera.pitchDeg = 0.0f;
    m_camera.yawDeg = 0.0f;
    for (const float distance : {2.0f, 20.0f, 200.0f}) {
        m_camera.distance = distance;
        const LightGizmo g = gizmo(light(LightType::Point));
        EXPECT_NEAR(glm::distance(g.handles[0].at, g.mark), kGizmoReach, 1.0f) << distance;
        EXPECT_NEAR(glm::distance(g.handles[1].at, g.mark), kGizmoReach, 1.0f) << distance;
    }
}

TEST_F(Gizmo, BehindTheCameraThereIsNothing) {
    Light& l = light(LightType::Spot);
    l.position = m_camera.position() - m_camera.forward();
    EXPECT_FALSE(gizmo(l).visible);
    EXPECT_TRUE(gizmo(l).handles.empty());
    EXPECT_EQ(pixelsPerMetre(view(), l.position), 0.0f);
    EXPECT_EQ(draggedLight(l, GizmoHandle::Mark, m_scene, view(), m_camera.right(), m_camera.up(),
                           {50, 50})
                  .position,
              l.position);
}

TEST_F(Gizmo, MarksFollowThePointer) {
    for (Light& l : m_document.lights) {
        const glm::vec2 before = gizmo(l).mark, by(12, -7);
        const Light dragged = draggedLight(l, GizmoHandle::Mark, m_scene, view(), m_camera.right(),
                                           m_camera.up(), by);
        if (hasPosition(l.type)) {
            EXPECT_LT(glm::distance(gizmo(dragged).mark, before + by), 0.5f);
            EXPECT_EQ(dragged.azimuthDeg, l.azimuthDeg);
        } else { // on its sphere about the scene, so not to the pixel
            EXPECT_GT(glm::dot(gizmo(dragged).mark - before, by), 0.5f * glm::dot(by, by));
            EXPECT_EQ(dragged.position, l.position);
        }
    }
}

TEST_F(Gizmo, AimingTurnsTowardsThePointerAndDoesNotMove) {
    Light& l = light(LightType::Rectangle);
    l.azimuthDeg = 0.0f;
    l.elevationDeg = 60.0f;
    const glm::vec2 before = gizmo(l).handles[3].at, by(-15, 10);
    const Light turned =
        draggedLight(l, GizmoHandle::Aim, m_scene, view(), m_camera.right(), m_camera.up(), by);
    EXPECT_EQ(turned.position, l.position);
    EXPECT_GT(glm::dot(gizmo(turned).handles[3].at - before, by), 0.3f * glm::dot(by, by));
}

TEST_F(Gizmo, WhatDoesNotShineIsDim) {
    Light& l = light(LightType::Point);
    const float bright = gizmo(l).color.r;
    light(LightType::Sphere).solo = true;
    EXPECT_LT(gizmo(l).color.r, 0.6f * bright);
    EXPECT_FALSE(gizmo(l).shining);
}

} // namespace
} // namespace patina::render
