#include "core/radiosity/document/MappedGltf.h"

#include "core/base/Limits.h"
#include "core/export/GltfWriter.h"
#include "core/export/LitVertices.h"
#include "core/export/Names.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;
using gltf::at;
using gltf::Broken;
using gltf::fileOf;
using gltf::Json;
using gltf::member;
using gltf::whole;

constexpr std::size_t kMostGlbBytes = 0xffffffffu; // its header counts in 32 bits
constexpr const char* kMapChanged = "another program has changed it since; bake the scene again";

// A range of a buffer that the file speaks of: a buffer view, or what an extension has in its place
// (EXT_meshopt_compression).
bool isRangeOf(const Json& object, std::size_t buffer) {
    return object.is_object() && object.contains("buffer") && whole(object, "buffer") == buffer;
}

template <class Use>
void forEachRange(Json& views, std::size_t buffer, Use use) {
    for (Json& view : views) {
        if (isRangeOf(view, buffer))
            use(view);
        if (const auto extensions = view.find("extensions"); extensions != view.end())
            for (Json& extension : *extensions)
                if (isRangeOf(extension, buffer))
                    use(extension);
    }
}

fs::path bufferName(const fs::path& output, std::size_t index) {
    return fmt::format("{}{}.bin", fileSafeName(output.stem().string(), "scene"),
                       index == 0 ? "" : fmt::format("-{}", index));
}

} // namespace

struct MappedGltf::Reader {
    explicit Reader(MappedGltf& to)
        : file(to) {}

