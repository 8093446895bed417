// The pin without a window: where it is found again.
#include "app/editor/viewport/SurfacePin.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

Document scene() {
    Document document;
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}};
    mesh->indices = {0, 1, 2};
    MeshInstance instance;
    instance.id = 7;
    instance.mesh = mesh;
    document.meshes.push_back(instance);
    document.view.camera.yawDeg = document.view.camera.pitchDeg = 0.0f;
    document.view.camera.distance = 4.0f;
    document.view.camera.fovDeg = 90.0f; // 8 m high at the target
    return document;
}

render::Inspection at(const glm::vec3& position) {
    render::Inspection inspection;
    inspection.mesh = 7;
    inspection.width = 200;
    inspection.height = 100;
    inspection.values[shading::kRecordPosition] = glm::vec4(position, 1.0f);
    inspection.values[shading::kViewGeometricNormal] = {0, 0, 1, 1};
    inspection.values[shading::kRecordToViewer] = {0, 0, 1, 1};
    return inspection;
}

TEST(SurfacePin, IsFoundWhereTheCameraSeesIt) {
    Document document = scene();
    const SurfacePin pin(at({1.0f, 0.5f, 0.0f}), document);
    const auto place = pin.place(document, {200, 100});
    ASSERT_TRUE(place.has_value());
    EXPECT_NEAR(place->x(), 100 + 12.5, 1e-3); // 12.5 pixels a metre
    EXPECT_NEAR(place->y(), 50 - 6.25, 1e-3);
    document.view.camera.target.x = 10.0f; // 125 pixels to the left of the middle
    EXPECT_FALSE(pin.place(document, {200, 100}).has_value());
    document.view.camera.target.x = 0.0f;
    document.view.camera.distance = -1.0f; // behind the viewer
    EXPECT_FALSE(pin.place(document, {200, 100}).has_value());
}

TEST(SurfacePin, GoesWhereItsMeshGoes) {
    Document document = scene();
    document.meshes[0].placement = glm::rotate(glm::mat4(1.0f), 1.5707963f, {0, 1, 0});
    const SurfacePin pin(at({0.0f, 0.5f, -1.0f}), document); // x of the mesh
    document.meshes[0].placement = glm::translate(glm::mat4(1.0f), {0, 2, 0});
    const auto position = pin.position(document);
    ASSERT_TRUE(position.has_value());
    EXPECT_LT(glm::distance(*position, {1.0f, 2.5f, 0.0f}), 1e-5f);
    document.meshes.clear();
    EXPECT_FALSE(pin.position(document).has_value());
    EXPECT_FALSE(pin.place(document, {200, 100}).has_value());
}

TEST(SurfacePin, IsHiddenByWhatLiesInFront) {
    const Document document = scene();
    const SurfacePin pin(at({1.0f, 0.5f, 0.0f}), document);
    // A pixel is 8 cm wide at this distance.
    EXPECT_TRUE(pin.isSeen(at({1.0f, 0.5f, 0.0f}), document));
    EXPECT_TRUE(pin.isSeen(at({1.05f, 0.45f, 0.0f}), document));
    EXPECT_FALSE(pin.isSeen(at({1.0f, 0.5f, 0.3f}), document));
    render::Inspection other = at({1.0f, 0.5f, 0.0f});
    other.mesh = 8;
    EXPECT_FALSE(pin.isSeen(other, document));
    // Along a surface that is seen from the side a pixel reaches further.
    render::Inspection grazing = at({1.4f, 0.5f, 0.0f});
    EXPECT_FALSE(pin.isSeen(grazing, document));
    grazing.values[shading::kRecordToViewer] = {0.98f, 0, 0.2f, 1};
    EXPECT_TRUE(pin.isSeen(grazing, document));
}

} // namespace
} // namespace patina::editor
