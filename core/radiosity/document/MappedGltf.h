// A glTF file whose surfaces show a light map, .glb or .gltf with what lies beside it: the map's
// picture can be replaced, and all else stays as it is. Private to this module.
#pragma once

#include "core/radiosity/document/FilesTogether.h"
#include "core/radiosity/document/GltfParts.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

// Files of a light map as a file names them, to be found beside it.
struct MapNames {
    std::string radiance, picture; // the latter is not used where the picture is inside of the file
};

class MappedGltf {
  public:
    // Errors: InputMissing; InputBroken with what to do.
    static Result<MappedGltf> read(const std::filesystem::path& file);

    [[nodiscard]] const std::string& radiance() const { return m_radiance; } // file beside it
    [[nodiscard]] const Bytes& picture() const { return m_picture; }         // empty: not there
    [[nodiscard]] const std::string& pictureName() const { return m_pictureFile; }

    // Shows another picture of its light map, a PNG of the exposure `k` (0: cut off at 1), and adds
    // its files as `output`. Errors: Usage where it would be larger than a .glb can be.
    Result<void> addFiles(const std::filesystem::path& output, const MapNames& names, Bytes picture,
                          double k, FilesTogether& files, std::vector<std::string>& notices) &&;

  private:
    struct Reader;
    void replaceInBuffer(const Bytes& picture);

    std::filesystem::path m_file;
    bool m_isBinary = false;
    gltf::Json m_root;
    std::vector<Bytes> m_buffers;
    Bytes m_otherChunks; // of a .glb, as they are
    std::string m_radiance;
    std::size_t m_image = 0;           // of the picture
    std::string m_pictureFile;         // empty: it is in a buffer
    std::vector<std::string> m_others; // files of other pictures
    Bytes m_picture;
};

} // namespace patina
