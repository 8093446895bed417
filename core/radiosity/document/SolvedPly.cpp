#include "core/base/Limits.h"
#include "core/math/Shading.h"
#include "core/radiosity/document/SolvedFiles.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace patina {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as memory has them");

struct BrokenPly : std::runtime_error {
    using std::runtime_error::runtime_error;
};

constexpr const char* kNoLight = "it holds no light (radiance_r, _g and _b of its vertices); bake "
                                 "the scene into it first";

std::size_t sizeOf(std::string_view type) {
    static const std::map<std::string_view, std::size_t> kSizes{
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = kSizes.find(type);
    if (found == kSizes.end())
        throw BrokenPly(fmt::format("its header has the type \"{:.20}\"", type));
    return found->second;
}

struct Property {
    std::string name, type, countType; // the last of lists
    std::size_t offset = 0;
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

} // namespace

struct SolvedPly::Reader {
    explicit Reader(SolvedPly& to)
        : file(to) {}

    void read() {
        readHeader();
        const auto vertices = std::ranges::find(elements, "vertex", &Element::name);
        if (elements.empty() || vertices != elements.begin())
            throw BrokenPly("its vertices do not come first; bake the scene again");
        for (Property& property : elements[0].properties) {
            if (!property.countType.empty())
                throw BrokenPly("its vertices have lists; bake the scene again");
            property.offset = file.m_stride;
            file.m_stride += sizeOf(property.type);
        }
        const std::size_t available = file.m_file.size() - file.m_firstVertex;
        if (file.m_stride == 0 || elements[0].count == 0 ||
            elements[0].count > available / file.m_stride)
            throw BrokenPly("it ends before its vertices do");
        readVertices();
        if (elements.size() > 1 && elements[1].name == "face" && !elements[1].properties.empty())
            readFaces();
    }

    void readHeader() {
        const std::string_view text(reinterpret_cast<const char*>(file.m_file.data()),
                                    std::min<std::size_t>(file.m_file.size(), 1 << 16));
        constexpr std::string_view kEnd = "end_header\n";
        const std::size_t end = text.find(kEnd);
        if (!text.starts_with("ply\n") || end == std::string_view::npos)
            throw BrokenPly("it is no PLY file");
        file.m_firstVertex = end + kEnd.size();
        std::istringstream lines{std::string(text.substr(0, end))};
        bool littleEndian = false;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string kind;
            words >> kind;
            if (kind == "format") {
                std::string format;
                words >> format;
                littleEndian = format == "binary_little_endian";
            } else if (kind == "element") {
                Element& element = elements.emplace_back();
                words >> element.name >> element.count;
                if (!words)
                    throw BrokenPly("its header is damaged");
            } else if (kind == "property") {
                if (elements.empty())
                    throw BrokenPly("its header is damaged");
                Property property;
                words >> property.type;
                if (property.type == "list")
                    words >> property.countType >> property.type;
                words >> property.name;
                elements.back().properties.push_back(std::move(property));
            }
        }
        if (!littleEndian)
            throw BrokenPly("it is no binary, little-endian PLY, as Patina writes it");
    }

    [[nodiscard]] std::size_t offsetOf(const char* name, std::string_view type,
                                       std::string_view alsoType, const char* problem) const {
        const std::vector<Property>& properties = elements[0].properties;
        const auto found = std::ranges::find(properties, name, &Property::name);
        if (found == properties.end() || (found->type != type && found->type != alsoType))
            throw BrokenPly(problem);
        return found->offset;
    }

    template <class Number>
    [[nodiscard]] Number numberAt(std::size_t offset) const {
        Number result{};
        std::memcpy(&result, file.m_file.data() + offset, sizeof result);
        return result;
    }

    [[nodiscard]] glm::vec3 vectorOf(std::size_t vertex,
                                     const std::array<std::size_t, 3>& offsets) const {
        glm::vec3 result;
        for (std::size_t c = 0; c < 3; ++c)
            result[static_cast<glm::length_t>(c)] =
                numberAt<float>(file.m_firstVertex + vertex * file.m_stride + offsets[c]);
        if (!std::isfinite(result.x + result.y + result.z))
            throw BrokenPly("one of its numbers is not finite");
        return result;
    }

    void readVertices() {
        std::array<std::size_t, 3> radiance{}, place{};
        for (std::size_t c = 0; c < 3; ++c) {
            constexpr std::array kLight{"radiance_r", "radiance_g", "radiance_b"};
            constexpr std::array kColors{"red", "green", "blue"};
            constexpr std::array kPlace{"x", "y", "z"};
            radiance[c] = offsetOf(kLight[c], "float", "float32", kNoLight);
            file.m_colors[c] = offsetOf(kColors[c], "uchar", "uint8",
                                        "it has no colours as bytes; bake the scene "
                                        "again");
            place[c] = offsetOf(kPlace[c], "float", "float32", "it has no positions as floats");
        }
        ShownLight& light = file.m_lights.emplace_back();
        for (std::size_t v = 0; v < elements[0].count; ++v) {
            light.radiance.push_back(vectorOf(v, radiance));
            positions.emplace_back(vectorOf(v, place));
        }
        light.areas.assign(elements[0].count, 0.0);
    }

    void readFaces() {
        std::size_t at = file.m_firstVertex + elements[0].count * file.m_stride;
        const auto take = [&](std::string_view type) -> std::uint64_t {
            const std::size_t size = sizeOf(type);
            if (size > file.m_file.size() - at)
                throw BrokenPly("it ends before its faces do");
            std::uint64_t value = 0;
            std::memcpy(&value, file.m_file.data() + at, size);
            at += size;
            return value;
        };
        std::vector<std::uint64_t> corners;
        for (std::size_t f = 0; f < elements[1].count; ++f)
            for (const Property& property : elements[1].properties) {
                const bool isList = !property.countType.empty();
                const std::uint64_t count = isList ? take(property.countType) : 1;
                corners.clear();
                for (std::uint64_t i = 0; i < count; ++i)
                    corners.push_back(take(property.type));
                if (isList &&
                    (property.name == "vertex_indices" || property.name == "vertex_index"))
                    addAreas(corners);
            }
    }

    void addAreas(const std::vector<std::uint64_t>& corners) {
        for (const std::uint64_t corner : corners)
            if (corner >= positions.size())
                throw BrokenPly("one of its faces has a corner beyond the vertices");
        for (std::size_t k = 2; k < corners.size(); ++k) {
            const glm::dvec3 &a = positions[corners[0]], &b = positions[corners[k - 1]],
                             &c = positions[corners[k]];
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            for (const std::uint64_t corner : {corners[0], corners[k - 1], corners[k]})
                file.m_lights[0].areas[corner] += area / 3.0;
        }
    }

    SolvedPly& file;
    std::vector<Element> elements;
    std::vector<glm::dvec3> positions;
};

Result<SolvedPly> SolvedPly::read(const std::filesystem::path& path) {
    SolvedPly result;
    Result<Bytes> bytes = readFile(path, limits::kMaxModelFileBytes);
    if (!bytes)
        return bytes.error();
    result.m_file = std::move(*bytes);
    try {
        Reader(result).read();
    } catch (const BrokenPly& broken) {
        return Error{ErrorKind::InputBroken, broken.what(), path, {}};
    }
    return result;
}

void SolvedPly::setColors(const ShownColors& colors) {
    for (std::size_t v = 0; v < colors[0].size(); ++v)
        for (std::size_t c = 0; c < 3; ++c)
            m_file[m_firstVertex + v * m_stride + m_colors[c]] = static_cast<std::byte>(std::lround(
                255.0f * shading::srgbEncode(colors[0][v][static_cast<glm::length_t>(c)])));
}

void SolvedPly::addFiles(const std::filesystem::path& output, FilesTogether& files,
                         std::vector<std::string>&) && {
    files.add(output, std::move(m_file));
}

} // namespace patina
