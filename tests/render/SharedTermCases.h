// Every function of shaders/shared as a case that is run in both languages: CASE keeps its body as
// C++ and, as text, as GLSL. I(k) are the inputs, O(k) the outputs.
#pragma once

#include "core/edit/ParameterChoices.h"
#include "core/math/Shading.h"

#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace patina::render {

inline constexpr int kCaseInputs = 32, kCaseOutputs = 28;

// Of the choices of a model.
inline constexpr int kDistributionCount = static_cast<int>(kDistributions.names().size());
inline constexpr int kVisibilityCount = static_cast<int>(kVisibilities.names().size());
inline constexpr int kFresnelCount = static_cast<int>(kFresnels.names().size());
inline constexpr int kDiffuseCount = static_cast<int>(kDiffuses.names().size());

// Fills one set of inputs.
class InputMaker {
  public:
    explicit InputMaker(unsigned seed)
        : m_random(seed) {}
    float uniform(float low = 0.0f, float high = 1.0f) {
        // Built from bits: std::uniform_real_distribution differs between libraries.
        return low + (high - low) * static_cast<float>(m_random() >> 8) * 0x1p-24f;
    }
    void numbers(std::span<float> in, float low, float high) {
        for (float& value : in)
            value = uniform(low, high);
    }
    void direction(std::span<float> in);
    // A direction in the hemisphere of `n`.
    void directionAbove(std::span<const float> n, std::span<float> in);

  private:
    std::mt19937 m_random;
};

struct SharedTermCase {
    std::string name;
    std::string body; // as GLSL
    void (*run)(const float* in, float* out);
    std::function<void(InputMaker&, std::span<float>)> prepare;
    // Sums with cancelling terms are compared relative to the size of the terms.
    float scale;
};

[[nodiscard]] const std::vector<SharedTermCase>& sharedTermCases();

// What the bodies name; other inputs have their defaults. For GLSL it is in SharedTermShader.cpp.
[[nodiscard]] inline shading::SurfaceInputs surfaceOf(const glm::vec3& baseColor, float metallic,
                                                      float perceptualRoughness,
                                                      float diffuseRoughness) {
    shading::SurfaceInputs inputs;
    inputs.baseColor = baseColor;
    inputs.metallic = metallic;
    inputs.perceptualRoughness = perceptualRoughness;
    inputs.diffuseRoughness = diffuseRoughness;
    return inputs;
}

} // namespace patina::render
