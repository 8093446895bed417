// Bakes lead back to the model's own file: what docs/prt-format.md says about that, its Python
// included, on files whose import changes the vertices.
#include "core/bake/file/BakeSource.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/file/BakeFileSize.h"
#include "core/bake/file/BakeIO.h"
#include "core/bake/file/BakeParts.h"
#include "core/io/MeshImport.h"
#include "core/mesh/MeshSource.h"
#include "core/scene/Scene.h"
#include "tests/core/bake/BakeFileScene.h"
#include "tests/core/worker/ModelFiles.h"

#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <sstream>

using namespace patina;
using namespace patina::test;

namespace {

using nlohmann::json;

// A value in 0…1 that says where in the world a vertex stands: halves hold it to 1/2048.
float valueAt(const glm::vec3& world) {
    const float sum = 0.37f * world.x + 0.11f * world.y + 0.23f * world.z;
    return 0.5f + 0.4f * std::sin(sum);
}

// All blocks of Python in the document.
std::string documentedPython() {
    std::ifstream file(PATINA_SOURCE_DIR "/docs/prt-format.md");
    std::stringstream text;
    text << file.rdbuf();
    const std::string all = text.str(), fence = "```python\n";
    std::string result;
    for (std::size_t at = all.find(fence); at != std::string::npos; at = all.find(fence, at)) {
        at += fence.size();
        const std::string block = all.substr(at, all.find("```", at) - at);
        if (block.find("def ") != std::string::npos)
            result += block;
    }
    return result;
}

struct Shape {
    std::vector<float> positions, normals;
    std::vector<std::uint16_t> indices;
};

// A sphere of shared vertices, with `unused` ones before, between and after the others.
Shape sphere(int unused) {
    Shape shape;
    constexpr int kRings = 7, kSegments = 11;
    std::vector<std::uint16_t> vertex;
    const auto waste = [&](float x) {
        for (int i = 0; i < unused; ++i) {
            shape.positions.insert(shape.positions.end(), {x, 50.0f, 50.0f});
            shape.normals.insert(shape.normals.end(), {0, 1, 0});
        }
    };
    for (int r = 0; r <= kRings; ++r) {
        waste(float(r));
        for (int s = 0; s < kSegments; ++s) {
            const float theta = 3.14159265f * (float(r) + 0.2f) / (kRings + 0.4f),
                        phi = 6.2831853f * float(s) / kSegments;
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
            vertex.push_back(static_cast<std::uint16_t>(shape.positions.size() / 3));
            for (const float c : {n.x, n.y, n.z}) {
                shape.positions.push_back(1.5f * c);
                shape.normals.push_back(c);
            }
        }
    }
    const auto at = [&](int r, int s) {
        return vertex[static_cast<std::size_t>(r * kSegments + s % kSegments)];
    };
    for (int r = 0; r < kRings; ++r)
        for (int s = 0; s < kSegments; ++s)
            shape.indices.insert(shape.indices.end(),
                                 {at(r, s), at(r, s + 1), at(r + 1, s), at(r, s + 1),
                                  at(r + 1, s + 1), at(r + 1, s)});
    return shape;
}

json primitive(GltfBuilder& builder, const Shape& shape, bool normals) {
    json result = {{"attributes", {{"POSITION", builder.floats(shape.positions, 3)}}},
                   {"indices", builder.integers(shape.indices, 1)}};
    if (normals)
        result["attributes"]["NORMAL"] = builder.floats(shape.normals, 3);
    return result;
}

class BakeSource : public ImportTest {
  protected:
    // Bakes known values onto the model, puts them back by the documented Python and compares, for
    // each node and primitive, each vertex that a triangle uses.
    void expectRoundTrip(GltfBuilder& builder, const BakeFileOptions& options, double tolerance) {
        const auto glb = folder.write("model.glb", builder.glb());
        const Result<OpenedScene> opened = openScene(worker(), glb.string());
        ASSERT_TRUE(opened.ok()) << opened.error().text();
        const Document& document = opened->document;
        BakeArtifact artifact;
        artifact.kind = BakeKind::AoVertex;
        artifact.inputs = hashBakeInputs(bakeInputs(document));
        artifact.samplesDone = 1;
        for (const MeshInstance& mesh : document.meshes) {
            VertexBake& bake = artifact.vertices.emplace_back();
            bake.mesh = mesh.id;
            for (const glm::vec3& p : mesh.mesh->positions)
                bake.values.push_back(
                    valueAt(glm::vec3(mesh.placement.matrix() * glm::vec4(p, 1.0f))));
        }
        // What is said before the start counts these channels, too.
        std::size_t numbers = 0;
        for (const ImagePart& part : bakeToParts(artifact, document, options))
            numbers += part.image.f32().size();
        BakeRequest request;
        request.kind = artifact.kind;
        EXPECT_EQ(bakeFileBytes(request, bakeInputs(document)), numbers * sizeof(float));

        const Result<Bytes> bytes = encodeBake(worker(), artifact, document, options);
        ASSERT_TRUE(bytes.ok()) << bytes.error().text();
        const auto bake = folder.write("bake.exr", *bytes);
        const Result<BakeArtifact> loaded = loadBake(worker(), bake, document);
        EXPECT_TRUE(loaded.ok()) << loaded.error().text();

        std::ofstream(folder / "apply.py")
            << documentedPython() << "import sys\napply_bake(*sys.argv[1:])\n";
        const auto out = folder / "out.glb";
        const std::string command =
            fmt::format("python3 \"{}\" \"{}\" \"{}\" ao _AO \"{}\"",
                        (folder / "apply.py").string(), glb.string(), bake.string(), out.string());
        ASSERT_EQ(std::system(command.c_str()), 0);
        compare(out, tolerance);
    }

