// Model files that are not what they should be: each has its own message and kind.
#include "core/io/MeshImport.h"
#include "tests/core/worker/ModelFiles.h"

#include <sys/stat.h>
#include <unistd.h>

namespace patina {
namespace {

using testing::HasSubstr;

class ImportErrors : public test::ImportTest {
  protected:
    Error errorOf(const std::filesystem::path& file) {
        const auto model = importModel(worker(), file);
        EXPECT_FALSE(model.ok()) << file;
        return model.ok() ? Error() : model.error();
    }
};

TEST_F(ImportErrors, NotAFile) {
    EXPECT_EQ(errorOf(folder.path() / "none.obj").kind, ErrorKind::InputMissing);
    std::filesystem::create_directory(folder.path() / "folder.obj");
    EXPECT_THAT(errorOf(folder.path() / "folder.obj").message, HasSubstr("folder"));
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
    EXPECT_THAT(errorOf(folder.path() / "pipe.obj").message, HasSubstr("pipe"));
    EXPECT_EQ(errorOf(folder.path() / "pipe.obj").kind, ErrorKind::InputMissing);
}

TEST_F(ImportErrors, UnknownKind) {
    const Error error = importError("scene.blend", "BLENDER");
    EXPECT_EQ(error.kind, ErrorKind::InputBroken);
    EXPECT_THAT(error.message, HasSubstr("supported"));
}

TEST_F(ImportErrors, EmptyAndWrong) {
    for (const std::string& extension : modelExtensions()) {
        const Error empty = importError("a" + extension, "");
        EXPECT_EQ(empty.kind, ErrorKind::InputBroken) << extension;
        EXPECT_THAT(empty.message, HasSubstr("empty")) << extension;
        const Error wrong = importError("a" + extension, "this is a shopping list: milk, eggs\n");
        EXPECT_EQ(wrong.kind, ErrorKind::InputBroken) << extension;
        EXPECT_FALSE(wrong.message.empty()) << extension;
    }
}

TEST_F(ImportErrors, NoFaces) {
    const char* const ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                            "float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_THAT(importError("points.ply", ply).message, HasSubstr("no faces"));
    EXPECT_THAT(importError("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n").message,
                HasSubstr("no faces"));
    EXPECT_THAT(importError("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").message,
                HasSubstr("no faces"));
    EXPECT_THAT(importError("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n").message,
                HasSubstr("no faces"));
    test::GltfBuilder builder;
    builder.node({{"name", "nothing"}});
    EXPECT_THAT(importError("a.glb", builder.glb()).message, HasSubstr("no faces"));
}

TEST_F(ImportErrors, CutShort) {
    worker().setLimits({std::size_t{4} << 30, 2.0, 10.0});
    const auto all = test::seedFiles(worker());
    for (const auto& [extension, seeds] : all)
        for (const std::string& seed : seeds) {
            if (std::find(modelExtensions().begin(), modelExtensions().end(), "." + extension) ==
                modelExtensions().end())
                continue;
            for (const double part : {0.1, 0.5, 0.9}) {
                const auto size = static_cast<std::size_t>(static_cast<double>(seed.size()) * part);
                // Some formats cannot tell; whatever comes back keeps its promises.
                const auto model =
                    importModel(worker(), folder.write("cut." + extension, seed.substr(0, size)));
                if (!model.ok()) {
                    EXPECT_EQ(model.error().kind, ErrorKind::InputBroken) << extension;
                    continue;
                }
                for (const auto& mesh : model->meshes)
                    for (const std::uint32_t index : mesh->indices)
                        ASSERT_LT(index, mesh->vertexCount());
            }
        }
}

// Some words that announce gigabytes are refused before anything is made of them: the processor
// time that is granted here would not be enough for that.
TEST_F(ImportErrors, MoreThanTheBytesThatAreThere) {
    worker().setLimits({std::size_t{4} << 30, 1.0, 60.0});
    const auto accessor = [](std::size_t count, const char* type, int componentType) {
        return nlohmann::json{{"count", count}, {"type", type}, {"componentType", componentType}};
    };
    const auto glb = [&](const nlohmann::json& accessors, const nlohmann::json& primitive) {
        test::GltfBuilder builder;
        builder.root["accessors"] = accessors;
        builder.root["meshes"] = {{{"primitives", {primitive}}}};
        builder.node({{"mesh", 0}});
        return builder.glb();
    };
    constexpr std::size_t kMany = 150'000'000;
    const nlohmann::json positions = {{"attributes", {{"POSITION", 0}}}};
    const nlohmann::json indexed = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
    for (const std::string& content :
         {glb(nlohmann::json::array({accessor(kMany, "VEC3", 5126)}), positions),
          glb({accessor(3, "VEC3", 5126), accessor(kMany, "SCALAR", 5125)}, indexed),
          // Many small ones add up.
          glb({accessor(900'000, "VEC3", 5126), accessor(900'000, "SCALAR", 5125)}, indexed)}) {
        const Error error = importError("zeros.glb", content);
        EXPECT_EQ(error.kind, ErrorKind::InputBroken);
        EXPECT_THAT(error.message, HasSubstr("announces more geometry than it holds"));
    }
    const Error ply = importError(
        "faces.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                     "y\nproperty float z\nelement face 900000000000\nend_header\n0 0 0\n");
    EXPECT_THAT(ply.message, HasSubstr("no faces"));
    worker().setLimits({std::size_t{4} << 30, 20.0, 60.0});
}

// What is legal stays so: zeros as the base of a sparse accessor.
TEST_F(ImportErrors, AFewZerosAreFine) {
    test::GltfBuilder builder;
    const int mesh = builder.triangle();
    const int indices = builder.view(std::string("\1\0\2\0", 4));
    const float moved[6] = {1, 0, 0, 0, 1, 0};
    const int values =
        builder.view(std::string(reinterpret_cast<const char*>(moved), sizeof moved));
    builder.root["accessors"].push_back(
        {{"count", 3},
         {"type", "VEC3"},
         {"componentType", 5126},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
           {"values", {{"bufferView", values}}}}}});
    builder
        .root["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["attributes"]["POSITION"] =
        builder.root["accessors"].size() - 1;
    builder.node({{"mesh", mesh}});
    EXPECT_EQ(import("sparse.glb", builder.glb()).triangleCount, 1u);
}

TEST_F(ImportErrors, AGigabyteOfZeros) {
    for (const char* name : {"zeros.glb", "zeros.stl"}) {
        const auto file = folder.write(name, std::string_view("\0", 1));
        ASSERT_EQ(::truncate(file.c_str(), off_t{1} << 30), 0);
        EXPECT_EQ(errorOf(file).kind, ErrorKind::InputBroken) << name;
    }
}

} // namespace
} // namespace patina
