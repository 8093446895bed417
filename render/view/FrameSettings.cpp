#include "render/view/FrameSettings.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

// As edits of the document's do, any other look makes the scene another.
bool sameLook(const std::optional<View>& a, const std::optional<View>& b) {
    if (!a || !b)
        return a.has_value() == b.has_value();
    View moved = *a;
    moved.camera = b->camera;
    return moved == *b;
}

} // namespace

glm::vec3 rightSide(const ViewSplit& split, int width, int height) {
    const float angle = glm::radians(split.angleDeg);
    const glm::vec2 normal(std::cos(angle), -std::sin(angle));
    const glm::vec2 through(split.position.x * static_cast<float>(width),
                            (1.0f - split.position.y) * static_cast<float>(height));
    return {normal, -glm::dot(normal, through)};
}

bool isStretched(const FrameSettings& frame) {
    return frame.shownWidth > 0 &&
           (frame.shownWidth != frame.width || frame.shownHeight != frame.height);
}

FrameSettings withDepthOfField(const FrameSettings& frame) {
    FrameSettings result = frame;
    if (frame.camera.lensRadius() > 0.0f) {
        result.samples = 1;
        result.accumulate = true;
    }
    return result;
}

bool showSameScene(const FrameSettings& a, const FrameSettings& b) {
    ViewSettings view = a.view;
    view.flags = b.view.flags; // marks are drawn over the numbers
    return a.width == b.width && a.height == b.height && a.samples == b.samples &&
           a.floats == b.floats && a.coarse == b.coarse && a.accumulate == b.accumulate &&
           a.camera == b.camera && a.light == b.light && a.radiance == b.radiance &&
           sameLook(a.look, b.look) && a.transparentBackground == b.transparentBackground &&
           view == b.view;
}

bool showSameOverlays(const FrameSettings& a, const FrameSettings& b) {
    return isStretched(a) == isStretched(b) && a.showOverlays == b.showOverlays &&
           a.selectedMesh == b.selectedMesh && a.selectedLight == b.selectedLight &&
           a.meshHandles == b.meshHandles && a.lobe == b.lobe && a.overlayScale == b.overlayScale;
}

FrameSettings withOverlaysOf(const FrameSettings& frame, const FrameSettings& other) {
    FrameSettings result = frame;
    result.showOverlays = other.showOverlays;
    result.selectedMesh = other.selectedMesh;
    result.selectedLight = other.selectedLight;
    result.meshHandles = other.meshHandles;
    result.lobe = other.lobe;
    result.overlayScale = other.overlayScale;
    return result;
}

} // namespace patina::render
