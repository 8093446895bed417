#include "render/pass/InspectPass.h"

#include "render/scene/LightBlocks.h"

#include <cstring>
#include <epoxy/gl.h>

namespace patina::render {
namespace {

// shaders/include/views.glsl.
struct RecordsBlock {
    std::array<glm::vec4, shading::kRecordCount> values;
    std::array<glm::vec4, shading::kViewCount> parts;
    std::array<LightRecordBlock, kMaxLights> lights;
};

} // namespace

InspectPass::InspectPass(gl::Context& context)
    : m_records(context, "records", sizeof(RecordsBlock)) {}

Result<void> InspectPass::draw(const GpuScene& scene, const DrawItem& item, const PickPass& picked,
                               SurfacePass& surface, const SurfaceSettings& settings, int x, int y,
                               Inspection& result) {
    m_records.writeValue(RecordsBlock{});
    m_records.bindStorage(kRecordsBinding);
    picked.target().bind();
    glScissor(x, y, 1, 1);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL); // what picking has left there
    glDepthMask(GL_FALSE);
    glDisable(GL_BLEND);
    Result<void> done = surface.draw(scene, {&item}, settings);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_SCISSOR_TEST);
    if (!done)
        return done;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

    RecordsBlock records;
    std::memcpy(&records, m_records.read().data(), sizeof(records));
    result.values = records.values;
    result.contributions = records.parts;
    const std::vector<Id> order = lightOrder(scene.document());
    const auto count = static_cast<std::size_t>(settings.lightEnds.w);
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) {
        const LightRecordBlock& light = records.lights[i];
        result.lights.push_back({order[i], glm::vec3(light.toLight), glm::vec3(light.arriving),
                                 light.toLight.w, glm::vec3(light.diffuse),
                                 glm::vec3(light.specular)});
    }
    return {};
}

} // namespace patina::render
