#include "core/material/MaterialInputs.h"

#include <gtest/gtest.h>
#include <set>
#include <string>

namespace patina {
namespace {

TEST(MaterialInputs, EachHasItsOwnMapValueAndPlaces) {
    Material material;
    std::set<const void*> members;
    std::set<std::string_view> ids, parameters;
    std::set<std::string> gltf;
    for (const MaterialInputInfo& info : kMaterialInputs) {
        EXPECT_TRUE(members.insert(&(material.*info.map)).second) << info.id;
        const void* value = info.color != nullptr
                                ? static_cast<const void*>(&(material.*info.color))
                                : &(material.*info.number);
        EXPECT_TRUE(members.insert(value).second) << info.id;
        EXPECT_TRUE(ids.insert(info.id).second) << info.id;
        EXPECT_TRUE(parameters.insert(info.parameters.map).second) << info.id;
        EXPECT_TRUE(gltf.insert(std::string(info.gltf.texture) + info.gltf.channel).second)
            << info.id;
    }
}

// The names that shading and uniforms go by are the last part of the parameter's.
TEST(MaterialInputs, NumbersAreCalledAsInTheShader) {
    shading::SurfaceInputs inputs;
    std::set<const float*> members{&inputs.diffuseRoughness, &inputs.ior};
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.role != InputRole::Number)
            continue;
        EXPECT_TRUE(members.insert(&(inputs.*info.shown)).second) << info.id;
        EXPECT_EQ(info.parameters.value(), "material." + std::string(info.id));
    }
}

TEST(MaterialInputs, NumbersOfAnUneditedMaterialAreItsDefaults) {
    const PerInput<float> numbers = defaultNumbers();
    for (const MaterialInputInfo& info : kMaterialInputs)
        EXPECT_EQ(numbers[info.input], info.number != nullptr ? Material().*info.number : 0.0f);
}

TEST(MaterialInputs, EveryMapIsVisitedOnce) {
    Material material;
    std::set<const MapSlot*> seen;
    forEachMap(material, [&](const MapSlot& map) { EXPECT_TRUE(seen.insert(&map).second); });
    EXPECT_EQ(seen.size(), kMaterialInputs.size());
}

} // namespace
} // namespace patina
