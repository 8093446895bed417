#include "tests/render/SharedTermShader.h"

#include "core/material/MaterialInputs.h"
#include "render/shader/ShaderSources.h"
#include "tests/render/SharedTermCases.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>

namespace patina::render {

// surfaceOf() of SharedTermCases.h: inputs that the cases do not name are as in C++.
static std::string surfaceOfShader() {
    std::string text = "SurfaceInputs surfaceOf(vec3 baseColor, float metallic, "
                       "float perceptualRoughness, float diffuseRoughness) {\n"
                       "SurfaceInputs inputs;\n";
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.role == InputRole::Number) {
            const std::string_view id = info.parameters.value();
            text += fmt::format("inputs.{} = {:f};\n", id.substr(id.rfind('.') + 1),
                                shading::SurfaceInputs().*info.shown);
        }
    return text + "inputs.baseColor = baseColor;\n"
                  "inputs.metallic = metallic;\n"
                  "inputs.perceptualRoughness = perceptualRoughness;\n"
                  "inputs.diffuseRoughness = diffuseRoughness;\n"
                  "inputs.ior = kDielectricIor;\n"
                  "return inputs;\n}\n";
}

std::string sharedTermShader(const std::string& body) {
    std::string text = "#version 450 core\n"
                       "layout(local_size_x = " +
                       std::to_string(kCaseGroup) +
                       ") in;\n"
                       "layout(std430, binding = 0) readonly buffer In { float b_in[]; };\n"
                       "layout(std430, binding = 1) writeonly buffer Out { float b_out[]; };\n"
                       "float out_[" +
                       std::to_string(kCaseOutputs) +
                       "];\n"
                       "#define I(k) b_in[gl_GlobalInvocationID.x * " +
                       std::to_string(kCaseInputs) +
                       " + (k)]\n"
                       "#define O(k) out_[k]\n"
                       "#define OUT3(k, v) { vec3 value = v; O(k) = value.x; O(k + 1) = value.y; "
                       "O(k + 2) = value.z; }\n"
                       "#define IS_LIGHT(x) ((x) >= 0.0f && (x) < 3e38f ? 1.0f : 3.0f)\n"
                       "#define SURFACE_OF(model) makeSurface(model, "
                       "surfaceOf(vec3(I(9), I(10), I(11)), I(12), I(13), I(25)), "
                       "vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5)), vec2(I(14), I(15)))\n"
                       "#define SURFACE SURFACE_OF(defaultBrdfModel())\n"
                       "#define CHOOSE_MODEL(m) BrdfModel m = defaultBrdfModel(); "
                       "m.distribution = int(0.999f * float(kDistributionCount) * I(26)); "
                       "m.visibility = int(0.999f * float(kVisibilityCount) * I(27)); "
                       "m.fresnel = int(0.999f * float(kFresnelCount) * I(28)); "
                       "m.diffuse = int(0.999f * float(kDiffuseCount) * I(29)); "
                       "m.multiScatter = int(1.999f * I(30)); "
                       "m.f90 = I(31); m.ior = 1.0f + I(22); "
                       "m.conductorN = vec3(0.05f + 3.0f * I(23), 1.0f, 0.2f); "
                       "m.conductorK = vec3(5.0f * I(24), 2.0f, 3.0f);\n";
    for (const auto& [name, count] : {std::pair{"kDistributionCount", kDistributionCount},
                                      {"kVisibilityCount", kVisibilityCount},
                                      {"kFresnelCount", kFresnelCount},
                                      {"kDiffuseCount", kDiffuseCount}})
        text += fmt::format("const int {} = {};\n", name, count);
    for (const char* file :
         {"shared/ibl.glsl", "shared/normalmap.glsl", "shared/tonemap.glsl", "shared/sampling.glsl",
          "shared/lights.glsl", "shared/rgbe.glsl", "shared/nearlight.glsl"}) {
        ExpandedShader expanded;
        EXPECT_TRUE(expandShader(ShaderSources(), file, {}, expanded).ok()) << file;
        text += expanded.text;
    }
    text += surfaceOfShader();
    return text + "void main() {\nfor (int i = 0; i < " + std::to_string(kCaseOutputs) +
           "; ++i) out_[i] = 0.0f;\n" + body + "\nfor (int i = 0; i < " +
           std::to_string(kCaseOutputs) + "; ++i) b_out[gl_GlobalInvocationID.x * " +
           std::to_string(kCaseOutputs) + " + i] = out_[i];\n}\n";
}

} // namespace patina::render
