#include "render/pass/InspectPass.h"

#include "core/light/Light.h"
#include "render/scene/LightBlocks.h"

#include <algorithm>
#include <cstring>
#include <epoxy/gl.h>
#include <span>

namespace patina::render {
namespace {

// shaders/include/views.glsl, before the lights' records.
struct RecordsBlock {
    std::array<glm::vec4, shading::kRecordCount> values;
    std::array<glm::vec4, shading::kViewCount> parts;
};

// Of a record that the shader has not written: no number that it computes has these bits.
constexpr std::byte kUntouched{0xff};

} // namespace

InspectPass::InspectPass(gl::Context& context)
    : m_context(context) {}

Result<void> InspectPass::draw(const GpuScene& scene, const std::vector<const DrawItem*>& items,
                               const PickPass& picked, SurfacePass& surface,
                               const SurfaceSettings& settings, int x, int y, Inspection& result) {
    const auto count = static_cast<std::size_t>(
        settings.hasManyLights() ? scene.manyLights().lights().ends.w : kUniformLights);
    std::vector<std::byte> before(sizeof(RecordsBlock) + count * sizeof(LightRecordBlock));
    std::fill_n(before.begin(), sizeof(RecordsBlock::values), kUntouched);
    if (m_records.size() != before.size())
        m_records = gl::Buffer(m_context, "records", before.size());
    m_records.write(0, before);
    m_records.bindStorage(kRecordsBinding);
    picked.target().bind();
    glScissor(x, y, 1, 1);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL); // what picking has left there
    glDepthMask(GL_FALSE);
    glDisable(GL_BLEND);
    Result<void> done = surface.draw(scene, items, settings);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_SCISSOR_TEST);
    if (!done)
        return done;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

    const std::vector<std::byte> bytes = m_records.read();
    RecordsBlock records;
    std::memcpy(&records, bytes.data(), sizeof(records));
    std::vector<LightRecordBlock> lights(count);
    std::memcpy(lights.data(), bytes.data() + sizeof(records), count * sizeof(LightRecordBlock));
    for (std::size_t i = 0; i < records.values.size(); ++i) {
        const auto written = std::as_bytes(std::span(&records.values[i], 1));
        result.recorded[i] =
            std::ranges::any_of(written, [](std::byte b) { return b != kUntouched; });
        result.values[i] = result.recorded[i] ? records.values[i] : glm::vec4(0.0f);
    }
    result.contributions = records.parts;
    const std::vector<Id> order = lightOrder(scene.document());
    const auto lit = std::min(static_cast<std::size_t>(settings.lightEnds.w), count);
    for (std::size_t i = 0; i < std::min(lit, order.size()); ++i) {
        const LightRecordBlock& light = lights[i];
        result.lights.push_back({order[i], glm::vec3(light.toLight), glm::vec3(light.arriving),
                                 light.toLight.w, glm::vec3(light.diffuse),
                                 glm::vec3(light.specular)});
    }
    return {};
}

} // namespace patina::render
