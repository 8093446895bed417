// Image-based light as the shaders find it: the DFG table and the prefiltered environment,
// uploaded as they are for the viewport, looked up by the viewport's own functions, read back and
// compared with exact values.
#include "core/light/Prefilter.h"
#include "core/math/Shading.h"
#include "render/gl/Buffer.h"
#include "render/gl/Program.h"
#include "render/scene/DfgTextures.h"
#include "render/scene/EnvironmentLight.h"
#include "render/shader/ShaderSources.h"
#include "tests/core/light/DfgReference.h"
#include "tests/core/light/EnvironmentSum.h"
#include "tests/core/light/IrradianceSum.h"
#include "tests/core/light/PrefilterReference.h"
#include "tests/render/GlTest.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>

namespace patina::render {
namespace {

using namespace reference;

constexpr unsigned kPrefilteredUnit = 7, kDfgUnit = 8;
constexpr std::size_t kGroup = 64;

class IblLookup : public gl::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        m_light = std::make_unique<EnvironmentLight>(context());
        m_tables = std::make_unique<DfgTextures>(context());
        setModel(ShadingModel{});
    }
    void TearDown() override {
        m_light.reset();
        m_tables.reset();
        GlTest::TearDown();
    }
    EnvironmentLight& light() { return *m_light; }
    void setModel(const ShadingModel& model) { m_dfg = &m_tables->of(model); }

    // `expression`, a vec3 of `in`, for each of `inputs`, evaluated on the GPU.
    std::vector<glm::vec3> evaluate(const std::string& expression, std::vector<glm::vec4> inputs) {
        std::string text = "#version 450 core\n"
                           "layout(local_size_x = 64) in;\n"
                           "layout(std430, binding = 0) readonly buffer In { vec4 b_in[]; };\n"
                           "layout(std430, binding = 1) writeonly buffer Out { vec4 b_out[]; };\n";
        for (const char* file : {"include/frame.glsl", "shared/ibl.glsl",
                                 "include/prefiltered.glsl", "include/dfg.glsl"}) {
            ExpandedShader expanded;
            EXPECT_TRUE(expandShader(ShaderSources(), file, {}, expanded).ok()) << file;
            text += expanded.text;
        }
        text += "void main() {\n"
                "vec4 at = b_in[gl_GlobalInvocationID.x];\n"
                "b_out[gl_GlobalInvocationID.x] = vec4(" +
                expression + ", 1.0);\n}\n";
        const gl::StageSource stage{gl::Stage::Compute, text};
        const auto program = gl::Program::create(context(), "lookup", std::span(&stage, 1));
        EXPECT_TRUE(program.ok()) << program.error().text();

        const std::size_t count = inputs.size(), groups = (count + kGroup - 1) / kGroup;
        inputs.resize(groups * kGroup, glm::vec4(0.5f));
        const gl::Buffer in = gl::Buffer::of<glm::vec4>(context(), "in", inputs);
        const gl::Buffer out(context(), "out", inputs.size() * sizeof(glm::vec4));
        gl::Buffer frame(context(), "frame", sizeof(FrameBlock));
        FrameBlock block;
        m_light->fill(block);
        frame.writeValue(block);
        in.bindStorage(0);
        out.bindStorage(1);
        frame.bindUniform(kFrameBinding);
        m_light->prefiltered().bind(kPrefilteredUnit);
        m_dfg->bind(kDfgUnit);
        program->use();
        glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        const auto bytes = out.read();
        std::vector<glm::vec3> results;
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec4 value;
            std::memcpy(&value, bytes.data() + i * sizeof(value), sizeof(value));
            results.emplace_back(value);
        }
        return results;
    }

    // Level i of `levels` for whole slots i of the atlas, looked up in the middle of texels.
    struct Texel {
        int slot;
        std::size_t index;
    };
    std::vector<glm::vec3> readTexels(const std::vector<CubeLevel>& levels,
                                      const std::vector<Texel>& texels) {
        IblMaps maps;
        maps.prefiltered = levels;
        m_light->setIbl(maps);
        std::vector<glm::vec4> inputs;
        for (const Texel& texel : texels)
            inputs.emplace_back(
                texelDirection(levels[static_cast<std::size_t>(texel.slot)].size, texel.index),
                levelRoughness(maps.spacing, texel.slot, static_cast<int>(levels.size()),
                               levels.front().size));
        return evaluate("prefilteredRadiance(at.xyz, at.w)", inputs);
    }

  private:
    std::unique_ptr<EnvironmentLight> m_light;
    std::unique_ptr<DfgTextures> m_tables;
    const gl::Texture* m_dfg = nullptr;
};

