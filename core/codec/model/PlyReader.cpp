#include "core/codec/model/PlyReader.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/TokenReader.h"
#include "core/codec/model/Polygon.h"
#include "core/material/Material.h"
#include "core/mesh/MeshSource.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace patina::codec {

namespace {

[[noreturn]] void refusePly(const std::string& detail) {
    throw Refusal("the file is damaged or cut short; export or download it again",
                  "ply: " + detail);
}

enum class Type { I8, U8, I16, U16, I32, U32, F32, F64 };

Type typeNamed(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Type>, 16> kNames{
        {{"char", Type::I8},
         {"int8", Type::I8},
         {"uchar", Type::U8},
         {"uint8", Type::U8},
         {"short", Type::I16},
         {"int16", Type::I16},
         {"ushort", Type::U16},
         {"uint16", Type::U16},
         {"int", Type::I32},
         {"int32", Type::I32},
         {"uint", Type::U32},
         {"uint32", Type::U32},
         {"float", Type::F32},
         {"float32", Type::F32},
         {"double", Type::F64},
         {"float64", Type::F64}}};
    for (const auto& [known, type] : kNames)
        if (known == name)
            return type;
    refusePly(fmt::format("unknown type \"{}\"", name));
}

struct Property {
    std::string name;
    Type type = Type::F32;
    std::optional<Type> listCount; // a list when set
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;

    [[nodiscard]] int find(std::initializer_list<std::string_view> names) const {
        for (std::size_t i = 0; i < properties.size(); ++i)
            for (const std::string_view wanted : names)
                if (properties[i].name == wanted)
                    return static_cast<int>(i);
        return -1;
    }
};

enum class Encoding { Text, LittleEndian, BigEndian };

struct Header {
    Encoding encoding = Encoding::Text;
    std::vector<Element> elements;
    std::vector<std::string> textures;
};

// The values after the header, in either encoding.
class Values {
  public:
    Values(std::string_view data, Encoding encoding)
        : m_data(data)
        , m_text(data)
        , m_encoding(encoding) {}

    double next(Type type) {
        if (m_encoding == Encoding::Text) {
            const auto value = m_text.number();
            if (!value)
                refusePly("a number is missing");
            return *value;
        }
        switch (type) {
        case Type::I8:
            return take<std::int8_t>();
        case Type::U8:
            return take<std::uint8_t>();
        case Type::I16:
            return take<std::int16_t>();
        case Type::U16:
            return take<std::uint16_t>();
        case Type::I32:
            return take<std::int32_t>();
        case Type::U32:
            return take<std::uint32_t>();
        case Type::F32:
            return static_cast<double>(take<float>());
        case Type::F64:
            break;
        }
        return take<double>();
    }
    // Every value takes a byte at least: no count can be larger.
    [[nodiscard]] std::size_t bytesLeft() const {
        return m_encoding == Encoding::Text ? m_text.rest().size() : m_data.size();
    }

  private:
    template <class T>
    T take() {
        std::array<char, sizeof(T)> bytes{};
        if (m_data.size() < bytes.size())
            refusePly("the values end early");
        std::memcpy(bytes.data(), m_data.data(), bytes.size());
        m_data.remove_prefix(bytes.size());
        const bool littleHere = std::endian::native == std::endian::little;
        if (littleHere != (m_encoding == Encoding::LittleEndian))
            std::reverse(bytes.begin(), bytes.end());
        return std::bit_cast<T>(bytes);
    }

