#include "render/pass/NearLightPass.h"

#include "core/base/Check.h"
#include "core/light/Light.h"
#include "core/light/NearRectangle.h"
#include "core/mix/TransferLight.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <unordered_map>

namespace patina::render {
namespace {

struct NearLightBlock {
    std::array<float, kMaxShOrder> window{};
    glm::vec4 center{0.0f}, sideX{0.0f}, sideY{0.0f}, normal{0.0f};
    std::array<float, kRectangleTurnSize> turnFirst{}, turnSecond{};
};
static_assert(sizeof(NearLightBlock) == (2 + 4 + 2 * 154) * sizeof(glm::vec4));

NearLightBlock blockOf(const LightBlock& light) {
    const NearRectangle r =
        nearRectangle(glm::vec3(light.place), glm::vec3(light.axis), glm::vec3(light.side));
    NearLightBlock block;
    block.center = glm::vec4(r.center, 0.0f);
    block.sideX = glm::vec4(r.x, r.halfX);
    block.sideY = glm::vec4(r.y, r.halfY);
    block.normal = glm::vec4(r.normal, 0.0f);
    block.turnFirst = r.turnFirst;
    block.turnSecond = r.turnSecond;
    return block;
}

} // namespace

NearLightPass::NearLightPass(gl::Context& context, ShaderLibrary& shaders)
    : m_context(context)
    , m_shaders(shaders)
    , m_parts(context) {}

void NearLightPass::setLights(const glm::ivec4& ends, std::span<const LightBlock> all,
                              std::span<const Id> ids, std::span<const Id> shareLights) {
    CHECK_LE(static_cast<std::size_t>(ends.w), all.size());
    setRows(ends, ids, shareLights);
    const auto local =
        all.first(static_cast<std::size_t>(ends.w)).subspan(static_cast<std::size_t>(ends.x));
    Lights lights{ends, {local.begin(), local.end()}, std::vector<Id>(local.size(), 0)};
    if (ids.size() == static_cast<std::size_t>(ends.w))
        std::ranges::copy(ids.subspan(static_cast<std::size_t>(ends.x)), lights.ids.begin());
    for (LightBlock& light : lights.lights)
        light.place.w = 0.0f; // the slot of its shadow map says nothing here
    if (lights == m_lights)
        return;
    m_lights = std::move(lights);
    m_blocksOrder = 0;
    ++m_revision;
}

void NearLightPass::setRows(const glm::ivec4& ends, std::span<const Id> ids,
                            std::span<const Id> shareLights) {
    std::unordered_map<Id, std::int32_t> rowOf;
    for (std::size_t row = 0; row < shareLights.size(); ++row)
        rowOf.try_emplace(shareLights[row], static_cast<std::int32_t>(row));
    const auto count = static_cast<std::size_t>(ends.w);
    std::vector<std::int32_t> rows(count, -1);
    for (std::size_t i = 0; i < count && ids.size() == count; ++i)
        if (const auto row = rowOf.find(ids[i]); row != rowOf.end())
            rows[i] = row->second;
    if (rows == m_rows)
        return;
    m_rows = std::move(rows);
    m_rowsBuffer = m_rows.empty()
                       ? gl::Buffer()
                       : gl::Buffer::of<std::int32_t>(m_context, "rows of shares", m_rows);
}

const std::vector<gl::Buffer>& NearLightPass::blocks(int order) {
    if (order == m_blocksOrder)
        return m_blocks;
    m_blocksOrder = order;
    m_blocks.clear();
    const glm::ivec4 ends = m_lights.ends;
    const auto add = [&](NearLightBlock block) {
        block.window = nearLightWindow(order);
        m_blocks.push_back(
            gl::Buffer::of(m_context, "light near by", std::span<const NearLightBlock>(&block, 1)));
    };
    add({});
    for (int i = ends.z; i < ends.w; ++i)
        add(blockOf(m_lights.lights[static_cast<std::size_t>(i - ends.x)]));
    return m_blocks;
}

Result<void> NearLightPass::light(const TransferWork& work, const gl::Buffer& target) {
    target.bindStorage(kNearBinding);
    const std::vector<gl::Buffer>& own = blocks(work.order);
    const glm::ivec4 ends = m_lights.ends;
    bool adds = false;
    const NearShareBuffers* shares =
        work.nearShares != nullptr && work.nearShares->elements == work.count ? work.nearShares
                                                                              : nullptr;
    // The buffer that holds the shares of a light; nothing: it has none.
    const auto bufferOf = [&](int light) -> std::optional<std::size_t> {
        const int row = m_rows[static_cast<std::size_t>(light)];
        if (shares == nullptr || row < 0 || static_cast<std::size_t>(row) >= shares->sources.size())
            return {};
        return static_cast<std::size_t>(row) / shares->perBuffer;
    };
    // As many at a time as find their shares in one buffer.
    const auto run = [&](const char* kind, const gl::Buffer& block, int begin,
                         int end) -> Result<void> {
        while (begin < end) {
            std::optional<std::size_t> buffer = bufferOf(begin);
            int next = begin + 1;
            for (; next < end; ++next) {
                const std::optional<std::size_t> other = bufferOf(next);
                if (other && buffer && *other != *buffer)
                    break;
                buffer = buffer ? buffer : other;
            }
            if (adds)
                glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
            if (auto done = dispatch(work, kind, block, begin, next, adds, buffer); !done)
                return done;
            adds = true;
            begin = next;
        }
        return {};
    };
    if (auto done = run("NEAR_POINTS", own.front(), ends.x, ends.y); !done)
        return done;
    if (auto done = run("NEAR_SPHERES", own.front(), ends.y, ends.z); !done)
        return done;
    for (int i = ends.z; i < ends.w; ++i)
        if (auto done =
                run("NEAR_RECTANGLE", own[static_cast<std::size_t>(1 + i - ends.z)], i, i + 1);
            !done)
            return done;
    return {};
}

Result<void> NearLightPass::dispatch(const TransferWork& work, const char* kind,
                                     const gl::Buffer& block, int begin, int end, bool adds,
                                     std::optional<std::size_t> sharesBuffer) {
    ProgramKey key{{"nearlight.comp"}, {kind, fmt::format("ORDER {}", work.order)}};
    if (work.bounced)
        key.defines.emplace_back("COLORED");
    if (work.openSky)
        key.defines.emplace_back("OPEN_SKY");
    if (m_lights.ends.w > kUniformLights)
        key.defines.emplace_back("MANY_LIGHTS");
    const auto shader = m_shaders.program(key);
    if (!shader)
        return shader.error();
    const gl::Program& program = **shader;
    program.use();
    block.bindUniform(kNearLightBinding);
    program.set("u_adds", adds ? 1 : 0);
    program.set("u_lightBegin", begin);
    program.set("u_lightEnd", end);
    program.set("u_placeVectors", work.placeVectors);
    program.set("u_placeToWorld", work.placeToWorld);
    program.set("u_shareRows", 0);
    if (sharesBuffer) {
        const NearShareBuffers& shares = *work.nearShares;
        shares.buffers[*sharesBuffer].bindStorage(kNearSharesBinding);
        m_rowsBuffer.bindStorage(kNearRowsBinding);
        program.set("u_shareRows", static_cast<int>(shares.perBuffer));
        program.set("u_firstRow", static_cast<int>(*sharesBuffer * shares.perBuffer));
        program.set("u_elementCount", static_cast<int>(work.count));
    }
    program.set("u_normalToWorld", glm::mat4(work.normalToWorld));
    ++m_dispatches;
    m_parts.run(work, [&](int first, int count) {
        program.set("u_first", first);
        program.set("u_count", count);
    });
    return {};
}

} // namespace patina::render
