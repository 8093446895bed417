#include "render/scene/ManyLights.h"

#include "core/light/Light.h"

#include <cstring>
#include <utility>

namespace patina::render {
namespace {

// Before the lights.
struct HeadBlock {
    glm::ivec4 ends{0};
    glm::ivec4 gridSize{1}; // w: PackedLights::firstRanged
    glm::vec4 grid{0.0f};   // corner, cells per metre
};
static_assert(sizeof(HeadBlock) == 48);

bool sameBox(const Bounds& a, const Bounds& b) {
    return a.min == b.min && a.max == b.max;
}

} // namespace

void ManyLights::set(PackedLights lights, const Bounds& box) {
    if (m_box && sameBox(*m_box, box) && lights.ends == m_lights.ends &&
        lights.firstRanged == m_lights.firstRanged && lights.lights == m_lights.lights)
        return;
    m_lights = std::move(lights);
    m_box = box;
    ++m_rebuilds;
    const LightCells cells =
        makeLightCells(m_lights.lights, m_lights.firstRanged, m_lights.ends.y, box);
    const HeadBlock head{m_lights.ends, glm::ivec4(cells.size, m_lights.firstRanged),
                         glm::vec4(cells.corner, cells.cellsPerMetre)};
    std::vector<std::byte> bytes(sizeof(head) + m_lights.lights.size() * sizeof(LightBlock));
    std::memcpy(bytes.data(), &head, sizeof(head));
    std::memcpy(bytes.data() + sizeof(head), m_lights.lights.data(), bytes.size() - sizeof(head));
    m_buffer = gl::Buffer(m_context, "many lights", bytes);
    m_cells = gl::Buffer::of<std::uint32_t>(m_context, "cells of lights", cells.lists);
}

void ManyLights::bind() const {
    if (m_buffer.empty())
        return;
    m_buffer.bindStorage(kLightsBinding);
    m_cells.bindStorage(kLightCellsBinding);
}

} // namespace patina::render
