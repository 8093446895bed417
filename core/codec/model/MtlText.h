// The statements of a material file of OBJ that Assimp 5.2.5 does not read as they are meant:
// textures with their options, and anisotropy.
#pragma once

#include "core/codec/model/ModelFolder.h"

#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace patina::codec {

// "map_Kd -s 2 2 -o 0.5 0 wood.png"
struct MtlTexture {
    std::string file;                    // as spelled, without quotes
    glm::vec2 scale{1.0f}, offset{0.0f}; // -s, -o: texture coordinates, v upwards, times scale
                                         // plus offset
    std::optional<float> strength;       // -bm
    char channel = 0;                    // -imfchan: 'r', 'g', 'b', 'a', or 0
};

class MtlText {
  public:
    // Keeps a reference.
    explicit MtlText(const ModelFolder& folder)
        : m_folder(folder) {}

    // For Assimp: each texture by a name that find() knows. Assimp skips most options, and takes
    // quotes, comments and blanks at the end for part of the name. Without "aniso" and "anisor", as
    // Blender writes them: their names were read as numbers (assimp issue 5635).
    [[nodiscard]] std::optional<std::string> rewritten(std::string_view text);

    // Null for a name that rewritten() has not given.
    [[nodiscard]] const MtlTexture* find(std::string_view name) const;
    // Keywords of what a material has no place for: "map_Ks", "Pc".
    [[nodiscard]] const std::set<std::string>& unused() const { return m_unused; }

  private:
    [[nodiscard]] std::optional<MtlTexture> texture(std::string_view statement) const;

    const ModelFolder& m_folder;
    std::vector<MtlTexture> m_textures;
    std::set<std::string> m_unused;
};

} // namespace patina::codec