TEST_F(IblLookup, DfgTableHoldsTheExactIntegrals) {
    // The viewport has no table for Schlick's k of lights: iblVisibility().
    for (const Table& table : kTables) {
        if (table.visibility == Visibility::SchlickDirect)
            continue;
        ShadingModel model;
        model.visibility = table.visibility;
        setModel(model);
        std::vector<glm::vec4> inputs;
        for (const float r : kRoughness)
            for (const float NoV : kNoV)
                inputs.emplace_back(NoV, r, 0.0f, 0.0f);
        const std::vector<glm::vec3> seen = evaluate("dfgEntry(at.x, at.y)", inputs);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const Entry& exact = table.entries[i / kNoV.size()][i % kNoV.size()];
            const double E = exact.scale + exact.bias;
            const std::string where = std::to_string(static_cast<int>(table.visibility)) + ": r " +
                                      std::to_string(inputs[i].y) + ", N·V " +
                                      std::to_string(inputs[i].x);
            EXPECT_NEAR(seen[i].x, exact.scale, 6e-3) << where;
            EXPECT_NEAR(seen[i].y, exact.bias, 6e-3) << where;
            EXPECT_NEAR(
                seen[i].z,
                integrateDfg(inputs[i].x, inputs[i].y, Distribution::GGX, table.visibility).z, 6e-3)
                << where;
            // Turquin's factor from the texture makes a white metal white; r = 0.05, N·V = 0.05 is
            // where the texels are widest.
            if (inputs[i].y >= 0.1f && inputs[i].x >= 0.1f) {
                EXPECT_NEAR(E / (seen[i].x + seen[i].y), 1.0, 2e-3) << where;
            }
        }
    }
}

TEST_F(IblLookup, DfgTableReachesItsLimits) {
    setModel(ShadingModel{});
    std::vector<glm::vec4> inputs{{1.0f, 1.0f, 0.0f, 0.0f}};
    for (const float NoV : kNoV)
        inputs.emplace_back(NoV, 0.0f, 0.0f, 0.0f);
    const std::vector<glm::vec3> seen = evaluate("dfgEntry(at.x, at.y)", inputs);
    EXPECT_NEAR(seen[0].x + seen[0].y, 1.0 - std::log(2.0), 5e-4);
    EXPECT_NEAR(seen[0].z, 0.0, 2e-3);
    constexpr double kMirror[7] = {0.7737809375, 0.59049, 0.2373046875, 0.03125,
                                   0.0009765625, 1e-05,   0.0};
    for (std::size_t i = 0; i < std::size(kMirror); ++i) { // of r = 0: (1 - N·V)^5
        EXPECT_NEAR(seen[i + 1].x, 1.0 - kMirror[i], 1e-3) << kNoV[i];
        EXPECT_NEAR(seen[i + 1].y, kMirror[i], 1e-3) << kNoV[i];
        EXPECT_NEAR(seen[i + 1].z, 1.0, 2e-3) << kNoV[i];
    }
}

// One slot of the atlas for each roughness, whatever the viewport keeps there. A half float has
// 11 bits: 4.9e-4 of any number.
constexpr double kHalf = 4.9e-4;

