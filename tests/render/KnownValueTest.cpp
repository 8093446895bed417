// The shared terms give the values of papers and closed forms, on the CPU and read back from the
// GPU, within the same tolerance.
#include "render/gl/Buffer.h"
#include "render/gl/Program.h"
#include "tests/render/GlTest.h"
#include "tests/render/KnownValueCases.h"
#include "tests/render/SharedTermCases.h"
#include "tests/render/SharedTermShader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>

namespace patina::render {
namespace {

class KnownValues : public gl::GlTest, public testing::WithParamInterface<std::size_t> {
  protected:
    static void expectValues(const KnownValueCase& c, const KnownValue& value, const float* out,
                             const char* where) {
        for (std::size_t k = 0; k < value.expected.size(); ++k) {
            const double expected = value.expected[k];
            const double tolerance =
                c.kind == Tolerance::Relative ? c.tolerance * std::abs(expected) : c.tolerance;
            EXPECT_NEAR(out[k], expected, tolerance)
                << where << ", output " << k << " of " << testing::PrintToString(value.inputs);
        }
    }
};

TEST_P(KnownValues, HoldOnCpuAndGpu) {
    const KnownValueCase& c = knownValueCases()[GetParam()];
    ASSERT_FALSE(c.values.empty());
    const std::size_t groups = (c.values.size() + kCaseGroup - 1) / kCaseGroup;
    std::vector<float> inputs(groups * kCaseGroup * kCaseInputs, 0.5f);
    for (std::size_t i = 0; i < c.values.size(); ++i) {
        ASSERT_LE(c.values[i].inputs.size(), std::size_t{kCaseInputs});
        ASSERT_LE(c.values[i].expected.size(), std::size_t{kCaseOutputs});
        std::copy(c.values[i].inputs.begin(), c.values[i].inputs.end(),
                  inputs.begin() + static_cast<std::ptrdiff_t>(i * kCaseInputs));
    }

    for (std::size_t i = 0; i < c.values.size(); ++i) {
        float out[kCaseOutputs] = {};
        c.run(inputs.data() + i * kCaseInputs, out);
        expectValues(c, c.values[i], out, "CPU");
    }

    const gl::StageSource stage{gl::Stage::Compute, sharedTermShader(c.body)};
    const auto program = gl::Program::create(context(), c.name, std::span(&stage, 1));
    ASSERT_TRUE(program.ok()) << program.error().text();
    const gl::Buffer in = gl::Buffer::of<float>(context(), "in", inputs);
    std::vector<float> gpu(groups * kCaseGroup * kCaseOutputs);
    const gl::Buffer out(context(), "out", gpu.size() * sizeof(float));
    in.bindStorage(0);
    out.bindStorage(1);
    program->use();
    glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const auto bytes = out.read();
    ASSERT_EQ(bytes.size(), gpu.size() * sizeof(float));
    std::memcpy(gpu.data(), bytes.data(), bytes.size());
    for (std::size_t i = 0; i < c.values.size(); ++i)
        expectValues(c, c.values[i], gpu.data() + i * kCaseOutputs, "GPU");
}

INSTANTIATE_TEST_SUITE_P(Each, KnownValues,
                         testing::Range(std::size_t{0}, knownValueCases().size()),
                         [](const auto& each) {
                             std::string name = knownValueCases()[each.param].name;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](unsigned char ch) { return std::isalnum(ch) == 0; }, '_');
                             return name;
                         });

} // namespace
} // namespace patina::render
