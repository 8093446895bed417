// Uniform blocks as the shaders see them (std140): shaders/include/frame.glsl, instance.glsl,
// material.glsl and model.glsl have the other side. One line changes there, one here.
#pragma once

#include "core/material/MaterialInputs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace patina::render {

inline constexpr unsigned kFrameBinding = 0, kInstanceBinding = 1, kMaterialBinding = 2,
                          kModelBinding = 3, kShadowBinding = 4, kViewsBinding = 6,
                          kTransferLightBinding = 7, kNearLightBinding = 8;
inline constexpr unsigned kVisibilityBinding = 0, kRecordsBinding = 2, kExitBinding = 3,
                          kNearBinding = 4, kNearRowsBinding = 1, kLightsBinding = 5,
                          kNearSharesBinding = 6,
                          kLightCellsBinding = 7;    // storage blocks
inline constexpr int kUniformLights = 64;            // of the frame's block; more are in ManyLights
inline constexpr int kMaxLights = 4096;              // that are drawn
inline constexpr int kMaxShadows = 4;                // lights that have a shadow map
inline constexpr std::size_t kMaxTransferCount = 64; // order 8

struct LightBlock {
    glm::vec4 place{0.0f}, color{0.0f}, axis{0.0f}, side{0.0f};
    friend bool operator==(const LightBlock&, const LightBlock&) = default;
};

struct FrameBlock {
    glm::mat4 worldToClip{1.0f}, clipToWorld{1.0f}, worldToEnvironment{1.0f};
    glm::vec4 cameraPosition{0.0f};
    glm::vec4 viewport{0.0f};
    glm::vec3 radianceScale{1.0f};
    float irradianceScale = 0.0f;
    std::int32_t prefilteredLevels = 1;
    float prefilteredSide = 1.0f;
    float irradianceSide = 1.0f, irradianceTop = 0.0f;
    std::array<glm::uvec4, 4> irradianceSh{}; // see packIrradiance()
    glm::vec4 dominantLight{0.0f}, dominantIrradiance{0.0f};
    glm::vec2 mix{1.0f};
    glm::vec2 reserved{0.0f};
    glm::ivec4 lightEnds{0};
    std::array<LightBlock, kUniformLights> lights{}; // empty where there are more
};
static_assert(offsetof(FrameBlock, cameraPosition) == 192);
static_assert(offsetof(FrameBlock, radianceScale) == 224);
static_assert(offsetof(FrameBlock, irradianceSh) == 256);
static_assert(sizeof(FrameBlock) == 256 + 8 * 16 + kUniformLights * sizeof(LightBlock));

// shaders/include/shadow.glsl; see ShadowView for the numbers.
struct ShadowBlock {
    glm::mat4 worldToMap{1.0f}, planeToMap{1.0f};
    glm::vec4 light{0.0f};
    glm::vec4 tile{0.0f, 0.0f, 1.0f, 1.0f};
    float penumbra = 0.0f, texelDepth = 0.0f, maxSlope = 0.0f, texel = 0.0f;
};
static_assert(sizeof(ShadowBlock) == 176);
using ShadowBlocks = std::array<ShadowBlock, kMaxShadows>;

struct InstanceBlock {
    glm::mat4 model{1.0f}, normalToWorld{1.0f};
    float handedness = 1.0f;
    std::int32_t reserved = 0;
    std::uint32_t id = 0;
    std::uint32_t materialId = 0;
};
static_assert(sizeof(InstanceBlock) == 144);

// Numbers of the table of inputs, filled up to whole vectors.
inline constexpr std::size_t kInputNumbers = [] {
    std::size_t count = 0;
    for (const MaterialInputInfo& info : kMaterialInputs)
        count += info.number != nullptr ? 1 : 0;
    return (count + 3) / 4 * 4;
}();

struct MapBlock {
    glm::vec4 uvMatrix{1.0f, 0.0f, 0.0f, 1.0f};
    glm::vec4 uvOffset{0.0f};
    glm::vec4 channel{-1.0f, 0.0f, 0.0f, 0.0f};
};

struct MaterialBlock {
    glm::vec4 baseColor{1.0f};
    glm::vec4 emissive{0.0f};
    glm::vec4 normalBasis{1.0f, 0.0f, 0.0f, 1.0f};
    float normalGreenUp = 1.0f, placeholder = 0.0f;
    float diffuseRoughness = 0.0f, ior = 1.5f;
    std::array<float, kInputNumbers> numbers{}; // of the inputs that have one, in their order
    PerInput<MapBlock> maps;
};
static_assert(offsetof(MaterialBlock, normalBasis) == 32);
static_assert(offsetof(MaterialBlock, numbers) == 64);
static_assert(offsetof(MaterialBlock, maps) == 64 + 4 * kInputNumbers);
static_assert(sizeof(MaterialBlock) == 64 + 4 * kInputNumbers + kMaterialInputCount * 48);

// shaders/include/model.glsl.
struct ModelBlock {
    glm::vec4 conductorN{1.0f}; // rgb, f90
    glm::vec4 conductorK{1.0f}; // rgb, ior
};
static_assert(sizeof(ModelBlock) == 32);

// shaders/include/views.glsl.
struct ViewsBlock {
    std::array<std::int32_t, 8> kinds{-1, -1, -1, -1, -1, -1, -1, -1};
    std::array<std::int32_t, 8> modes{};
    glm::vec4 terms{1.0f};
    float emissionTerm = 1.0f;
    std::int32_t light = -1;
    std::int32_t flat = 0;
    std::int32_t halfFloats = 0;
    glm::vec4 furnace{0.0f};
};
static_assert(sizeof(ViewsBlock) == 112);

struct LightRecordBlock {
    glm::vec4 toLight, arriving, diffuse, specular;
};
static_assert(sizeof(LightRecordBlock) == 64);

} // namespace patina::render
