#include "render/scene/SceneSlice.h"

#include <glm/ext/matrix_transform.hpp>

namespace patina::render {

glm::mat4 clipOfRect(const glm::ivec4& rect, int width, int height) {
    const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
    const glm::vec2 low = glm::vec2(rect.x - 1, rect.y - 1) / size;
    const glm::vec2 extent = glm::vec2(rect.z + 2, rect.w + 2) / size;
    const glm::vec2 center = 2.0f * low + extent - 1.0f;
    const glm::mat4 scaled = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f / extent, 1.0f));
    return glm::translate(scaled, glm::vec3(-center, 0.0f));
}

} // namespace patina::render
