#include "core/codec/model/PlyReader.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/TokenReader.h"
#include "core/material/Material.h"
#include "core/mesh/MeshSource.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

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
    std::string texture;
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
                header.texture = line.line();
                header.texture.erase(
                    0, std::min(header.texture.find_first_not_of(' '), header.texture.size()));
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

// Reads one item of an element: scalars into `scalars`, and the wanted list into `list`.
void readItem(const Element& element, Values& values, std::vector<double>& scalars, int wantedList,
              std::vector<double>& list) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (!property.listCount) {
            scalars[p] = values.next(property.type);
            continue;
        }
        const double count = values.next(*property.listCount);
        if (!(count >= 0.0 && count <= static_cast<double>(values.bytesLeft())))
            refusePly("a list is longer than the file");
        const bool wanted = static_cast<int>(p) == wantedList;
        if (wanted)
            list.clear();
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const double value = values.next(property.type);
            if (wanted)
                list.push_back(value);
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
    std::vector<double> list;
    const auto scalar = [&](int index) {
        return static_cast<float>(scalars[static_cast<std::size_t>(index)]);
    };
    for (std::size_t i = 0; i < element.count; ++i) {
        readItem(element, values, scalars, -1, list);
        mesh.positions.emplace_back(scalar(position[0]), scalar(position[1]), scalar(position[2]));
        if (hasNormals)
            mesh.normals.emplace_back(scalar(normal[0]), scalar(normal[1]), scalar(normal[2]));
        if (hasUvs) // PLY's v points up
            mesh.uvs.emplace_back(scalar(uv[0]), 1.0f - scalar(uv[1]));
    }
}

void readFaces(const Element& element, Values& values, Mesh& mesh) {
    const int list = element.find({"vertex_indices", "vertex_index"});
    std::vector<double> scalars(element.properties.size(), 0.0);
    std::vector<double> corners;
    // An index that is none becomes one that points nowhere: the client drops and counts it.
    const auto index = [&](std::size_t corner) {
        const double value = corners[corner];
        return value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value)
                                                    : ~std::uint32_t{0};
    };
    for (std::size_t i = 0; i < element.count; ++i) {
        corners.clear();
        readItem(element, values, scalars, list, corners);
        for (std::size_t k = 2; k < corners.size(); ++k)
            mesh.indices.insert(mesh.indices.end(), {index(0), index(k - 1), index(k)});
        if (mesh.indices.size() > 3 * limits::kMaxTriangles)
            throw Refusal("the model is larger than the supported 50 million triangles");
    }
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
    for (const Element& element : header.elements) {
        // Elements without properties take no bytes, however many are announced.
        if (element.properties.empty())
            continue;
        if (element.count > values.bytesLeft())
            refusePly("more elements than the file can hold");
        if (element.name == "vertex") {
            readVertices(element, values, mesh);
        } else if (element.name == "face") {
            readFaces(element, values, mesh);
        } else {
            std::vector<double> scalars(element.properties.size(), 0.0);
            std::vector<double> list;
            for (std::size_t i = 0; i < element.count; ++i)
                readItem(element, values, scalars, -1, list);
        }
    }
    if (mesh.indices.empty())
        throw Refusal("the model has no faces; export it with geometry");

    ImportedModel model;
    model.format = "ply";
    ImportedMaterial& material = model.materials.emplace_back();
    material.name = "default";
    if (!header.texture.empty()) {
        material.baseColor = glm::vec4(1.0f);
        material.maps[MaterialInput::BaseColor].emplace().file = header.texture;
    }
    ImportedInstance& instance = model.instances.emplace_back();
    instance.name = mesh.name;
    model.meshes.push_back(withOwnVertices(std::move(mesh), 0));
    return model;
}

} // namespace patina::codec
