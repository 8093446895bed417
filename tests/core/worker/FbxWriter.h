// FBX documents for tests, in both spellings of the format (7.4 binary, after the layout published
// by the Blender foundation, and text).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace patina::test {

using FbxProperty = std::variant<std::int32_t, std::int64_t, double, std::string,
                                 std::vector<double>, std::vector<std::int32_t>>;

struct FbxNode {
    std::string name;
    std::vector<FbxProperty> properties;
    std::vector<FbxNode> children;
};

// Strings of the form "name::class" are object names.
std::string writeFbxText(const std::vector<FbxNode>& document);
std::string writeFbxBinary(const std::vector<FbxNode>& document);

// A quad of two triangles in the plane z = 0 from (0, 0) to (`size`, `size`), textured with
// "wood.png" at scale 2, in the given units and axes.
struct FbxScene {
    double unitScaleFactor = 1.0; // centimetres per unit
    int upAxis = 1, frontAxis = 2, coordAxis = 0;
    int upSign = 1, frontSign = 1, coordSign = 1;
    double size = 1.0;
    double translation[3] = {0, 0, 0};
};
std::vector<FbxNode> fbxQuad(const FbxScene& scene = {});

} // namespace patina::test
