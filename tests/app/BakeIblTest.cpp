// `patina bake ibl` from the outside, with radiance known in closed form: L(d) = 2 + d. GGX
// prefiltering multiplies the linear part by lambda_1(alpha), irradiance is 2 pi + 2 pi / 3 n.
#include "CommandRunner.h"
#include "core/io/ImageIO.h"
#include "core/scene/DocumentIO.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/KnownRadiance.h"
#include "tests/support/TextureFiles.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>
#include <sstream>

using namespace patina;
using namespace patina::test;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 along(const glm::dvec3& d) {
    return d;
}

class BakeIbl : public testing::Test {
  protected:
    BakeIbl() { writeLatLong(m_folder / "linear.exr", linearRadiance); }

    void writeLatLong(const std::string& file,
                      const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
        EXPECT_TRUE(saveImage(m_worker, latLongImage(radiance), file).ok());
    }

    Outcome bake(const std::string& input, const std::string& folder,
                 std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"bake",   "ibl",    input, "-o", m_folder / folder,
                                              "--json", "--size", "64"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    }

    Bytes bytesOf(const std::string& name) {
        Result<Bytes> data = readFile(m_folder / name, std::size_t{1} << 30);
        EXPECT_TRUE(data.ok()) << name;
        return data.ok() ? std::move(*data) : Bytes();
    }
    Image image(const std::string& name) {
        Result<LoadedImage> loaded = loadImage(m_worker, m_folder / name);
        EXPECT_TRUE(loaded.ok()) << name;
        return loaded.ok() ? loaded->image() : Image();
    }
    nlohmann::json jsonFile(const std::string& name) {
        return nlohmann::json::parse(readBytes(m_folder / name));
    }

    // Every texel of the cube is constant + slope · turn(d).
    static void expectLinear(const std::vector<glm::dvec3>& texels, int size, double constant,
                             double slope, double tolerance,
                             const std::function<glm::dvec3(const glm::dvec3&)>& turn = along) {
        ASSERT_EQ(texels.size(), static_cast<std::size_t>(6 * size * size));
        double worst = 0;
        std::size_t i = 0;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x, ++i) {
                    const glm::dvec3 expected =
                        constant + slope * turn(faceDirection(face, x, y, size));
                    for (int c = 0; c < 3; ++c)
                        worst = std::max(worst, std::abs(texels[i][c] - expected[c]));
                }
        EXPECT_LT(worst, tolerance) << size;
    }
    static void expectPrefiltered(const TextureFile& texture, double step) {
        EXPECT_EQ(texture.faces, 6);
        EXPECT_EQ(texture.width, 64);
        EXPECT_EQ(texture.height, 64);
        ASSERT_EQ(texture.levels.size(), kLambda1.size());
        for (std::size_t i = 0; i < kLambda1.size(); ++i)
            expectLinear(texture.levels[i], 64 >> i, 2, kLambda1[i], 0.005 + step);
    }

    // Six image files as one list of texels.
    std::vector<glm::dvec3> faces(const std::string& stem, const std::string& extension) {
        std::vector<glm::dvec3> texels;
        for (const char* name : {"-px", "-nx", "-py", "-ny", "-pz", "-nz"}) {
            const Image face = image(stem + name + extension);
            EXPECT_EQ(face.width(), face.height());
            for (std::size_t i = 0; i < face.f32().size(); i += 3)
                texels.emplace_back(face.f32()[i], face.f32()[i + 1], face.f32()[i + 2]);
        }
        return texels;
    }

    // The folder holds what the manifest lists and nothing else.
    void expectComplete(const std::string& folder) {
        std::vector<std::string> found, listed;
        for (const auto& entry : fs::directory_iterator(m_folder / folder))
            found.push_back(entry.path().filename().string());
        const nlohmann::json manifest = jsonFile(folder + "/manifest.json");
        for (const nlohmann::json& name : manifest["files"])
            listed.push_back(name);
        std::sort(found.begin(), found.end());
        std::sort(listed.begin(), listed.end());
        EXPECT_EQ(found, listed);
    }

    TemporaryFolder m_folder;
    WorkerClient m_worker;
};

} // namespace

