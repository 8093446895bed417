// Model files for tests: written by hand, small, with everything an importer has to get right.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/io/MeshImport.h"
#include "core/material/Material.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace patina::test {

// A glTF document under construction: accessors go in, JSON and one binary buffer come out.
class GltfBuilder {
  public:
    GltfBuilder();

    nlohmann::json root;

    // Each returns the accessor's index. 16 components are a matrix.
    int floats(const std::vector<float>& values, int components);
    template <class T>
    int integers(const std::vector<T>& values, int components, bool normalized = false);
    int view(const std::string& bytes); // returns the buffer view's index

    // A unit triangle (0,0,0) (1,0,0) (0,1,0) with normals and uvs; returns the mesh's index.
    int triangle(int material = -1);
    int node(nlohmann::json node); // added to the scene

    [[nodiscard]] std::string glb() const;
    // The JSON with the buffer as a data URI or as a file of this name.
    [[nodiscard]] std::string gltf(const std::string& bufferUri = {}) const;
    [[nodiscard]] const std::string& binary() const { return m_binary; }

  private:
    int accessor(const std::string& bytes, int componentType, int components, std::size_t count,
                 bool normalized);
    std::string m_binary;
};

std::string base64(const std::string& bytes);
std::string bytesOf(const Bytes& bytes);

// Seeds, by format: "glb", "gltf", "obj", "fbx", "dae", "ply", "stl", "png", "jpg", "exr", "hdr".
// The OBJ's material file is in `objMaterials`.
std::map<std::string, std::vector<std::string>> seedFiles(WorkerClient& worker);
extern const char* const kObjMaterials; // "seed.mtl"
std::string daeQuad(const std::string& unit, const std::string& upAxis);

// A worker and a folder for a suite of import tests.
class ImportTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        s_worker = std::make_unique<WorkerClient>();
        s_worker->setLimits({std::size_t{4} << 30, 20.0, 60.0});
    }
    static void TearDownTestSuite() { s_worker.reset(); }
    static WorkerClient& worker() { return *s_worker; }
    static void expectNear(glm::vec3 a, glm::vec3 b, float tolerance = 1e-5f) {
        EXPECT_LT(glm::distance(a, b), tolerance)
            << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " " << b.z;
    }

    // An empty model after a reported failure.
    ImportedModel import(const std::string& name, std::string_view content) {
        auto model = importModel(worker(), folder.write(name, content));
        EXPECT_TRUE(model.ok()) << model.error().text();
        if (model.ok())
            return std::move(*model);
        ImportedModel empty;
        empty.meshes.push_back(std::make_shared<Mesh>());
        empty.materials.resize(8);
        empty.instances.resize(8);
        return empty;
    }
    Error importError(const std::string& name, std::string_view content) {
        const auto file = folder.write(name, content);
        const auto model = importModel(worker(), file);
        EXPECT_FALSE(model.ok());
        if (model.ok())
            return {};
        EXPECT_EQ(model.error().file, file);
        return model.error();
    }
    // The corners of an instance's triangles, in world space.
    static std::vector<glm::vec3> corners(const ImportedModel& model, std::size_t instance = 0);
    // Twice the vector area of all triangles: its direction is the front.
    static glm::vec3 areaVector(const ImportedModel& model, std::size_t instance = 0);

    TemporaryFolder folder;

  private:
    static inline std::unique_ptr<WorkerClient> s_worker;
};

} // namespace patina::test