TEST_F(IblLookup, PrefilteredBandsHaveTheirFactors) {
    const CubePyramid odd(cubeOf(
        128, [](glm::vec3 d) { return glm::vec3(1.0, 2.0 + band(d, 1), 2.0 + band(d, 3)); }));
    const CubePyramid even(cubeOf(
        128, [](glm::vec3 d) { return glm::vec3(1.0, 2.0 + band(d, 2), 2.0 + band(d, 4)); }));
    for (const int parity : {0, 1}) {
        const CubePyramid& pyramid = parity == 0 ? odd : even;
        std::vector<CubeLevel> levels{{16, std::vector<glm::vec3>(6u * 16 * 16, glm::vec3(7.0f))}};
        std::vector<Texel> texels;
        for (std::size_t r = 0; r < std::size(kBandFactors); ++r) {
            const float roughness = kBandFactors[r].perceptualRoughness;
            levels.push_back(prefilterGGX(pyramid, 16, roughness * roughness, {}, {}));
            for (std::size_t i = r; i < 6u * 16 * 16; i += 7)
                texels.push_back({static_cast<int>(r) + 1, i});
        }
        const std::vector<glm::vec3> seen = readTexels(levels, texels);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double* lambda =
                kBandFactors[static_cast<std::size_t>(texels[i].slot) - 1].lambda;
            const glm::vec3 n = texelDirection(16, texels[i].index);
            ASSERT_NEAR(seen[i].x, 1.0, kHalf);
            for (int k = 0; k < 2; ++k) {
                const int l = 1 + parity + 2 * k;
                ASSERT_NEAR(seen[i][k + 1], 2.0 + lambda[l - 1] * band(n, l), 2e-3)
                    << "l " << l << ", slot " << texels[i].slot;
            }
        }
    }
}

TEST_F(IblLookup, APrefilteredLightHasItsKernel) {
    constexpr int kSize = 256;
    CubeLevel base = cubeOf(kSize, [](glm::vec3) { return glm::vec3(0.0f); });
    const std::size_t lamp = kSize / 2 * kSize + kSize / 2;
    const double flux = 10.0; // keeps all values in the range of normal half floats
    base.texels[lamp] = glm::vec3(static_cast<float>(flux / cubeSolidAngles(kSize)[lamp]));
    const CubePyramid pyramid(base);
    constexpr int kSide = 128; // 128 128 128 128 64 64
    std::vector<CubeLevel> levels{
        {kSide, std::vector<glm::vec3>(6u * kSide * kSide, glm::vec3(7.0f))}};
    std::vector<Texel> texels;
    std::vector<double> exact;
    for (int r = 0; r < 5; ++r) {
        const int size = levelSide(LevelSpacing::Lobes, r + 1, kSide);
        levels.push_back(
            prefilterGGX(pyramid, size, kFilterRoughness[r] * kFilterRoughness[r], {}, {}));
        for (int k = 0; k < 8; ++k) {
            const KernelSample at = kernelSample(size, texelDirection(kSize, lamp), r, k);
            texels.push_back({r + 1, at.texel});
            exact.push_back(flux * at.exact);
        }
    }
    const std::vector<glm::vec3> seen = readTexels(levels, texels);
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_NEAR(seen[i].x / exact[i], 1.0, 1e-4 + kHalf)
            << "roughness " << kFilterRoughness[i / 8] << " at " << kKernelAngleDeg[i % 8];
}

TEST_F(IblLookup, PrefilteredDiscsLookedAtDirectly) {
    for (const Disc& disc : kDiscs) {
        CubeLevel base = discCube(disc.halfAngleDeg);
        const float radiance = 1e4f; // keeps all values in the range of normal half floats
        for (glm::vec3& texel : base.texels)
            texel *= radiance;
        const CubePyramid pyramid(base);
        std::vector<CubeLevel> levels{{16, std::vector<glm::vec3>(6u * 16 * 16, glm::vec3(7.0f))}};
        std::vector<Texel> texels;
        for (int r = 0; r < 5; ++r) {
            levels.push_back(
                prefilterGGX(pyramid, 16, kFilterRoughness[r] * kFilterRoughness[r], {}, {}));
            texels.push_back({r + 1, kDiscTexel});
        }
        const std::vector<glm::vec3> seen = readTexels(levels, texels);
        for (std::size_t r = 0; r < 5; ++r)
            EXPECT_NEAR(seen[r].x / (radiance * disc.fraction[r]), 1.0, 1e-3 + kHalf)
                << disc.halfAngleDeg << " degrees, " << kFilterRoughness[r];
    }
}

