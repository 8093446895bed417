#include "core/base/Limits.h"
#include "core/radiosity/document/GltfParts.h"
#include "core/radiosity/document/SolvedFiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <optional>
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
using gltf::numberAt;
using gltf::whole;

// Values of the glTF and GLB specifications.
constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kTriangles = 4;

} // namespace

struct SolvedGltf::Reader {
    explicit Reader(SolvedGltf& to)
        : file(to) {}

    void read() {
        std::string_view text = file.m_json;
        if (file.m_isBinary)
            text = glbText();
        root = gltf::parse(text);
        if (!file.m_isBinary)
            readBuffers();
        file.m_showsLightMap = gltf::showsLightMap(root);
        std::set<std::size_t> known; // accessors of colours
        for (const Json& mesh : root.value("meshes", Json::array()))
            for (const Json& primitive : mesh.value("primitives", Json::array())) {
                const Json attributes = primitive.value("attributes", Json::object());
                if (attributes.contains("_RADIANCE") &&
                    known.insert(whole(attributes, "COLOR_0")).second)
                    addLight(primitive, attributes);
            }
    }

    // Buffers are offsets into the whole.
    std::string_view glbText() {
        const gltf::GlbChunks chunks = gltf::chunksOf(file.m_buffers[0]);
        binary = chunks.binary;
        binaryLength = chunks.binaryLength;
        return chunks.json;
    }

    void readBuffers() {
        for (const Json& buffer : root.value("buffers", Json::array())) {
            const fs::path name = fileOf(buffer.value("uri", std::string()));
            Result<Bytes> bytes =
                readFile(file.m_file.parent_path() / name, limits::kMaxModelFileBytes);
            if (!bytes)
                throw Broken(bytes.error().text());
            file.m_buffers.push_back(std::move(*bytes));
        }
        for (const Json& image : root.value("images", Json::array()))
            if (image.contains("uri"))
                file.m_pictures.push_back(fileOf(image.value("uri", std::string())));
    }

    // Where an accessor's numbers are, which lie within their buffer.
    Numbers numbers(std::size_t index, std::size_t size, std::size_t components) const {
        const Json& accessor = at(root, "accessors", index);
        if (accessor.contains("sparse"))
            throw Broken("its numbers are sparse; bake the scene again");
        const Json& view = at(root, "bufferViews", whole(accessor, "bufferView"));
        Numbers result;
        result.buffer = whole(view, "buffer");
        result.count = whole(accessor, "count");
        result.components = components;
        result.stride = whole(view, "byteStride", size * components);
        const std::size_t inView = whole(accessor, "byteOffset", 0),
                          start = whole(view, "byteOffset", 0), length = whole(view, "byteLength");
        std::size_t available = 0;
        if (file.m_isBinary) {
            available = result.buffer == 0 ? binaryLength : 0;
        } else if (result.buffer < file.m_buffers.size()) {
            available = file.m_buffers[result.buffer].size();
        }
        // None of them is so large that the sums below would overflow.
        constexpr std::size_t kLargest = std::size_t{1} << 40;
        if (std::max({inView, start, length, result.count, result.stride}) > kLargest ||
            start + length > available || result.count == 0 ||
            (result.count > length / std::max<std::size_t>(result.stride, 1) + 1) ||
            inView + (result.count - 1) * result.stride + size * components > length)
            throw Broken("its numbers are not all there");
        result.offset = (file.m_isBinary ? binary : 0) + start + inView;
        if (file.m_isBinary)
            result.buffer = 0;
        return result;
    }

    Numbers floats(const Json& attributes, const char* name) const {
        const std::size_t index = whole(attributes, name);
        const Json& accessor = at(root, "accessors", index);
        const std::string type = accessor.value("type", std::string());
        if (whole(accessor, "componentType") != kFloat || (type != "VEC3" && type != "VEC4"))
            throw Broken(
                fmt::format("{} is not of floats, as Patina writes it: another program has "
                            "changed it since; bake the scene again",
                            name));
        return numbers(index, sizeof(float), type == "VEC3" ? 3 : 4);
    }

    std::vector<glm::vec3> vectors(const Numbers& from) const {
        std::vector<glm::vec3> result;
        for (std::size_t i = 0; i < from.count; ++i) {
            const glm::vec3 v =
                numberAt<glm::vec3>(file.m_buffers[from.buffer], from.offset + i * from.stride);
            if (!std::isfinite(v.x + v.y + v.z))
                throw Broken("one of its numbers is not finite");
            result.push_back(v);
        }
        return result;
    }

