// The light and the colours of files that radiosity was written to, as they are in the file: what
// reexpose() changes. Private to this module.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/radiosity/document/FilesTogether.h"
#include "core/radiosity/document/Reexpose.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

// Of each of the file's lit parts, in its order.
using ShownLights = std::vector<ShownLight>;
using ShownColors = std::vector<std::vector<glm::vec3>>; // linear, 0…1

// A glTF file, .glb or .gltf with its buffers.
class SolvedGltf {
  public:
    // Errors: InputMissing; InputBroken with what to do.
    static Result<SolvedGltf> read(const std::filesystem::path& file);
    [[nodiscard]] const ShownLights& lights() const { return m_lights; }
    [[nodiscard]] bool showsLightMap() const { return m_showsLightMap; } // then has no lights()
    void setColors(const ShownColors& colors); // of lights(), in their order
    // What it is as `output`. `notices`: of pictures that cannot go along.
    void addFiles(const std::filesystem::path& output, FilesTogether& files,
                  std::vector<std::string>& notices) &&;

  private:
    // Numbers of a vertex attribute within one of the buffers.
    struct Numbers {
        std::size_t buffer = 0, offset = 0, stride = 0, count = 0, components = 0;
    };
    struct Reader;

    std::filesystem::path m_file;
    bool m_isBinary = false;
    std::string m_json;                  // of a .gltf
    std::vector<Bytes> m_buffers;        // of a .glb: the file as a whole
    std::vector<std::string> m_pictures; // files that a .gltf names, beside it
    bool m_showsLightMap = false;
    std::vector<Numbers> m_colors; // of each of m_lights
    ShownLights m_lights;
};

// A PLY as litPly() writes it, and as others may have written it after: little-endian.
class SolvedPly {
  public:
    static Result<SolvedPly> read(const std::filesystem::path& file);
    [[nodiscard]] const ShownLights& lights() const { return m_lights; } // one
    [[nodiscard]] static bool showsLightMap() { return false; }
    void setColors(const ShownColors& colors);
    void addFiles(const std::filesystem::path& output, FilesTogether& files,
                  std::vector<std::string>& notices) &&;

  private:
    struct Reader;

    Bytes m_file;
    std::size_t m_firstVertex = 0, m_stride = 0;
    std::array<std::size_t, 3> m_colors{}; // where the bytes of a vertex are
    ShownLights m_lights;
};

} // namespace patina
