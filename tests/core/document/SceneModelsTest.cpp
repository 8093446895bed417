#include "core/document/SceneModels.h"

#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using ::testing::ElementsAre;

MeshInstance part(Id id, const char* source, int index, bool visible = true) {
    MeshInstance mesh;
    mesh.id = id;
    mesh.name = "part " + std::to_string(id);
    mesh.source = source;
    mesh.sourceIndex = index;
    mesh.visible = visible;
    return mesh;
}

TEST(SceneModelsTest, MeshesOfOneFileAreOneModel) {
    Document document;
    document.meshes = {part(1, "a", 0), part(2, "a", 1), part(3, "b", 0), part(4, "a", 0)};
    EXPECT_THAT(sceneModels(document),
                ElementsAre(SceneModelPart{"a", "", {1, 2}}, SceneModelPart{"b", "", {3}},
                            SceneModelPart{"a", "", {4}}));
}

TEST(SceneModelsTest, TheSameFileTwiceIsTwoModels) {
    Document document;
    document.meshes = {part(1, "a", 0), part(2, "a", 1), part(3, "a", 0), part(4, "a", 1)};
    EXPECT_THAT(sceneModels(document),
                ElementsAre(SceneModelPart{"a", "", {1, 2}}, SceneModelPart{"a", "", {3, 4}}));
}

TEST(SceneModelsTest, HiddenMeshesAreLeftOut) {
    Document document;
    document.meshes = {part(1, "a", 0, false), part(2, "a", 1), part(3, "b", 0, false),
                       part(4, "a", 0, false), part(5, "a", 1)};
    EXPECT_THAT(sceneModels(document),
                ElementsAre(SceneModelPart{"a", "", {2}}, SceneModelPart{"a", "", {5}}));
}

TEST(SceneModelsTest, OneModelAloneIsItsMeshes) {
    Document document;
    EXPECT_TRUE(sceneModels(document).empty());
    document.meshes = {part(1, "a", 0), part(2, "a", 1)};
    EXPECT_THAT(sceneModels(document),
                ElementsAre(SceneModelPart{"", "part 1", {1}}, SceneModelPart{"", "part 2", {2}}));
    document.meshes.pop_back();
    EXPECT_THAT(sceneModels(document), ElementsAre(SceneModelPart{"", "part 1", {1}}));
}

} // namespace
} // namespace patina