    static void compare(const std::filesystem::path& file, double tolerance) {
        std::ifstream stream(file, std::ios::binary);
        std::stringstream text;
        text << stream.rdbuf();
        const std::string data = text.str();
        std::uint32_t size = 0;
        std::memcpy(&size, data.data() + 12, 4);
        const json gltf = json::parse(data.substr(20, size));
        const std::string binary = data.substr(28 + size);
        const auto bytesOf = [&](const json& accessor) {
            const json& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
            return binary.data() + view.value("byteOffset", std::size_t{0});
        };
        const auto floats = [&](const json& accessor, std::size_t components) {
            std::vector<float> values(accessor["count"].get<std::size_t>() * components);
            std::memcpy(values.data(), bytesOf(accessor), values.size() * sizeof(float));
            return values;
        };
        std::size_t compared = 0;
        for (const json& node : gltf["nodes"]) {
            if (!node.contains("mesh"))
                continue;
            glm::mat4 world(1.0f);
            if (node.contains("matrix"))
                for (int i = 0; i < 16; ++i)
                    world[i / 4][i % 4] = node["matrix"][static_cast<std::size_t>(i)].get<float>();
            for (const json& part : gltf["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
                const json& accessors = gltf["accessors"];
                const auto positions =
                    floats(accessors[part["attributes"]["POSITION"].get<std::size_t>()], 3);
                ASSERT_TRUE(part["attributes"].contains("_AO")) << node.dump();
                const auto values =
                    floats(accessors[part["attributes"]["_AO"].get<std::size_t>()], 1);
                const json& indices = accessors[part["indices"].get<std::size_t>()];
                std::vector<std::uint16_t> used(indices["count"].get<std::size_t>());
                std::memcpy(used.data(), bytesOf(indices), used.size() * sizeof(std::uint16_t));
                for (const std::uint16_t i : used) {
                    const glm::vec4 p(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2],
                                      1.0f);
                    ASSERT_NEAR(values[i], valueAt(glm::vec3(world * p)), tolerance) << i;
                    ++compared;
                }
            }
        }
        EXPECT_GT(compared, 100u);
    }

    static json matrixOf(const glm::mat4& m) {
        json result = json::array();
        for (int i = 0; i < 16; ++i)
            result.push_back(m[i / 4][i % 4]);
        return result;
    }
};

} // namespace

TEST_F(BakeSource, OntoAFileWithoutTextureCoordinatesAndWithUnusedVertices) {
    for (const bool normals : {true, false})
        for (const BakeStorage storage : {BakeStorage::Float, BakeStorage::Half}) {
            SCOPED_TRACE(fmt::format("normals {}, {}", normals, storageName(storage)));
            GltfBuilder builder;
            const Shape shape = sphere(3);
            builder.root["meshes"] = {{{"primitives", {primitive(builder, shape, normals)}}}};
            builder.node({{"mesh", 0}});
            expectRoundTrip(builder, {storage, 8}, storage == BakeStorage::Float ? 1e-6 : 1e-3);
            // Import has changed the vertices, or this would show nothing.
            const auto model = importModel(worker(), folder / "model.glb");
            ASSERT_TRUE(model.ok());
            EXPECT_NE(model->meshes[0]->vertexCount(), shape.positions.size() / 3);
        }
}

