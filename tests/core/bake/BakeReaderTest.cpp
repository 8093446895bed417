// The reader in docs/prt-format.md, run by Python on files of ours.
#include "core/bake/file/BakeIO.h"
#include "core/document/Document.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/bake/BakeFileScene.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace patina;
using namespace patina::test;

namespace {

// A block of Python in the document: the first reads files, the second unpacks parts.
std::string documentedBlock(int number) {
    std::ifstream file(PATINA_SOURCE_DIR "/docs/prt-format.md");
    std::stringstream text;
    text << file.rdbuf();
    const std::string all = text.str(), fence = "```python\n";
    std::size_t begin = 0;
    for (int i = 0; i < number; ++i)
        begin = all.find(fence, begin) + fence.size();
    return all.substr(begin, all.find("```", begin) - begin);
}

// Prints, a line each: the exit radiance of every vertex under L_i = 1, 1/2, 1/3 …, red; for parts
// without bounces without them.
constexpr const char* kProgram = R"(
import sys
for attributes, width, height, numbers in unpack(read_bake(sys.argv[1])):
    count, order = int(attributes["patina:vertexCount"]), int(attributes["patina:order"])
    names = [f"l{l}m{m}" for l in range(order) for m in range(-l, l + 1)]
    steps = [[float(s) for s in attributes[k].split() ] if k in attributes else [1.0] * order
             for k in ("patina:step.sh", "patina:step.bounced")]
    assert len(numbers["error"] if "error" in numbers else numbers["sh.l0m0"]) == width * height
    for e in range(count):
        sum = 0.0
        for i, name in enumerate(names):
            band = int(i ** 0.5)
            red = numbers.get(f"bounced.{name}.R") or numbers.get(f"bounced.{name}")
            sum += (numbers[f"sh.{name}"][e] * steps[0][band]
                    + (red[e] * steps[1][band] if red else 0)) / (i + 1)
        print(repr(sum))
)";

std::vector<double> readByPython(const TemporaryFolder& folder, const std::filesystem::path& bake) {
    const std::filesystem::path script = folder.path() / "read.py", out = folder.path() / "out.txt";
    std::ofstream(script) << documentedBlock(1) << documentedBlock(2) << kProgram;
    const std::string command =
        fmt::format("python3 \"{}\" \"{}\" > \"{}\"", script.string(), bake.string(), out.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << "is python3 installed?";
    std::ifstream file(out);
    std::vector<double> values;
    for (double value = 0; file >> value;)
        values.push_back(value);
    return values;
}

std::vector<double> exitRadiance(const BakeArtifact& artifact) {
    std::vector<double> result;
    for (const VertexBake& bake : artifact.vertices) {
        const auto stride = static_cast<std::size_t>(bake.stride);
        for (std::size_t e = 0; e < bake.values.size(); e += stride) {
            double sum = 0.0;
            for (std::size_t i = 0; i < stride; ++i) {
                const double bounced = bake.bounced.empty() ? 0.0 : bake.bounced[3 * (e + i)];
                sum += (bake.values[e + i] + bounced) / static_cast<double>(i + 1);
            }
            result.push_back(sum);
        }
    }
    return result;
}

} // namespace

TEST(BakeReader, FitsThirtyLines) {
    const std::string reader = documentedBlock(1);
    EXPECT_NE(documentedBlock(2).find("def unpack"), std::string::npos);
    EXPECT_LE(std::count(reader.begin(), reader.end(), '\n'), 30);
    EXPECT_NE(reader.find("def read_bake"), std::string::npos);
}

TEST(BakeReader, ReadsWhatWeWrite) {
    Document scene = bakeDocument();
    WorkerClient worker;
    const TemporaryFolder folder;
    for (const bool several : {true, false}) {
        if (!several) // a file of one part has another header
            scene.meshes.resize(1);
        for (const TransferKind transfer : {TransferKind::Shadowed, TransferKind::Interreflected})
            for (const BakeStorage storage :
                 {BakeStorage::Float, BakeStorage::Half, BakeStorage::Quantised}) {
                SCOPED_TRACE(fmt::format("{} {}", several, storageName(storage)));
                const BakeFileOptions options{storage, 10};
                BakeArtifact bake = randomBake(scene, BakeKind::PrtVertex, 2, transfer);
                // Smooth values compress: blocks of both kinds, packed and plain, are met.
                for (std::size_t i = 0; i < bake.vertices[0].values.size() / 2; ++i)
                    bake.vertices[0].values[i] = 0.25f;
                const Result<Bytes> bytes = encodeBake(worker, bake, scene, options);
                ASSERT_TRUE(bytes.ok());
                const auto file = folder.write("bake.exr", *bytes);
                const Result<BakeArtifact> ours = loadBake(worker, file, scene);
                ASSERT_TRUE(ours.ok());
                const std::vector<double> expected = exitRadiance(*ours);
                const std::vector<double> found = readByPython(folder, file);
                ASSERT_EQ(found.size(), expected.size());
                for (std::size_t i = 0; i < found.size(); ++i)
                    ASSERT_NEAR(found[i], expected[i], 1e-6) << i;
            }
    }
}

// More meshes, of one name, than a file has parts.
TEST(BakeReader, ReadsWhatSharesAPart) {
    Document scene = bakeDocument();
    scene.meshes.erase(scene.meshes.begin(), scene.meshes.begin() + 2); // the cube is left
    for (int i = 1; i < 1100; ++i) {
        scene.meshes.push_back(scene.meshes.front());
        scene.meshes.back().id = scene.takeId();
    }
    WorkerClient worker;
    const TemporaryFolder folder;
    const BakeArtifact bake =
        randomBake(scene, BakeKind::PrtVertex, 1, TransferKind::Interreflected);
    const Result<Bytes> bytes = encodeBake(worker, bake, scene, {});
    ASSERT_TRUE(bytes.ok()) << bytes.error().text();
    const auto file = folder.write("bake.exr", *bytes);
    const Result<BakeArtifact> ours = loadBake(worker, file, scene);
    ASSERT_TRUE(ours.ok()) << ours.error().text();
    expectSame(*ours, bake);
    const std::vector<double> expected = exitRadiance(*ours), found = readByPython(folder, file);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i], expected[i], 1e-6) << i;
}
