// The GPU and the CPU run the same terms: so "the preview matches the reference" is this test.
#include "render/gl/Buffer.h"
#include "render/gl/Program.h"
#include "render/shader/ShaderSources.h"
#include "tests/render/GlTest.h"
#include "tests/render/SharedTermCases.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <regex>
#include <set>

namespace patina::render {
namespace {

constexpr int kGroup = 64, kGroups = 800; // 51,200 sets of inputs
constexpr int kCount = kGroup * kGroups;
constexpr float kTolerance = 1e-3f; // relative

std::string computeShader(const SharedTermCase& c) {
    std::string text = "#version 450 core\n"
                       "layout(local_size_x = " +
                       std::to_string(kGroup) +
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
                       "#define SURFACE_OF(model) makeSurface(model, vec3(I(9), I(10), I(11)), "
                       "I(12), I(13), I(25), vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5)), "
                       "vec2(I(14), I(15)))\n"
                       "#define SURFACE SURFACE_OF(defaultBrdfModel())\n"
                       "#define CHOOSE_MODEL(m) BrdfModel m = defaultBrdfModel(); "
                       "m.distribution = int(2.999f * I(26)); "
                       "m.visibility = int(5.999f * I(27)); m.fresnel = int(3.999f * I(28)); "
                       "m.diffuse = int(3.999f * I(29)); m.multiScatter = int(1.999f * I(30)); "
                       "m.f90 = I(31); m.ior = 1.0f + I(22); "
                       "m.conductorN = vec3(0.05f + 3.0f * I(23), 1.0f, 0.2f); "
                       "m.conductorK = vec3(5.0f * I(24), 2.0f, 3.0f);\n";
    for (const char* file : {"shared/ibl.glsl", "shared/normalmap.glsl", "shared/tonemap.glsl",
                             "shared/sampling.glsl", "shared/lights.glsl"}) {
        ExpandedShader expanded;
        EXPECT_TRUE(expandShader(ShaderSources(), file, {}, expanded).ok()) << file;
        text += expanded.text;
    }
    return text + "void main() {\nfor (int i = 0; i < " + std::to_string(kCaseOutputs) +
           "; ++i) out_[i] = 0.0f;\n" + c.body + "\nfor (int i = 0; i < " +
           std::to_string(kCaseOutputs) + "; ++i) b_out[gl_GlobalInvocationID.x * " +
           std::to_string(kCaseOutputs) + " + i] = out_[i];\n}\n";
}

class SharedTerms : public gl::GlTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(SharedTerms, AgreeOnCpuAndGpu) {
    const SharedTermCase& c = sharedTermCases()[GetParam()];
    const unsigned seed = 20'240'901u + static_cast<unsigned>(GetParam());
    SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
    InputMaker make(seed);
    std::vector<float> inputs(std::size_t{kCount} * kCaseInputs);
    for (std::size_t i = 0; i < kCount; ++i)
        c.prepare(make, std::span(inputs).subspan(i * kCaseInputs, kCaseInputs));

    const gl::StageSource stage{gl::Stage::Compute, computeShader(c)};
    const auto program = gl::Program::create(context(), c.name, std::span(&stage, 1));
    ASSERT_TRUE(program.ok()) << program.error().text();
    const gl::Buffer in = gl::Buffer::of<float>(context(), "in", inputs);
    const gl::Buffer out(context(), "out", std::size_t{kCount} * kCaseOutputs * sizeof(float));
    in.bindStorage(0);
    out.bindStorage(1);
    program->use();
    glDispatchCompute(kGroups, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const auto bytes = out.read();
    std::vector<float> gpu(std::size_t{kCount} * kCaseOutputs);
    std::memcpy(gpu.data(), bytes.data(), bytes.size());

    float worst = 0.0f;
    std::size_t worstAt = 0;
    float worstCpu = 0.0f, largest = 0.0f;
    for (std::size_t i = 0; i < kCount; ++i) {
        float cpu[kCaseOutputs] = {};
        c.run(inputs.data() + i * kCaseInputs, cpu);
        for (std::size_t k = 0; k < kCaseOutputs; ++k) {
            const float g = gpu[i * kCaseOutputs + k];
            largest = std::max(largest, std::abs(cpu[k]));
            const float error = std::abs(g - cpu[k]) / std::max(std::abs(cpu[k]), c.scale);
            if (!(error <= worst)) { // NaN, too
                worst = error;
                worstAt = i * kCaseOutputs + k;
                worstCpu = cpu[k];
            }
        }
    }
    EXPECT_LE(worst, kTolerance) << "input " << worstAt / kCaseOutputs << ", output "
                                 << worstAt % kCaseOutputs << ": CPU " << worstCpu << ", GPU "
                                 << gpu[worstAt];
    EXPECT_GT(largest, 0.0f) << "the case computes nothing";
    RecordProperty("worst", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(Each, SharedTerms,
                         testing::Range(std::size_t{0}, sharedTermCases().size()),
                         [](const auto& each) {
                             std::string name = sharedTermCases()[each.param].name;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](unsigned char ch) { return std::isalnum(ch) == 0; }, '_');
                             return name;
                         });

TEST(SharedTermCases, CoverEveryFunction) {
    std::string bodies;
    for (const SharedTermCase& c : sharedTermCases())
        bodies += c.body + " makeSurface( defaultBrdfModel(";
    const std::regex function(R"(PT_FN\s+\w+\s+(\w+)\()");
    int found = 0;
    for (const EmbeddedShader& shader : embeddedShaders()) {
        const std::string text(shader.text);
        for (std::sregex_iterator it(text.begin(), text.end(), function), end; it != end; ++it) {
            ++found;
            EXPECT_NE(bodies.find((*it)[1].str() + "("), std::string::npos)
                << shader.name << ": " << (*it)[1].str() << " is compared nowhere";
        }
    }
    EXPECT_GE(found, 40);
}

} // namespace
} // namespace patina::render