    void read(const Bytes& bytes) {
        if (file.m_isBinary) {
            const gltf::GlbChunks chunks = gltf::chunksOf(bytes);
            file.m_root = gltf::parse(chunks.json);
            const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(chunks.binary);
            binary.assign(from, from + static_cast<std::ptrdiff_t>(chunks.binaryLength));
            file.m_otherChunks.assign(bytes.begin() + static_cast<std::ptrdiff_t>(chunks.end),
                                      bytes.end());
        } else {
            file.m_root = gltf::parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
        readBuffers();
        const Json& map = member(member(file.m_root, "extras"), "patinaLightMap");
        file.m_radiance = gltf::besideName(map.value("radiance", std::string()));
        file.m_image = findImage(whole(map, "texCoord", 1));
        readPicture();
    }

    void readBuffers() {
        for (const Json& buffer : member(file.m_root, "buffers")) {
            const bool isInside =
                file.m_isBinary && file.m_buffers.empty() && member(buffer, "uri").is_null();
            Bytes bytes;
            if (isInside) {
                bytes = std::move(binary);
            } else if (member(buffer, "uri").is_null()) {
                file.m_buffers.emplace_back(); // of an extension, which stores nothing in it
                continue;
            } else {
                const fs::path name = fileOf(buffer.value("uri", std::string()));
                Result<Bytes> loaded =
                    readFile(file.m_file.parent_path() / name, limits::kMaxModelFileBytes);
                if (!loaded)
                    throw Broken(loaded.error().text());
                bytes = *std::move(loaded);
            }
            // Chunks are padded, files may be.
            const std::size_t length = whole(buffer, "byteLength");
            if (length > bytes.size())
                throw Broken("it ends before its data do");
            bytes.resize(length);
            file.m_buffers.push_back(std::move(bytes));
        }
    }

    // That of the emissive textures with the light map's coordinates.
    [[nodiscard]] std::size_t findImage(std::size_t texCoord) const {
        std::set<std::size_t> found, named;
        for (const Json& material : member(file.m_root, "materials")) {
            const Json& emissive = member(material, "emissiveTexture");
            if (!emissive.is_object() || whole(emissive, "texCoord", 0) != texCoord)
                continue;
            const Json& texture = at(file.m_root, "textures", whole(emissive, "index"));
            for (const auto& [name, extension] : member(texture, "extensions").items())
                if (extension.is_object() && extension.contains("source"))
                    throw Broken(
                        fmt::format("its light map is a picture of {:.40}: {}", name, kMapChanged));
            const std::size_t index = whole(texture, "source");
            const Json& image = at(file.m_root, "images", index);
            found.insert(index);
            for (const char* key : {"name", "uri"})
                if (member(image, key).is_string() &&
                    image.value(key, std::string()).find(kLightMapName) != std::string::npos)
                    named.insert(index);
        }
        if (found.size() > 1) // materials that other programs have added
            found = std::move(named);
        if (found.size() != 1)
            throw Broken(
                std::string("its materials do not show one light map as their emission: ") +
                kMapChanged);
        return *found.begin();
    }

    void readPicture() {
        std::size_t index = 0;
        for (const Json& image : member(file.m_root, "images")) {
            const bool isMap = index++ == file.m_image;
            if (image.contains("uri")) {
                const std::string name = fileOf(image.value("uri", std::string()));
                (isMap ? file.m_pictureFile : file.m_others.emplace_back()) = name;
            } else if (isMap) {
                const Json& view = at(file.m_root, "bufferViews", whole(image, "bufferView"));
                const std::size_t buffer = whole(view, "buffer"),
                                  start = whole(view, "byteOffset", 0),
                                  length = whole(view, "byteLength");
                if (buffer >= file.m_buffers.size() || start > file.m_buffers[buffer].size() ||
                    length > file.m_buffers[buffer].size() - start)
                    throw Broken("its light map's picture is not all there");
                const auto from =
                    file.m_buffers[buffer].begin() + static_cast<std::ptrdiff_t>(start);
                file.m_picture.assign(from, from + static_cast<std::ptrdiff_t>(length));
            }
        }
        if (file.m_pictureFile.empty())
            return;
        // It is written anew: one that is missing is no fault.
        if (Result<Bytes> picture = readFile(file.m_file.parent_path() / file.m_pictureFile,
                                             limits::kMaxModelFileBytes))
            file.m_picture = *std::move(picture);
    }

    MappedGltf& file;
    Bytes binary;
};

Result<MappedGltf> MappedGltf::read(const fs::path& path) {
    const Result<Bytes> bytes = readFile(path, limits::kMaxModelFileBytes);
    if (!bytes)
        return bytes.error();
    MappedGltf result;
    result.m_file = path;
    result.m_isBinary = gltf::isGlb(*bytes);
    try {
        Reader(result).read(*bytes);
    } catch (const Broken& broken) {
        return Error{ErrorKind::InputBroken, broken.what(), path, {}};
    } catch (const Json::exception& fault) {
        return Error{ErrorKind::InputBroken, gltf::kNotAsSpecified, path, fault.what()};
    }
    return result;
}

// What follows the picture moves as a whole, by a multiple of the four bytes that numbers are
// aligned to.
void MappedGltf::replaceInBuffer(const Bytes& picture) {
    Json& views = m_root["bufferViews"];
    const std::size_t own = whole(at(m_root, "images", m_image), "bufferView");
    const std::size_t index = whole(views[own], "buffer"),
                      start = whole(views[own], "byteOffset", 0),
                      end = start + whole(views[own], "byteLength");
    Bytes& buffer = m_buffers[index];
    std::size_t next = buffer.size(); // where the first of what follows begins
    forEachRange(views, index, [&](const Json& range) {
        if (&range == &views[own])
            return;
        const std::size_t from = whole(range, "byteOffset", 0);
        if (from >= end)
            next = std::min(next, from);
        else if (from + whole(range, "byteLength", 0) > start)
            throw Broken(std::string("its light map's picture shares bytes with other data: ") +
                         kMapChanged);
    });
    // Bytes between are padding, unless there are too many of them.
    if (next - end >= 4)
        next = end;
    std::size_t moved = start + picture.size();
    if (next < buffer.size())
        while (moved % 4 != next % 4)
            ++moved;
    Bytes changed(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(start));
    changed.insert(changed.end(), picture.begin(), picture.end());
    changed.resize(moved, std::byte{0});
    changed.insert(changed.end(), buffer.begin() + static_cast<std::ptrdiff_t>(next), buffer.end());
    forEachRange(views, index, [&](Json& range) {
        if (const std::size_t from = whole(range, "byteOffset", 0);
            &range != &views[own] && from >= next)
            range["byteOffset"] = from - next + moved;
    });
    views[own]["byteLength"] = picture.size();
    m_root["buffers"][index]["byteLength"] = changed.size();
    buffer = std::move(changed);
}

Result<void> MappedGltf::addFiles(const fs::path& output, const MapNames& names, Bytes picture,
                                  double k, FilesTogether& files,
                                  std::vector<std::string>& notices) && {
    const bool inPlace = isSameFile(m_file, output), isInBuffer = m_pictureFile.empty();
    try {
        Json& map = m_root["extras"]["patinaLightMap"];
        map["radiance"] = names.radiance;
        map["exposure"] = k > 0.0 ? Json(k) : Json();
        Json& image = m_root["images"][m_image];
        if (isInBuffer || image.contains("mimeType"))
            image["mimeType"] = "image/png";
        if (isInBuffer) {
            replaceInBuffer(picture);
        } else if (names.picture != m_pictureFile) {
            if (std::ranges::find(m_others, names.picture) != m_others.end())
                throw Broken(fmt::format("its picture \"{}\" has the name that its light map "
                                         "would get; name the output otherwise",
                                         names.picture));
            image["uri"] = names.picture;
            if (const fs::path old = m_pictureFile;
                member(image, "name").is_string() &&
                image.value("name", std::string()) == old.stem().string())
                image["name"] = fs::path(names.picture).stem().string();
        }
        gltf::addPictures(m_file, output, m_others, files, notices);
        if (!isInBuffer)
            files.add(output.parent_path() / names.picture, std::move(picture));

        Bytes binary;
        for (std::size_t i = 0; i < m_buffers.size(); ++i) {
            Json& buffer = m_root["buffers"][i];
            if (m_isBinary && i == 0 && member(buffer, "uri").is_null()) {
                binary = std::move(m_buffers[i]);
                continue;
            }
            if (member(buffer, "uri").is_null() || (inPlace && !isInBuffer))
                continue;
            fs::path name = fileOf(buffer.value("uri", std::string()));
            if (!inPlace) {
                name = bufferName(output, i);
                buffer["uri"] = name.string();
            }
            files.add(output.parent_path() / name, std::move(m_buffers[i]));
        }
        if (!m_isBinary) {
            const std::string text = m_root.dump(2);
            const auto bytes = std::as_bytes(std::span(text));
            files.add(output, Bytes(bytes.begin(), bytes.end()));
            return {};
        }
        const bool hasBinary = !binary.empty();
        Bytes glb = packGlb({m_root.dump(), std::move(binary)});
        if (!hasBinary) // a chunk of nothing is left out
            glb.resize(glb.size() - 8);
        glb.insert(glb.end(), m_otherChunks.begin(), m_otherChunks.end());
        if (glb.size() > kMostGlbBytes)
            return Error{ErrorKind::Usage,
                         "it would be larger than the 4 GiB that a .glb can hold; write it as "
                         ".gltf, and expose that anew",
                         output,
                         {}};
        const auto length = static_cast<std::uint32_t>(glb.size());
        for (std::size_t i = 0; i < 4; ++i)
            glb[8 + i] = static_cast<std::byte>(length >> (8 * i));
        files.add(output, std::move(glb));
        return {};
    } catch (const Broken& broken) {
        return Error{ErrorKind::InputBroken, broken.what(), m_file, {}};
    } catch (const Json::exception& fault) {
        return Error{ErrorKind::InputBroken, gltf::kNotAsSpecified, m_file, fault.what()};
    }
}

} // namespace patina