TEST_F(BakeSource, OntoSharedAndMirroredNodesAndSeveralPrimitives) {
    GltfBuilder builder;
    const Shape first = sphere(1), second = sphere(0);
    builder.root["meshes"] = {
        {{"name", "one"}, {"primitives", {primitive(builder, first, true)}}},
        {{"name", "two"},
         {"primitives", {primitive(builder, second, true), primitive(builder, first, false)}}}};
    const glm::mat4 here = glm::translate(glm::mat4(1.0f), {3, 1, 2});
    const glm::mat4 mirror = glm::scale(glm::translate(glm::mat4(1.0f), {-5, 0, 1}), {-1, 2, 1});
    builder.node({{"name", "no mesh"}});
    builder.node({{"name", "same name"}, {"mesh", 1}, {"matrix", matrixOf(here)}});
    builder.node({{"name", "same name"}, {"mesh", 1}, {"matrix", matrixOf(mirror)}});
    builder.node({{"name", "same name"}, {"mesh", 0}, {"matrix", matrixOf(mirror * here)}});
    builder.node({{"name", "same name"}, {"mesh", 0}});
    expectRoundTrip(builder, {}, 1e-6);
}

// Numbers beyond what a half float counts to.
TEST_F(BakeSource, DigitsHoldAnyIndex) {
    Mesh mesh = cubeMesh();
    MeshSource source;
    source.mesh = 100'000;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        source.vertices.push_back(static_cast<std::uint32_t>(i * 123'456'789u));
    const std::vector<std::uint32_t> expected = source.vertices;
    MeshInstance instance;
    instance.mesh = withSource(std::move(mesh), source);
    std::map<std::string, std::vector<float>> channels;
    for (const SourceChannel& channel : sourceChannels(instance))
        channels[channel.name] = channel.values;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        double index = 0.0, factor = 1.0;
        for (const char* digit : {"source.vertex", "source.vertex.1", "source.vertex.2"}) {
            EXPECT_LT(channels.at(digit)[i], 2048.0f);
            index += factor * double{channels.at(digit)[i]};
            factor *= 2048.0;
        }
        EXPECT_EQ(index, expected[i]);
    }
    EXPECT_FALSE(channels.contains("source.primitive.1"));
    EXPECT_EQ(channels.at("source.mesh")[0] + 2048.0f * channels.at("source.mesh.1")[0],
              100'000.0f);
}

// Where import lets all be, there is still an index for each vertex; built-in meshes have none.
TEST_F(BakeSource, IsKnownOfPlyAndStlAndOfNothingBuiltIn) {
    const ImportedModel ply =
        import("a.ply", "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float "
                        "y\nproperty float z\nelement face 1\nproperty list uchar int "
                        "vertex_indices\nend_header\n9 9 9\n0 0 0\n1 0 0\n8 8 8\n0 1 0\n3 1 2 4\n");
    ASSERT_NE(meshSource(ply.meshes[0]), nullptr);
    EXPECT_EQ(meshSource(ply.meshes[0])->vertices, (std::vector<std::uint32_t>{1, 2, 4}));
    EXPECT_TRUE(sourceChannels(bakeDocument().meshes[0]).empty());
}

// Texels of the surface and those that were filled beside it.
TEST_F(BakeSource, TexelBakesSayWhatTheyCover) {
    Document scene = bakeDocument();
    Mesh corner = *scene.meshes[0].mesh; // its charts in a part of the texture
    for (glm::vec2& uv : corner.uvs)
        uv = 0.1f + 0.4f * uv;
    scene.meshes[0].mesh = std::make_shared<const Mesh>(std::move(corner));
    const BakeArtifact bake = randomBake(scene, BakeKind::AoTexel);
    const std::vector<ImagePart> parts = bakeToParts(bake, scene);
    ASSERT_EQ(parts[0].image.channelNames(), (std::vector<std::string>{"ao", "coverage"}));
    double covered = 0.0;
    for (std::size_t i = 1; i < parts[0].image.f32().size(); i += 2) {
        const float coverage = parts[0].image.f32()[i];
        ASSERT_TRUE(coverage == 0.0f || coverage == 1.0f);
        const std::size_t texel = i / 2;
        const std::size_t x = texel % 33, y = texel / 33;
        // From 3.3 to 16.5; a texel that is touched counts.
        if (std::min(x, y) < 2 || std::max(x, y) > 17) {
            ASSERT_EQ(coverage, 0.0f) << x << ", " << y;
        }
        covered += double{coverage};
    }
    EXPECT_GT(covered, 0.8 * 13 * 13);
    const Result<BakeArtifact> back = bakeFromParts(parts, scene, "bake.exr");
    ASSERT_TRUE(back.ok()) << back.error().text();
    expectSame(*back, bake);

    // Another geometry cannot tell.
    scene.meshes[0].placement.setPosition({1, 0, 0});
    EXPECT_EQ(bakeToParts(bake, scene)[0].image.channelNames(), (std::vector<std::string>{"ao"}));
}