// Between levels, as PrefilteredLevelsTest.cpp has it for the CPU.
TEST_F(IblLookup, PrefilteredLevelsAreCloseToTheExactSumAtFortyRoughnesses) {
    const std::vector<float> roughness = fortyRoughnesses();
    for (const NamedEnvironment& environment : lookupEnvironments()) {
        const auto maps = computeIbl(*environment.image, {}, {});
        ASSERT_TRUE(maps.ok());
        const EnvironmentSum truth(maps->prefiltered.front());
        // Half floats end at 65504, below a sun: in the narrowest levels, of which only the rms
        // over the sphere is bounded.
        const std::vector<glm::vec3> directions = lookupDirections(truth, lookupCount(16));
        const auto exact = exactSums(truth, directions, roughness);
        light().setIbl(*maps);
        std::vector<glm::vec4> inputs;
        for (const float r : roughness)
            for (const glm::vec3& d : directions)
                inputs.emplace_back(d, r);
        const std::vector<glm::vec3> all = evaluate("prefilteredRadiance(at.xyz, at.w)", inputs);
        std::string table;
        for (std::size_t r = 0; r < roughness.size(); ++r) {
            const LookupError error = lookupError(
                std::span(all).subspan(r * directions.size(), directions.size()), exact[r]);
            const bool narrow = roughness[r] < 0.1f - 1e-6f;
            EXPECT_LE(error.rms, narrow ? 0.04 : 0.015) << environment.name << " " << roughness[r];
            if (!narrow) {
                EXPECT_LE(error.most, 0.1) << environment.name << " " << roughness[r];
            }
            table += fmt::format(" {:.3f}:{:.2f}/{:.1f}", roughness[r], 100.0 * error.rms,
                                 100.0 * error.most);
        }
        RecordProperty(environment.name, table); // roughness:rms/most, in percent
        if (std::getenv("PATINA_PREFILTER_HDR"))
            fmt::print("{}{}\n", environment.name, table);
    }
}

// What diffuse surfaces are lit with, and what the nine coefficients of the lighting "SH
// irradiance" err by.
TEST_F(IblLookup, IrradianceIsThatOfThePicture) {
    const std::vector<glm::vec3> normals = irradianceNormals(400);
    const std::vector<glm::vec4> inputs = [&] {
        std::vector<glm::vec4> all;
        for (const glm::vec3& n : normals)
            all.emplace_back(n, 0.0f);
        return all;
    }();
    double worstOfNine = 0.0;
    for (const NamedEnvironment& environment : irradianceEnvironments()) {
        const auto maps = computeIbl(*environment.image, {}, {});
        ASSERT_TRUE(maps.ok());
        const std::vector<glm::vec3> exact = irradianceSums(*environment.image, normals);
        light().setIbl(*maps);
        const LookupError error =
            irradianceErrors(evaluate("environmentIrradiance(at.xyz)", inputs), exact);
        EXPECT_LE(error.rms, 0.003) << environment.name;
        EXPECT_LE(error.most, 0.01) << environment.name;
        std::vector<glm::vec3> nine;
        for (const glm::vec3& n : normals)
            nine.push_back(shading::irradianceFromSh9(maps->irradianceSh.data(), n));
        const LookupError ofNine = irradianceErrors(nine, exact);
        worstOfNine = std::max(worstOfNine, ofNine.rms);
        const std::string figures = fmt::format(
            "rms {:.3f} %, most {:.2f} %; nine coefficients {:.1f} %, {:.0f} %", 100.0 * error.rms,
            100.0 * error.most, 100.0 * ofNine.rms, 100.0 * ofNine.most);
        RecordProperty(environment.name, figures);
        if (std::getenv("PATINA_PREFILTER_HDR"))
            fmt::print("{}: {}\n", environment.name, figures);
    }
    if (!std::getenv("PATINA_PREFILTER_HDR")) {
        EXPECT_GT(worstOfNine, 0.02) << "no environment that tells the two apart";
    }
}

} // namespace
} // namespace patina::render