    std::string_view m_data;
    TokenReader m_text;
    Encoding m_encoding;
};

Header readHeader(TokenReader& reader) {
    Header header;
    if (reader.line() != "ply")
        throw Refusal("this is no PLY file, or it is damaged");
    constexpr int kMostLines = 10000;
    for (int i = 0; i < kMostLines; ++i) {
        if (reader.rest().empty())
            refusePly("the header ends early");
        TokenReader line(reader.line());
        const std::string_view key = line.word();
        if (key == "end_header")
            return header;
        if (key == "format") {
            const std::string_view name = line.word();
            if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
                refusePly("unknown format");
            header.encoding = name == "ascii"                  ? Encoding::Text
                              : name == "binary_little_endian" ? Encoding::LittleEndian
                                                               : Encoding::BigEndian;
        } else if (key == "comment") {
            if (line.word() == "TextureFile") {
                const std::string_view name = line.line();
                header.textures.emplace_back(
                    name.substr(std::min(name.find_first_not_of(' '), name.size())));
            }
        } else if (key == "element") {
            Element element;
            element.name = line.word();
            const auto count = line.number();
            if (!count || !(*count >= 0.0 && *count < 1e12))
                refusePly("an element without a count");
            element.count = static_cast<std::size_t>(*count);
            header.elements.push_back(std::move(element));
        } else if (key == "property") {
            if (header.elements.empty())
                refusePly("a property without an element");
            Property property;
            std::string_view type = line.word();
            if (type == "list") {
                property.listCount = typeNamed(line.word());
                type = line.word();
            }
            property.type = typeNamed(type);
            property.name = line.word();
            header.elements.back().properties.push_back(std::move(property));
        }
    }
    refusePly("the header does not end");
}

// A list property that is read: where it stands in its element (-1: nowhere), and its values.
struct List {
    int property = -1;
    std::vector<double> values = {};
};

// Reads one item of an element: scalars into `scalars`, and the wanted lists.
void readItem(const Element& element, Values& values, std::vector<double>& scalars,
              std::span<List> lists) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (!property.listCount) {
            scalars[p] = values.next(property.type);
            continue;
        }
        const double count = values.next(*property.listCount);
        if (!(count >= 0.0 && count <= static_cast<double>(values.bytesLeft())))
            refusePly("a list is longer than the file");
        const auto wanted = std::find_if(lists.begin(), lists.end(), [&](const List& list) {
            return list.property == static_cast<int>(p);
        });
        if (wanted != lists.end())
            wanted->values.clear();
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const double value = values.next(property.type);
            if (wanted != lists.end())
                wanted->values.push_back(value);
        }
    }
}

void readVertices(const Element& element, Values& values, Mesh& mesh) {
    const std::array<int, 3> position{element.find({"x"}), element.find({"y"}),
                                      element.find({"z"})};
    const std::array<int, 3> normal{element.find({"nx"}), element.find({"ny"}),
                                    element.find({"nz"})};
    const std::array<int, 2> uv{element.find({"s", "u", "texture_u"}),
                                element.find({"t", "v", "texture_v"})};
    if (position[0] < 0 || position[1] < 0 || position[2] < 0)
        refusePly("vertices without a position");
    const bool hasNormals = normal[0] >= 0 && normal[1] >= 0 && normal[2] >= 0;
    const bool hasUvs = uv[0] >= 0 && uv[1] >= 0;
    std::vector<double> scalars(element.properties.size(), 0.0);
    const auto scalar = [&](int index) {
        return static_cast<float>(scalars[static_cast<std::size_t>(index)]);
    };
    for (std::size_t i = 0; i < element.count; ++i) {
        readItem(element, values, scalars, {});
        mesh.positions.emplace_back(scalar(position[0]), scalar(position[1]), scalar(position[2]));
        if (hasNormals)
            mesh.normals.emplace_back(scalar(normal[0]), scalar(normal[1]), scalar(normal[2]));
        if (hasUvs) // PLY's v points up
            mesh.uvs.emplace_back(scalar(uv[0]), 1.0f - scalar(uv[1]));
    }
}

// An index that is none becomes one that points nowhere: the client drops and counts it.
std::uint32_t indexOf(double value) {
    return value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value)
                                                : ~std::uint32_t{0};
}

void checkTriangles(const std::vector<std::uint32_t>& indices) {
    if (indices.size() > 3 * limits::kMaxTriangles)
        throw Refusal("the model is larger than the supported 50 million triangles");
}

// The faces of a file, until all of its vertices are known: they may come last.
class Faces {
  public:
    void read(const Element& element, Values& values);
    void readStrips(const Element& element, Values& values);
    // Corners with texture coordinates of their own become vertices of their own; `origin` names
    // those of the file that they repeat.
    void takeInto(Mesh& mesh, std::vector<std::uint32_t>& origin);
    [[nodiscard]] std::size_t incomplete() const { return m_incomplete; }

  private:
    // A face of four corners and more, divided as if it were convex.
    struct Polygon {
        std::size_t firstCorner, firstIndex;
    };
    void correctPolygons(const Mesh& mesh);
    void keepUvsInStep();

