// The text of an OBJ file in two: its geometry as numbers, and an outline of the rest.
//
// Only what nearly all files hold is read: lines "v", "vt", "vn" and "f" in their usual spelling,
// faces with three or four corners. Whatever a reader could take in two ways is left to Assimp, so
// that a file comes to the same model by either way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina::codec {

struct ObjText {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    struct Corner {
        std::uint32_t position = 0, uv = kNone, normal = kNone; // from 0
    };
    // Faces with no other statement between them. They end where those of the next run begin.
    struct Run {
        std::size_t firstFace = 0, firstCorner = 0;
    };

    std::vector<glm::vec3> positions, normals; // as they stand, any length
    std::vector<glm::vec2> uvs;                // as in glTF: v grows downwards
    std::deque<Corner> corners;                // of all faces; a deque never copies what it holds
    std::vector<std::uint8_t> cornerCounts;    // of each face: 3 or 4
    std::vector<Run> runs;
    bool vertexColors = false; // stand behind positions
    // The file with one triangle for each run of faces; all of its corners are the vertex
    // (number of the run, 0, 0).
    std::string outline;
};

// Nothing where the file holds anything else.
[[nodiscard]] std::optional<ObjText> readObjText(std::string_view text);

} // namespace patina::codec