    std::vector<std::uint32_t> indices(const Json& primitive, std::size_t vertices) const {
        std::vector<std::uint32_t> result;
        if (!primitive.contains("indices")) {
            for (std::size_t i = 0; i < vertices; ++i)
                result.push_back(static_cast<std::uint32_t>(i));
            return result;
        }
        const std::size_t index = whole(primitive, "indices");
        const auto type = static_cast<int>(whole(at(root, "accessors", index), "componentType"));
        const std::size_t size = type == kUnsignedByte    ? 1
                                 : type == kUnsignedShort ? 2
                                 : type == kUnsignedInt   ? 4
                                                          : 0;
        if (size == 0)
            throw Broken("its indices are no whole numbers");
        const Numbers from = numbers(index, size, 1);
        for (std::size_t i = 0; i < from.count; ++i) {
            std::uint32_t value = 0; // little-endian, as the file
            std::memcpy(&value, file.m_buffers[from.buffer].data() + from.offset + i * from.stride,
                        size);
            if (value >= vertices)
                throw Broken("one of its indices is beyond the vertices");
            result.push_back(value);
        }
        return result;
    }

    void addLight(const Json& primitive, const Json& attributes) {
        const Numbers colors = floats(attributes, "COLOR_0");
        ShownLight light;
        light.radiance = vectors(floats(
            attributes, attributes.contains("_WHITE_RADIANCE") ? "_WHITE_RADIANCE" : "_RADIANCE"));
        const std::vector<glm::vec3> positions = vectors(floats(attributes, "POSITION"));
        if (colors.count != light.radiance.size() || positions.size() != light.radiance.size())
            throw Broken("its light, colours and positions differ in number; bake the scene again");
        light.areas.assign(positions.size(), 0.0);
        if (whole(primitive, "mode", kTriangles) == kTriangles) {
            const std::vector<std::uint32_t> corners = indices(primitive, positions.size());
            for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
                const glm::dvec3 a(positions[corners[i]]), b(positions[corners[i + 1]]),
                    c(positions[corners[i + 2]]);
                const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
                for (std::size_t k = 0; k < 3; ++k)
                    light.areas[corners[i + k]] += area / 3.0;
            }
        }
        file.m_colors.push_back(colors);
        file.m_lights.push_back(std::move(light));
    }

    SolvedGltf& file;
    Json root;
    std::size_t binary = 0, binaryLength = 0; // of a .glb: where its buffer is
};

Result<SolvedGltf> SolvedGltf::read(const fs::path& path) {
    SolvedGltf result;
    result.m_file = path;
    Result<Bytes> bytes = readFile(path, limits::kMaxModelFileBytes);
    if (!bytes)
        return bytes.error();
    result.m_isBinary = gltf::isGlb(*bytes);
    if (result.m_isBinary)
        result.m_buffers.push_back(std::move(*bytes));
    else
        result.m_json.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    try {
        Reader(result).read();
    } catch (const Broken& broken) {
        return Error{ErrorKind::InputBroken, broken.what(), path, {}};
    } catch (const Json::exception& wrong) {
        return Error{ErrorKind::InputBroken, "its JSON is not as glTF has it", path, wrong.what()};
    }
    return result;
}

void SolvedGltf::setColors(const ShownColors& colors) {
    for (std::size_t i = 0; i < m_colors.size(); ++i)
        for (std::size_t v = 0; v < m_colors[i].count; ++v)
            std::memcpy(m_buffers[m_colors[i].buffer].data() + m_colors[i].offset +
                            v * m_colors[i].stride,
                        &colors[i][v], sizeof(glm::vec3));
}

void SolvedGltf::addFiles(const fs::path& output, FilesTogether& files,
                          std::vector<std::string>& notices) && {
    if (m_isBinary) {
        files.add(output, std::move(m_buffers[0]));
        return;
    }
    Json root = Json::parse(m_json);
    for (std::size_t i = 0; i < m_buffers.size(); ++i) {
        fs::path buffer = output;
        buffer.replace_filename(
            fmt::format("{}{}.bin", output.stem().string(), i == 0 ? "" : fmt::format("-{}", i)));
        files.add(buffer, std::move(m_buffers[i]));
        root["buffers"][i]["uri"] = buffer.filename().string();
    }
    gltf::addPictures(m_file, output, m_pictures, files, notices);
    const std::string text = root.dump(2);
    const auto bytes = std::as_bytes(std::span(text));
    files.add(output, Bytes(bytes.begin(), bytes.end()));
}

} // namespace patina
