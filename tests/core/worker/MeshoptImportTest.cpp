// glTF of which views are compressed, against the same model without.
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <meshoptimizer.h>

namespace patina {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::size_t kSide = 20, kVertices = kSide * kSide;

std::string text(std::vector<unsigned char> bytes, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()), size};
}

// A wavy square of 20 × 20 vertices.
struct Wave {
    std::vector<float> positions, normals;
    std::vector<std::uint16_t> uvs, indices;
    Wave() {
        for (std::size_t y = 0; y < kSide; ++y)
            for (std::size_t x = 0; x < kSide; ++x) {
                const float u = static_cast<float>(x) / (kSide - 1),
                            v = static_cast<float>(y) / (kSide - 1);
                positions.insert(positions.end(), {u, 0.1f * std::sin(6.0f * u), v});
                const glm::vec3 n =
                    glm::normalize(glm::vec3(-0.6f * std::cos(6.0f * u), 1.0f, 0.0f));
                normals.insert(normals.end(), {n.x, n.y, n.z});
                uvs.insert(uvs.end(), {static_cast<std::uint16_t>(65535.0f * u),
                                       static_cast<std::uint16_t>(65535.0f * v)});
            }
        for (std::size_t y = 0; y + 1 < kSide; ++y)
            for (std::size_t x = 0; x + 1 < kSide; ++x) {
                const auto a = static_cast<std::uint16_t>(y * kSide + x);
                const auto b = static_cast<std::uint16_t>(a + kSide);
                for (const int k : {a + 0, b + 0, a + 1, a + 1, b + 0, b + 1})
                    indices.push_back(static_cast<std::uint16_t>(k));
            }
    }
    [[nodiscard]] std::string glb() const {
        test::GltfBuilder builder;
        const json primitive = {{"attributes",
                                 {{"POSITION", builder.floats(positions, 3)},
                                  {"NORMAL", builder.floats(normals, 3)},
                                  {"TEXCOORD_0", builder.integers(uvs, 2, true)}}},
                                {"indices", builder.integers(indices, 1)}};
        builder.root["meshes"] = {{{"primitives", {primitive}}}};
        builder.node({{"mesh", 0}});
        return builder.glb();
    }
};