TEST_F(BakeIbl, Ktx2HoldsTheFilteredCube) {
    const Outcome outcome = bake(m_folder / "linear.exr", "out", {"--format", "ktx2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const TextureFile texture = readKtx2(bytesOf("out/prefiltered.ktx2"));
    EXPECT_EQ(texture.texelBytes, 8u);
    expectPrefiltered(texture, 0.0015); // half a step of a half float at 3
    const TextureFile irradiance = readKtx2(bytesOf("out/irradiance.ktx2"));
    expectLinear(irradiance.levels.at(0), irradiance.width, 2 * kPi, 2 * kPi / 3, 0.01);
    expectComplete("out");
}

TEST_F(BakeIbl, DdsHoldsTheFilteredCube) {
    ASSERT_EQ(bake(m_folder / "linear.exr", "out", {"--format", "dds"}).status, 0);
    expectPrefiltered(readDds(bytesOf("out/prefiltered.dds")), 0.0015);
    const TextureFile irradiance = readDds(bytesOf("out/irradiance.dds"));
    expectLinear(irradiance.levels.at(0), irradiance.width, 2 * kPi, 2 * kPi / 3, 0.01);
    expectComplete("out");
}

TEST_F(BakeIbl, PrecisionChoosesTheTexels) {
    ASSERT_EQ(
        bake(m_folder / "linear.exr", "f", {"--format", "ktx2", "--precision", "float"}).status, 0);
    const TextureFile floats = readKtx2(bytesOf("f/prefiltered.ktx2"));
    EXPECT_EQ(floats.texelBytes, 16u);
    expectPrefiltered(floats, 0);
    EXPECT_EQ(readKtx2(bytesOf("f/dfg.ktx2")).texelBytes, 16u);
    ASSERT_EQ(
        bake(m_folder / "linear.exr", "e", {"--format", "dds", "--precision", "rgb9e5"}).status, 0);
    const TextureFile shared = readDds(bytesOf("e/prefiltered.dds"));
    EXPECT_EQ(shared.texelBytes, 4u);
    expectPrefiltered(shared, 0.004); // half a step at 3: 2^-8
    EXPECT_EQ(readDds(bytesOf("e/dfg.dds")).texelBytes, 8u);
}

TEST_F(BakeIbl, FacesAreAnImageEach) {
    for (const auto& [format, step] : {std::pair{"exr", 0.001}, {"hdr", 0.016}}) {
        const std::string extension = std::string(".") + format;
        ASSERT_EQ(bake(m_folder / "linear.exr", format, {"--format", format}).status, 0);
        for (std::size_t i = 0; i < kLambda1.size(); ++i)
            expectLinear(
                faces(std::string(format) + "/prefiltered-" + std::to_string(i), extension),
                64 >> i, 2, kLambda1[i], 0.005 + step);
        expectLinear(faces(std::string(format) + "/irradiance", extension),
                     image(std::string(format) + "/irradiance-px" + extension).width(), 2 * kPi,
                     2 * kPi / 3, 0.005 + 4 * step);
        expectComplete(format);
    }
}

TEST_F(BakeIbl, LatLongIsAnImagePerLevel) {
    ASSERT_EQ(bake(m_folder / "linear.exr", "out", {"--layout", "latlong"}).status, 0);
    for (std::size_t i = 0; i < kLambda1.size(); ++i) {
        const Image level = image("out/prefiltered-" + std::to_string(i) + ".exr");
        const int width = 256 >> i, height = 128 >> i;
        ASSERT_EQ(level.width(), width);
        ASSERT_EQ(level.height(), height);
        double worst = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::dvec3 d = latLongDirection(x, y, width, height);
                for (int c = 0; c < 3; ++c)
                    worst =
                        std::max(worst, std::abs(level.sample(x, y, c) - 2 - kLambda1[i] * d[c]));
            }
        // Interpolating chords of the sphere: coarse at 4 texels a face.
        EXPECT_LT(worst, i < 3 ? 0.01 : i == 3 ? 0.02 : 0.07) << i;
    }
    expectComplete("out");
}

TEST_F(BakeIbl, TheDfgTableHasItsTexelsWhereOthersLookThemUp) {
    ASSERT_EQ(bake("builtin:white", "out", {"--precision", "float"}).status, 0);
    const Image table = image("out/dfg.exr");
    ASSERT_EQ(table.width(), 128);
    ASSERT_EQ(table.height(), 128);
    // Smith height-correlated, interpolated at r = 0.5, N·V = 0.5 and r = 1, N·V = 0.25
    const auto at = [&](double NoV, double r, int channel) {
        return sampleBilinear(table, static_cast<float>(NoV), static_cast<float>(r))[channel];
    };
    EXPECT_NEAR(at(0.5, 0.5, 0), 0.834916, 1e-3);
    EXPECT_NEAR(at(0.5, 0.5, 1), 0.022347, 1e-3);
    EXPECT_NEAR(at(0.25, 0.75, 0), 0.716508, 1e-3);
    EXPECT_NEAR(at(0.25, 0.75, 1), 0.027948, 1e-3);
}

TEST_F(BakeIbl, TheDfgTableIsOfTheModelAskedFor) {
    ASSERT_EQ(bake("builtin:white", "out",
                   {"--precision", "float", "--set", "model.visibility=schlickIbl"})
                  .status,
              0);
    // Schlick-GGX with k = alpha / 2 loses more light (Karis 2013).
    const glm::vec4 albedo = sampleBilinear(image("out/dfg.exr"), 0.5f, 0.5f);
    EXPECT_NEAR(albedo.x, 0.728534, 1e-3);
    EXPECT_NEAR(albedo.y, 0.018546, 1e-3);
    EXPECT_EQ(jsonFile("out/manifest.json")["dfg"]["visibility"], "schlickIbl");
    EXPECT_EQ(jsonFile("out/manifest.json")["dfg"]["distribution"], "ggx");
}

TEST_F(BakeIbl, HarmonicsHaveTheSignsAndTheOrderTheyState) {
    ASSERT_EQ(bake(m_folder / "linear.exr", "out").status, 0);
    nlohmann::json radiance = jsonFile("out/radiance-sh.json");
    nlohmann::json irradiance = jsonFile("out/irradiance-sh.json");
    ASSERT_EQ(radiance["coefficients"].size(), 25u);
    ASSERT_EQ(irradiance["coefficients"].size(), 9u);
    // ∫ (2 + x_k) Y_i: 2 sqrt(4 pi); ±sqrt(4 pi / 3), negative for y and x (Condon-Shortley).
    const double constant = 2 * std::sqrt(4 * kPi), linear = std::sqrt(4 * kPi / 3);
    const auto expected = [&](std::size_t i, int channel) {
        if (i == 0)
            return constant;
        if ((i == 3 && channel == 0) || (i == 1 && channel == 1))
            return -linear;
        return i == 2 && channel == 2 ? linear : 0.0;
    };
    std::istringstream text(readBytes(m_folder / "out/radiance-sh.txt"));
    std::string line;
    std::size_t row = 0;
    for (std::size_t i = 0; i < 25; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(radiance["coefficients"][i][c], expected(i, c), 1e-3) << i;
    for (std::size_t i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(irradiance["coefficients"][i][c],
                        expected(i, c) * (i == 0 ? kPi : 2 * kPi / 3), 2e-3)
                << i;
    while (std::getline(text, line)) {
        if (line.starts_with('#'))
            continue;
        int l = 0, m = 0;
        glm::dvec3 c(0.0);
        ASSERT_TRUE(std::istringstream(line) >> l >> m >> c.x >> c.y >> c.z) << line;
        EXPECT_EQ(static_cast<std::size_t>(l * (l + 1) + m), row);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(c[k], radiance["coefficients"][row][k].get<double>(), 1e-6);
        ++row;
    }
    EXPECT_EQ(row, 25u);
    // What the sums give along the axes.
    EXPECT_NEAR(radiance["axes"]["+X"][0], 3, 2e-3);
    EXPECT_NEAR(radiance["axes"]["-X"][0], 1, 2e-3);
    EXPECT_NEAR(radiance["axes"]["+Y"][1], 3, 2e-3);
    EXPECT_NEAR(irradiance["axes"]["-Z"][2], 2 * kPi - 2 * kPi / 3, 5e-3);
    EXPECT_NEAR(irradiance["axes"]["+Z"][0], 2 * kPi, 5e-3);
}

TEST_F(BakeIbl, AWhiteSkyIsWhiteEverywhere) {
    const Outcome outcome = bake("builtin:white", "out", {"--format", "ktx2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json coefficients = jsonFile("out/irradiance-sh.json")["coefficients"];
    EXPECT_NEAR(coefficients[0][1], 11.1367, 1e-4); // pi * 2 sqrt(pi)
    for (std::size_t i = 1; i < 9; ++i)
        EXPECT_NEAR(coefficients[i][1], 0, 1e-6);
    EXPECT_EQ(outcome.json()["irradianceSh"].size(), 9u);
    EXPECT_NEAR(outcome.json()["irradianceSh"][0][2], 11.1367, 1e-4);
    const TextureFile prefiltered = readKtx2(bytesOf("out/prefiltered.ktx2"));
    const TextureFile irradiance = readKtx2(bytesOf("out/irradiance.ktx2"));
    for (const std::vector<glm::dvec3>& level : prefiltered.levels)
        for (const glm::dvec3& texel : level)
            ASSERT_EQ(texel, glm::dvec3(1.0));
    for (const glm::dvec3& texel : irradiance.levels.at(0))
        ASSERT_NEAR(texel.x, kPi, 0.001); // half a step of a half float
}

// A quarter turn about +Y, counter-clockwise from above, brings +X to -Z: what is seen along d was
// along (-z, y, x). Two stops are four times the light.
TEST_F(BakeIbl, TurnsAndExposesWithSet) {
    const Outcome outcome = bake(m_folder / "linear.exr", "out",
                                 {"--format", "ktx2", "--set", "environment.rotationDeg=90",
                                  "--set", "environment.exposureEv=2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expectLinear(readKtx2(bytesOf("out/prefiltered.ktx2")).levels.at(0), 64, 8, 4, 0.02,
                 [](const glm::dvec3& d) { return glm::dvec3(-d.z, d.y, d.x); });
    nlohmann::json manifest = jsonFile("out/manifest.json");
    EXPECT_EQ(manifest["environment"]["rotationDeg"], 90.0);
    EXPECT_EQ(manifest["environment"]["exposureEv"], 2.0);
    EXPECT_EQ(outcome.json()["settings"]["set"]["environment.rotationDeg"], "90");
}

// The six faces side by side, as the files of faces have them.
TEST_F(BakeIbl, ReadsEveryLayout) {
    constexpr int kSize = 64;
    Image strip(6 * kSize, kSize, 3, PixelType::F32, ColorEncoding::Linear);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 value = 2.0 + faceDirection(face, x, y, kSize);
                for (int c = 0; c < 3; ++c)
                    strip.f32()[static_cast<std::size_t>((y * 6 + face) * kSize + x) * 3 +
                                static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
            }
    ASSERT_TRUE(saveImage(m_worker, strip, m_folder / "strip.exr").ok());
    ASSERT_EQ(bake(m_folder / "strip.exr", "guessed", {"--format", "dds"}).status, 0);
    expectLinear(readDds(bytesOf("guessed/prefiltered.dds")).levels.at(0), 64, 2, 1, 0.03);
    ASSERT_EQ(bake(m_folder / "strip.exr", "said",
                   {"--format", "dds", "--environment-layout", "horizontal-strip"})
                  .status,
              0);
    EXPECT_EQ(bytesOf("said/prefiltered.dds"), bytesOf("guessed/prefiltered.dds"));
    EXPECT_EQ(bake(m_folder / "strip.exr", "no", {"--environment-layout", "nonsense"}).status, 2);
    EXPECT_EQ(bake("some.patina", "no", {"--environment-layout", "lat-long"}).status, 2);
    EXPECT_FALSE(fs::exists(m_folder / "no"));
}

TEST_F(BakeIbl, CountsWhatIsTooBright) {
    writeLatLong(m_folder / "sun.exr",
                 [](const glm::dvec3& d) { return d.z > 0.9 ? glm::dvec3(1e5) : glm::dvec3(1.0); });
    const Outcome half = bake(m_folder / "sun.exr", "half", {"--format", "dds"});
    ASSERT_EQ(half.status, 0) << half.err;
    const TextureFile texture = readDds(bytesOf("half/prefiltered.dds"));
    double brightest = 0;
    std::size_t cut = 0;
    for (const std::vector<glm::dvec3>& level : texture.levels)
        for (const glm::dvec3& texel : level) {
            brightest = std::max(brightest, texel.x);
            cut += texel.x == 65504.0 ? 1 : 0;
        }
    EXPECT_EQ(brightest, 65504.0);
    const TextureFile irradiance = readDds(bytesOf("half/irradiance.dds"));
    for (const glm::dvec3& texel : irradiance.levels.at(0))
        cut += texel.x == 65504.0 ? 1 : 0;
    EXPECT_GT(cut, 100u);
    EXPECT_EQ(half.json()["counts"]["clampedTexels"], cut);
    EXPECT_THAT(half.json()["warnings"][0].get<std::string>(), HasSubstr("--precision float"));
    EXPECT_EQ(jsonFile("half/manifest.json")["clampedTexels"], cut);

    // The same in OpenEXR, never infinite.
    const Outcome exr = bake(m_folder / "sun.exr", "exr");
    EXPECT_GT(exr.json()["counts"]["clampedTexels"], 100);
    EXPECT_EQ(image("exr/prefiltered-0-pz.exr").sample(32, 32, 0), 65504.0f);
    const Outcome floats = bake(m_folder / "sun.exr", "float", {"--precision", "float"});
    EXPECT_EQ(floats.json()["counts"]["clampedTexels"], 0);
    EXPECT_NEAR(image("float/prefiltered-0-pz.exr").sample(32, 32, 0), 1e5f, 1000.0f);
}

TEST_F(BakeIbl, LevelsAndSizeAreThoseAskedFor) {
    const Outcome outcome =
        runPatina({"bake", "ibl", "builtin:white", "-o", m_folder / "out", "--size", "32",
                   "--levels", "6", "--format", "ktx2", "--json", "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const TextureFile texture = readKtx2(bytesOf("out/prefiltered.ktx2"));
    EXPECT_EQ(texture.width, 32);
    ASSERT_EQ(texture.levels.size(), 6u);
    EXPECT_EQ(texture.levels.back().size(), 6u);
    nlohmann::json levels = jsonFile("out/manifest.json")["prefiltered"]["levels"];
    EXPECT_EQ(levels[0]["perceptualRoughness"], 0.0);
    EXPECT_DOUBLE_EQ(levels[1]["perceptualRoughness"], 0.2);
    EXPECT_DOUBLE_EQ(levels[1]["alpha"], 0.04);
    EXPECT_EQ(levels[5]["perceptualRoughness"], 1.0);
    // The texture says it as well, wherever it goes without the manifest.
    const Bytes file = bytesOf("out/prefiltered.ktx2");
    const std::string entry("PatinaPerceptualRoughness\0"
                            "0 0.2 0.4 0.6 0.8 1",
                            45);
    EXPECT_NE(std::string(reinterpret_cast<const char*>(file.data()), file.size()).find(entry),
              std::string::npos);
}

TEST_F(BakeIbl, DoesNotDependOnTheThreadCount) {
    ASSERT_EQ(bake("builtin:sunset", "one", {"--format", "dds", "--threads", "1"}).status, 0);
    ASSERT_EQ(bake("builtin:sunset", "two", {"--format", "dds", "--threads", "2"}).status, 0);
    for (const char* file :
         {"/prefiltered.dds", "/irradiance.dds", "/dfg.dds", "/radiance-sh.json", "/manifest.json"})
        EXPECT_EQ(bytesOf(std::string("one") + file), bytesOf(std::string("two") + file)) << file;
}

TEST_F(BakeIbl, BakesTheEnvironmentOfAProject) {
    Document document = startDocument();
    document.environment().source = m_folder / "linear.exr";
    document.environment().rotationDeg = 90;
    document.environment().exposureEv = 1;
    ASSERT_TRUE(saveProject(m_worker, document, m_folder / "scene.patina").ok());
    const Outcome outcome = bake(m_folder / "scene.patina", "out", {"--format", "ktx2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expectLinear(readKtx2(bytesOf("out/prefiltered.ktx2")).levels.at(0), 64, 4, 2, 0.01,
                 [](const glm::dvec3& d) { return glm::dvec3(-d.z, d.y, d.x); });

    // Without its image the light would be another one.
    fs::remove(m_folder / "linear.exr");
    const Outcome missing = bake(m_folder / "scene.patina", "other");
    EXPECT_EQ(missing.status, 66) << missing.err;
    EXPECT_THAT(m_folder.files(), Not(Contains("other")));
}

// A sun overhead, given by --set alone: all light above, most of it from the zenith.
TEST_F(BakeIbl, BakesAGeneratedSky) {
    const Outcome outcome =
        bake("builtin:white", "out",
             {"--format", "ktx2", "--precision", "float", "--set", "environment.kind=sky", "--set",
              "environment.skySunElevationDeg=90", "--set", "environment.skyGroundAlbedo=0"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(jsonFile("out/manifest.json")["environment"]["source"], "sky");
    nlohmann::json axes = jsonFile("out/irradiance-sh.json")["axes"];
    EXPECT_GT(axes["+Y"][1].get<double>(), 2 * axes["+X"][1].get<double>());
    EXPECT_GT(axes["+X"][1].get<double>(), 1.5 * std::abs(axes["-Y"][1].get<double>()));
    const TextureFile texture = readKtx2(bytesOf("out/prefiltered.ktx2"));
    const std::vector<glm::dvec3>& level = texture.levels.at(0);
    const auto brightest =
        std::max_element(level.begin(), level.end(), [](auto& a, auto& b) { return a.x < b.x; });
    EXPECT_EQ((brightest - level.begin()) / (64 * 64), 2) << "the sun is in +Y";
}

TEST_F(BakeIbl, ReplacesAnEarlierBakeButNoOtherFolder) {
    ASSERT_EQ(bake("builtin:white", "out").status, 0);
    ASSERT_EQ(bake("builtin:white", "out", {"--format", "ktx2"}).status, 0);
    expectComplete("out");
    EXPECT_FALSE(fs::exists(m_folder / "out/dfg.exr")) << "nothing of the old one is left";

    writeBytes(m_folder / "out/notes.txt", "mine");
    const Outcome refused = bake("builtin:white", "out");
    EXPECT_EQ(refused.status, 73);
    EXPECT_THAT(refused.json()["error"]["message"].get<std::string>(), HasSubstr("other files"));
    EXPECT_EQ(readBytes(m_folder / "out/notes.txt"), "mine");
    EXPECT_TRUE(fs::exists(m_folder / "out/dfg.ktx2"));
}

TEST_F(BakeIbl, SaysWhatIsWrong) {
    writeBytes(m_folder / "text.hdr", "this is no picture");
    writeBytes(m_folder / "file", "x");
    struct Case {
        std::vector<std::string> arguments;
        int status;
        const char* message;
    };
    const std::string white = "builtin:white", out = m_folder / "out";
    const std::vector<Case> cases = {
        {{m_folder / "missing.hdr", "-o", out}, 66, "does not exist"},
        {{m_folder / "text.hdr", "-o", out}, 65, ""},
        {{"builtin:sphere", "-o", out}, 2, ""},
        {{white, "-o", m_folder / "file"}, 73, "file"},
        {{white, "-o", m_folder / "missing/out"}, 73, "does not exist"},
        {{white, "-o", "/proc/out"}, 73, ""},
        {{white, "-o", out, "--size", "100"}, 2, "--size"},
        {{white, "-o", out, "--size", "65536"}, 2, "--size"},
        {{white, "-o", out, "--size", "0"}, 2, "--size"},
        {{white, "-o", out, "--size", "16", "--levels", "6"}, 2, "--levels 5"},
        {{white, "-o", out, "--levels", "1"}, 2, "--levels"},
        {{white, "-o", out, "--format", "png"}, 2, "--format"},
        {{white, "-o", out, "--format", "ktx2", "--layout", "latlong"}, 2, "--layout"},
        {{white, "-o", out, "--format", "hdr", "--precision", "half"}, 2, "--precision"},
        {{white, "-o", out, "--precision", "rgb9e5"}, 2, "rgb9e5"},
        {{white, "-o", out, "--samples", "64"}, 2, "--samples"}, // nothing is sampled
        {{white, "-o", out, "--set", "material.metallic=1"}, 2, "changes nothing"},
        {{white, "-o", out, "--set", "environment.nonsense=1"}, 2, "nonsense"},
        {{white}, 2, "--output"},
    };
    for (const Case& test : cases) {
        std::vector<std::string> arguments = {"bake", "ibl", "--json"};
        arguments.insert(arguments.end(), test.arguments.begin(), test.arguments.end());
        const Outcome outcome = runPatina(arguments);
        const std::string name = testing::PrintToString(test.arguments);
        EXPECT_EQ(outcome.status, test.status) << name << outcome.err;
        EXPECT_THAT(outcome.json()["error"]["message"].get<std::string>(), HasSubstr(test.message))
            << name;
        EXPECT_FALSE(fs::exists(out)) << name;
    }
}

TEST_F(BakeIbl, ASignalLeavesNothing) {
    for (const int signal : {SIGINT, SIGTERM}) {
        RunOptions options;
        options.signal = signal;
        options.signalWhen = "patina bake ibl:";
        const Outcome outcome = runPatina({"bake", "ibl", m_folder / "linear.exr", "-o",
                                           m_folder / "out", "--size", "1024", "--json"},
                                          options);
        EXPECT_EQ(outcome.status, 128 + signal) << outcome.err;
        EXPECT_EQ(outcome.json()["error"]["kind"], "cancelled");
        EXPECT_THAT(m_folder.files(), testing::ElementsAre("linear.exr"));
    }
}