    std::vector<std::uint32_t> m_indices;
    std::vector<std::uint32_t> m_corners; // of the polygons
    std::vector<Polygon> m_polygons;
    // Of each index and each of m_corners its texture coordinates; empty where no face has any.
    bool m_hasUvs = false;
    std::vector<std::uint32_t> m_uvIndices, m_uvCorners;
    std::vector<glm::vec2> m_uvs;
    std::size_t m_incomplete = 0; // faces without one pair for each corner
};

constexpr std::uint32_t kNoUv = ~std::uint32_t{0};

void Faces::read(const Element& element, Values& values) {
    std::array<List, 2> lists{List{element.find({"vertex_indices", "vertex_index"})},
                              List{element.find({"texcoord", "texcoords"})}};
    const std::vector<double>&corners = lists[0].values, &uvs = lists[1].values;
    const bool hasUvs = lists[1].property >= 0;
    m_hasUvs = m_hasUvs || hasUvs;
    keepUvsInStep();
    std::vector<double> scalars(element.properties.size(), 0.0);
    for (std::size_t i = 0; i < element.count; ++i) {
        readItem(element, values, scalars, lists);
        if (corners.size() < 3)
            continue;
        if (corners.size() > 3) {
            m_polygons.push_back({m_corners.size(), m_indices.size()});
            for (const double corner : corners)
                m_corners.push_back(indexOf(corner));
        }
        std::uint32_t firstUv = kNoUv;
        if (hasUvs && uvs.size() == 2 * corners.size()) {
            firstUv = static_cast<std::uint32_t>(m_uvs.size());
            for (std::size_t k = 0; k < uvs.size(); k += 2) // PLY's v points up
                m_uvs.emplace_back(static_cast<float>(uvs[k]),
                                   1.0f - static_cast<float>(uvs[k + 1]));
        }
        m_incomplete += hasUvs && firstUv == kNoUv ? 1 : 0;
        const auto uv = [&](std::size_t corner) {
            return firstUv == kNoUv ? kNoUv : firstUv + static_cast<std::uint32_t>(corner);
        };
        for (std::size_t k = 2; k < corners.size(); ++k)
            for (const std::size_t corner : {std::size_t{0}, k - 1, k}) {
                m_indices.push_back(indexOf(corners[corner]));
                if (hasUvs)
                    m_uvIndices.push_back(uv(corner));
            }
        if (hasUvs && corners.size() > 3)
            for (std::size_t k = 0; k < corners.size(); ++k)
                m_uvCorners.push_back(uv(k));
        checkTriangles(m_indices);
    }
    keepUvsInStep();
}

// Each list is one or more strips, apart by -1.
void Faces::readStrips(const Element& element, Values& values) {
    std::array<List, 1> lists{List{element.find({"vertex_indices", "vertex_index"})}};
    std::vector<double> scalars(element.properties.size(), 0.0);
    for (std::size_t i = 0; i < element.count; ++i) {
        readItem(element, values, scalars, lists);
        std::size_t begin = 0; // of the strip
        const std::vector<double>& strip = lists[0].values;
        for (std::size_t k = 0; k < strip.size(); ++k) {
            if (strip[k] < 0.0) {
                begin = k + 1;
                continue;
            }
            if (k < begin + 2)
                continue;
            // Every other triangle is turned.
            const std::size_t odd = (k - begin) % 2;
            for (const std::size_t corner : {k - 2, k - 1 + odd, k - odd})
                m_indices.push_back(indexOf(strip[corner]));
            checkTriangles(m_indices);
        }
    }
    keepUvsInStep();
}

// What has been read without coordinates has none.
void Faces::keepUvsInStep() {
    if (!m_hasUvs)
        return;
    m_uvIndices.resize(m_indices.size(), kNoUv);
    m_uvCorners.resize(m_corners.size(), kNoUv);
}

void Faces::correctPolygons(const Mesh& mesh) {
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < m_polygons.size(); ++i) {
        const Polygon& polygon = m_polygons[i];
        const std::size_t end =
            i + 1 < m_polygons.size() ? m_polygons[i + 1].firstCorner : m_corners.size();
        const std::span corners(m_corners.begin() +
                                    static_cast<std::ptrdiff_t>(polygon.firstCorner),
                                end - polygon.firstCorner);
        if (std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t v) { return v >= mesh.positions.size(); }))
            continue;
        points.clear();
        for (const std::uint32_t v : corners)
            points.push_back(mesh.positions[v]);
        // What a polygon has less than a convex one is dropped and counted by the client.
        auto triangles = triangulatePolygon(points);
        triangles.resize(corners.size() - 2, {0, 0, 0});
        std::size_t at = polygon.firstIndex;
        for (const auto& triangle : triangles)
            for (const std::uint32_t corner : triangle) {
                if (!m_uvIndices.empty())
                    m_uvIndices[at] = m_uvCorners[polygon.firstCorner + corner];
                m_indices[at++] = corners[corner];
            }
    }
}