class MeshoptImport : public test::ImportTest {
  protected:
    // Appends compressed bytes and a view of them; its own bytes are in a buffer that is not there.
    std::size_t view(const std::string& bytes, std::size_t count, std::size_t stride,
                     const char* mode, const char* filter = nullptr) {
        const auto raw = static_cast<std::size_t>(builder.view(bytes));
        json extension = builder.root["bufferViews"][raw];
        extension["count"] = count;
        extension["byteStride"] = stride;
        extension["mode"] = mode;
        if (filter)
            extension["filter"] = filter;
        json compressed = {{"buffer", 1},
                           {"byteLength", count * stride},
                           {"extensions", {{"EXT_meshopt_compression", extension}}}};
        if (std::string_view(mode) == "ATTRIBUTES")
            compressed["byteStride"] = stride;
        builder.root["bufferViews"].push_back(compressed);
        return builder.root["bufferViews"].size() - 1;
    }
    template <class T>
    std::size_t vertices(const std::vector<T>& values, std::size_t stride,
                         const char* filter = nullptr) {
        const std::size_t count = values.size() * sizeof(T) / stride;
        std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
        const std::size_t size =
            meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride);
        return view(text(bytes, size), count, stride, "ATTRIBUTES", filter);
    }
    std::size_t accessor(std::size_t view, int type, const char* shape, std::size_t count,
                         bool normalized = false) {
        builder.root["accessors"].push_back({{"bufferView", view},
                                             {"componentType", type},
                                             {"count", count},
                                             {"type", shape},
                                             {"normalized", normalized}});
        return builder.root["accessors"].size() - 1;
    }
    // Without what is not used: `filters` for positions and normals, triangles or plain indices.
    std::string compressed(bool filters, bool asTriangles) {
        json attributes;
        if (filters) {
            std::vector<std::uint32_t> exponents(wave.positions.size());
            meshopt_encodeFilterExp(exponents.data(), kVertices, 12, 23, wave.positions.data());
            attributes["POSITION"] =
                accessor(vertices(exponents, 12, "EXPONENTIAL"), 5126, "VEC3", kVertices);
            std::vector<float> four;
            for (std::size_t i = 0; i < wave.normals.size(); i += 3)
                four.insert(four.end(),
                            {wave.normals[i], wave.normals[i + 1], wave.normals[i + 2], 0.0f});
            std::vector<std::int16_t> octahedral(4 * kVertices);
            meshopt_encodeFilterOct(octahedral.data(), kVertices, 8, 16, four.data());
            attributes["NORMAL"] =
                accessor(vertices(octahedral, 8, "OCTAHEDRAL"), 5122, "VEC3", kVertices, true);
        } else {
            attributes["POSITION"] =
                accessor(vertices(wave.positions, 12), 5126, "VEC3", kVertices);
            attributes["NORMAL"] = accessor(vertices(wave.normals, 12), 5126, "VEC3", kVertices);
        }
        attributes["TEXCOORD_0"] = accessor(vertices(wave.uvs, 4), 5123, "VEC2", kVertices, true);
        const std::size_t count = wave.indices.size();
        std::vector<unsigned char> bytes(
            std::max(meshopt_encodeIndexBufferBound(count, kVertices),
                     meshopt_encodeIndexSequenceBound(count, kVertices)));
        const std::size_t size =
            asTriangles
                ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), wave.indices.data(), count)
                : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), wave.indices.data(),
                                              count);
        const std::size_t indices =
            accessor(view(text(bytes, size), count, 2, asTriangles ? "TRIANGLES" : "INDICES"), 5123,
                     "SCALAR", count);
        builder.root["meshes"] = {
            {{"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
        builder.root["extensionsUsed"] = {"EXT_meshopt_compression"};
        builder.root["extensionsRequired"] = {"EXT_meshopt_compression"};
        builder.node({{"mesh", 0}});
        return glb();
    }
    // With the buffer that is not there.
    std::string glb() {
        std::string file = builder.glb();
        json root = json::parse(file.substr(20, wordAt(file, 12)));
        root["buffers"].push_back(
            {{"byteLength", 100'000},
             {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
        std::string json = root.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        file.replace(20, wordAt(file, 12), json);
        putWord(file, 12, json.size());
        putWord(file, 8, file.size());
        return file;
    }
    static std::uint32_t wordAt(const std::string& file, std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, file.data() + at, 4);
        return value;
    }
    static void putWord(std::string& file, std::size_t at, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        std::memcpy(file.data() + at, &word, 4);
    }

    const Wave wave;
    test::GltfBuilder builder;
};

TEST_F(MeshoptImport, IsTheModelThatWasCompressed) {
    const Mesh expected = *import("plain.glb", wave.glb()).meshes[0];
    for (const bool filters : {false, true})
        for (const bool asTriangles : {false, true}) {
            SCOPED_TRACE(std::to_string(filters) + std::to_string(asTriangles));
            builder = test::GltfBuilder();
            const ImportedModel model = import("a.glb", compressed(filters, asTriangles));
            const Mesh& mesh = *model.meshes[0];
            ASSERT_EQ(mesh.vertexCount(), expected.vertexCount());
            ASSERT_EQ(mesh.indices.size(), expected.indices.size());
            const float tolerance = filters ? 1e-4f : 0.0f;
            for (std::size_t i = 0; i < kVertices; ++i) {
                EXPECT_LE(glm::distance(mesh.positions[i], expected.positions[i]), tolerance);
                EXPECT_LE(glm::distance(mesh.normals[i], expected.normals[i]), tolerance);
                EXPECT_EQ(mesh.uvs[i], expected.uvs[i]);
            }
            // The codec of triangles may begin each with another corner, in the same order.
            for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
                const auto* a = mesh.indices.data() + t;
                const auto* b = expected.indices.data() + t;
                const auto* first = std::find(b, b + 3, a[0]);
                ASSERT_NE(first, b + 3) << t;
                EXPECT_EQ(a[1], b[(first - b + 1) % 3]);
                EXPECT_EQ(a[2], b[(first - b + 2) % 3]);
            }
        }
}

TEST_F(MeshoptImport, DamageIsSaid) {
    compressed(true, true);
    const json right = builder.root;
    const std::vector<std::pair<const char*, json>> wrong{
        {"mode", "LINES"},       {"byteStride", 7},        {"byteStride", 260},
        {"filter", "SHARP"},     {"count", 1'000'000'000}, {"byteLength", 10},
        {"buffer", 7},           {"byteOffset", 1u << 30}, {"count", -1},
        {"filter", "QUATERNION"}};
    for (const auto& [key, value] : wrong) {
        builder.root = right;
        for (json& view : builder.root["bufferViews"])
            if (view.contains("extensions")) {
                view["extensions"]["EXT_meshopt_compression"][key] = value;
                break;
            }
        const auto model = importModel(worker(), folder.write("wrong.glb", glb()));
        ASSERT_FALSE(model.ok()) << key << ' ' << value;
        EXPECT_EQ(model.error().kind, ErrorKind::InputBroken) << key << ' ' << value;
        EXPECT_THAT(model.error().message, HasSubstr("damaged")) << key << ' ' << value;
    }
}

} // namespace
} // namespace patina
