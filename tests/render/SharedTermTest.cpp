// The GPU and the CPU run the same terms: so "the preview matches the reference" is this test.
#include "core/edit/ParameterChoices.h"
#include "render/gl/Buffer.h"
#include "render/gl/Program.h"
#include "render/shader/ShaderSources.h"
#include "tests/render/GlTest.h"
#include "tests/render/SharedTermCases.h"
#include "tests/render/SharedTermShader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <utility>

namespace patina::render {
namespace {

constexpr int kGroups = 800;
constexpr int kCount = kCaseGroup * kGroups; // 51,200 sets of inputs
constexpr float kTolerance = 1e-3f;          // relative

class SharedTerms : public gl::GlTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(SharedTerms, AgreeOnCpuAndGpu) {
    const SharedTermCase& c = sharedTermCases()[GetParam()];
    const unsigned seed = 20'240'901u + static_cast<unsigned>(GetParam());
    SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
    InputMaker make(seed);
    std::vector<float> inputs(std::size_t{kCount} * kCaseInputs);
    for (std::size_t i = 0; i < kCount; ++i)
        c.prepare(make, std::span(inputs).subspan(i * kCaseInputs, kCaseInputs));

    const gl::StageSource stage{gl::Stage::Compute, sharedTermShader(c.body)};
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

// Shaders know a choice by its number: kToneMapAgX is what ToneMap::AgX is.
TEST(SharedTermCases, NumbersOfChoicesAreThoseOfTheTable) {
    using Names = std::span<const std::string_view>;
    const std::vector<std::pair<std::string, Names>> choices{
        {"kToneMap", kToneMaps.names()},
        {"kDisplay", kDisplayTransfers.names()},
        {"kDistribution", kDistributions.names()},
        {"kVisibility", kVisibilities.names()},
        {"kFresnel", kFresnels.names()},
        {"kDiffuse", kDiffuses.names()},
        {"kLobeDirection", kLobeDirections.names()}};
    std::string text;
    for (const EmbeddedShader& shader : embeddedShaders())
        text += shader.text;
    for (const auto& [prefix, names] : choices) {
        const std::regex constant("PT_CONST int " + prefix + R"(([A-Z]\w*) = (\d+);)");
        std::map<std::size_t, std::string> found;
        for (std::sregex_iterator it(text.begin(), text.end(), constant), end; it != end; ++it)
            EXPECT_TRUE(found.emplace(std::stoul((*it)[2].str()), (*it)[1].str()).second)
                << it->str() << " has the number of " << prefix;
        for (std::size_t i = 0; i < names.size(); ++i)
            EXPECT_STRCASEEQ(found[i].c_str(), std::string(names[i]).c_str())
                << prefix << "… = " << i << " in shaders/shared";
        EXPECT_EQ(found.size(), names.size()) << prefix;
    }
}

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