void Faces::takeInto(Mesh& mesh, std::vector<std::uint32_t>& origin) {
    correctPolygons(mesh);
    mesh.indices = std::move(m_indices);
    if (m_uvs.empty()) {
        origin.resize(mesh.positions.size());
        std::iota(origin.begin(), origin.end(), 0u);
        return;
    }
    Mesh apart;
    apart.name = mesh.name;
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t vertex = mesh.indices[i];
        std::uint32_t& index = apart.indices.emplace_back(~std::uint32_t{0});
        if (vertex >= mesh.positions.size())
            continue;
        glm::vec2 uv = m_uvIndices[i] != kNoUv ? m_uvs[m_uvIndices[i]]
                       : mesh.uvs.empty()      ? glm::vec2(0.0f)
                                               : mesh.uvs[vertex];
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) // NaN has no order
            uv = glm::vec2(0.0f);
        const auto [place, isNew] = known.try_emplace(
            {vertex, uv.x, uv.y}, static_cast<std::uint32_t>(apart.positions.size()));
        index = place->second;
        if (!isNew)
            continue;
        apart.positions.push_back(mesh.positions[vertex]);
        if (!mesh.normals.empty())
            apart.normals.push_back(mesh.normals[vertex]);
        apart.uvs.push_back(uv);
        origin.push_back(vertex);
    }
    mesh = std::move(apart);
}

bool hasColors(const Element& element) {
    return element.find({"red", "diffuse_red"}) >= 0;
}

} // namespace

ImportedModel readPly(const ModelFolder& folder) {
    const auto file = folder.open(folder.modelPath());
    if (!file)
        throw Refusal("the file cannot be read");
    TokenReader reader(file->text());
    const Header header = readHeader(reader);
    Values values(reader.rest(), header.encoding);

    Mesh mesh;
    mesh.name = folder.modelPath().stem().string();
    Faces faces;
    bool colors = false;
    for (const Element& element : header.elements) {
        // Elements without properties take no bytes, however many are announced.
        if (element.properties.empty())
            continue;
        if (element.count > values.bytesLeft())
            refusePly("more elements than the file can hold");
        colors = colors || hasColors(element);
        if (element.name == "vertex") {
            readVertices(element, values, mesh);
        } else if (element.name == "face") {
            faces.read(element, values);
        } else if (element.name == "tristrips") {
            faces.readStrips(element, values);
        } else {
            std::vector<double> scalars(element.properties.size(), 0.0);
            for (std::size_t i = 0; i < element.count; ++i)
                readItem(element, values, scalars, {});
        }
    }
    MeshSource source;
    faces.takeInto(mesh, source.vertices);
    if (mesh.indices.empty())
        throw Refusal("the model has no faces; export it with geometry");

    ImportedModel model;
    model.format = "ply";
    ImportedMaterial& material = model.materials.emplace_back();
    material.name = "default";
    if (!header.textures.empty()) {
        material.baseColor = glm::vec4(1.0f);
        material.maps[MaterialInput::BaseColor].emplace().file = header.textures.front();
    }
    if (header.textures.size() > 1)
        model.warnings.push_back(fmt::format("The file has {} textures for parts of its mesh, "
                                             "which is not supported; \"{}\" is used "
                                             "for all of it.",
                                             header.textures.size(), header.textures.front()));
    if (faces.incomplete() > 0)
        model.warnings.push_back(
            fmt::format("{} faces do not have texture coordinates for each of their corners.",
                        faces.incomplete()));
    if (colors)
        model.warnings.emplace_back("Colours of vertices and faces are not read.");
    ImportedInstance& instance = model.instances.emplace_back();
    instance.name = mesh.name;
    model.meshes.push_back(withSource(std::move(mesh), std::move(source)));
    return model;
}

} // namespace patina::codec
