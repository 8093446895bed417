#include "tests/core/worker/FbxWriter.h"

#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace patina::test {

namespace {

template <class... Ts>
struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

void writeText(const FbxNode& node, std::string& out, int depth) {
    const std::string indent(static_cast<std::size_t>(depth), '\t');
    out += indent + node.name + ": ";
    std::string separator;
    for (const FbxProperty& property : node.properties) {
        out += separator;
        separator = ", ";
        std::visit(Overloaded{[&](std::int32_t v) { out += fmt::format("{}", v); },
                              [&](std::int64_t v) { out += fmt::format("{}", v); },
                              [&](double v) { out += fmt::format("{}", v); },
                              [&](const std::string& v) {
                                  const std::size_t at = v.find("::");
                                  out += at == std::string::npos
                                             ? fmt::format("\"{}\"", v)
                                             : fmt::format("\"{}::{}\"", v.substr(at + 2),
                                                           v.substr(0, at));
                              },
                              [&](const auto& array) {
                                  out += fmt::format("*{} {{\n{}\ta: {}\n{}}}", array.size(),
                                                     indent, fmt::join(array, ","), indent);
                              }},
                   property);
    }
    if (!node.children.empty() || node.properties.empty()) {
        out += " {\n";
        for (const FbxNode& child : node.children)
            writeText(child, out, depth + 1);
        out += indent + "}";
    }
    out += '\n';
}

template <class T>
void put(std::string& out, T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
}

template <class T>
void putArray(std::string& out, char type, const std::vector<T>& values) {
    out += type;
    put(out, static_cast<std::uint32_t>(values.size()));
    put(out, std::uint32_t{0}); // not compressed
    put(out, static_cast<std::uint32_t>(values.size() * sizeof(T)));
    for (const T value : values)
        put(out, value);
}

void writeBinary(const FbxNode& node, std::string& out) {
    std::string properties;
    for (const FbxProperty& property : node.properties)
        std::visit(
            Overloaded{[&](std::int32_t v) {
                           properties += 'I';
                           put(properties, v);
                       },
                       [&](std::int64_t v) {
                           properties += 'L';
                           put(properties, v);
                       },
                       [&](double v) {
                           properties += 'D';
                           put(properties, v);
                       },
                       [&](const std::string& v) {
                           std::string text = v;
                           if (const std::size_t at = v.find("::"); at != std::string::npos)
                               text.replace(at, 2, std::string("\0\1", 2));
                           properties += 'S';
                           put(properties, static_cast<std::uint32_t>(text.size()));
                           properties += text;
                       },
                       [&](const std::vector<double>& v) { putArray(properties, 'd', v); },
                       [&](const std::vector<std::int32_t>& v) { putArray(properties, 'i', v); }},
            property);
    const std::size_t start = out.size();
    put(out, std::uint32_t{0}); // the end, below
    put(out, static_cast<std::uint32_t>(node.properties.size()));
    put(out, static_cast<std::uint32_t>(properties.size()));
    out += static_cast<char>(node.name.size());
    out += node.name + properties;
    if (!node.children.empty()) {
        for (const FbxNode& child : node.children)
            writeBinary(child, out);
        out.append(13, '\0');
    }
    const auto end = static_cast<std::uint32_t>(out.size());
    std::memcpy(out.data() + start, &end, sizeof end);
}

FbxNode p(const std::string& name, const std::string& type, std::vector<FbxProperty> values) {
    FbxNode node{"P", {name, type, std::string(), std::string()}, {}};
    node.properties.insert(node.properties.end(), values.begin(), values.end());
    return node;
}

FbxNode leaf(const std::string& name, FbxProperty value) {
    return {name, {std::move(value)}, {}};
}

} // namespace

std::string writeFbxText(const std::vector<FbxNode>& document) {
    std::string out = "; FBX 7.4.0 project file\n";
    for (const FbxNode& node : document)
        writeText(node, out, 0);
    return out;
}

std::string writeFbxBinary(const std::vector<FbxNode>& document) {
    std::string out("Kaydara FBX Binary  \0\x1a\0", 23);
    put(out, std::uint32_t{7400});
    for (const FbxNode& node : document)
        writeBinary(node, out);
    out.append(13, '\0');
    out.append(160, '\0'); // the footer, which readers skip
    return out;
}

std::vector<FbxNode> fbxQuad(const FbxScene& scene) {
    using Text = std::string;
    const std::int64_t geometryId = 1001;
    const std::int64_t modelId = 1002;
    const std::int64_t materialId = 1003;
    const std::int64_t textureId = 1004;
    const double s = scene.size;

    const FbxNode settings{
        "Properties70",
        {},
        {p("UpAxis", "int", {scene.upAxis}), p("UpAxisSign", "int", {scene.upSign}),
         p("FrontAxis", "int", {scene.frontAxis}), p("FrontAxisSign", "int", {scene.frontSign}),
         p("CoordAxis", "int", {scene.coordAxis}), p("CoordAxisSign", "int", {scene.coordSign}),
         p("UnitScaleFactor", "double", {scene.unitScaleFactor})}};
    const FbxNode uvs{"LayerElementUV",
                      {std::int32_t{0}},
                      {leaf("Version", std::int32_t{101}), leaf("Name", Text("map1")),
                       leaf("MappingInformationType", Text("ByPolygonVertex")),
                       leaf("ReferenceInformationType", Text("IndexToDirect")),
                       leaf("UV", std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1}),
                       leaf("UVIndex", std::vector<std::int32_t>{0, 1, 2, 3})}};
    const FbxNode materials{"LayerElementMaterial",
                            {std::int32_t{0}},
                            {leaf("Version", std::int32_t{101}), leaf("Name", Text()),
                             leaf("MappingInformationType", Text("AllSame")),
                             leaf("ReferenceInformationType", Text("IndexToDirect")),
                             leaf("Materials", std::vector<std::int32_t>{0})}};
    const FbxNode geometry{
        "Geometry",
        {geometryId, Text("quad::Geometry"), Text("Mesh")},
        {leaf("Vertices", std::vector<double>{0, 0, 0, s, 0, 0, s, s, 0, 0, s, 0}),
         leaf("PolygonVertexIndex", std::vector<std::int32_t>{0, 1, 2, -4}),
         leaf("GeometryVersion", std::int32_t{124}),
         uvs,
         materials,
         {"Layer",
          {std::int32_t{0}},
          {leaf("Version", std::int32_t{100}),
           {"LayerElement",
            {},
            {leaf("Type", Text("LayerElementUV")), leaf("TypedIndex", std::int32_t{0})}},
           {"LayerElement",
            {},
            {leaf("Type", Text("LayerElementMaterial")), leaf("TypedIndex", std::int32_t{0})}}}}}};
    const FbxNode model{
        "Model",
        {modelId, Text("plank::Model"), Text("Mesh")},
        {leaf("Version", std::int32_t{232}),
         {"Properties70",
          {},
          {p("Lcl Translation", "Lcl Translation",
             {scene.translation[0], scene.translation[1], scene.translation[2]})}}}};
    const FbxNode material{"Material",
                           {materialId, Text("oak::Material"), Text()},
                           {leaf("Version", std::int32_t{102}),
                            leaf("ShadingModel", Text("phong")),
                            leaf("MultiLayer", std::int32_t{0}),
                            {"Properties70",
                             {},
                             {p("DiffuseColor", "Color", {0.25, 0.5, 0.75}),
                              p("ShininessExponent", "Number", {30.0})}}}};
    const FbxNode texture{"Texture",
                          {textureId, Text("wood::Texture"), Text()},
                          {leaf("Type", Text("TextureVideoClip")),
                           leaf("Version", std::int32_t{202}),
                           leaf("TextureName", Text("wood::Texture")),
                           leaf("FileName", Text("C:\\art\\Wood.PNG")),
                           leaf("RelativeFilename", Text("..\\art\\Wood.PNG")),
                           {"ModelUVTranslation", {0.0, 0.0}, {}},
                           {"ModelUVScaling", {2.0, 2.0}, {}}}};
    const std::int64_t root = 0;
    return {
        {"FBXHeaderExtension",
         {},
         {leaf("FBXHeaderVersion", std::int32_t{1003}), leaf("FBXVersion", std::int32_t{7400})}},
        {"GlobalSettings", {}, {leaf("Version", std::int32_t{1000}), settings}},
        {"Objects", {}, {geometry, model, material, texture}},
        {"Connections",
         {},
         {{"C", {Text("OO"), modelId, root}, {}},
          {"C", {Text("OO"), geometryId, modelId}, {}},
          {"C", {Text("OO"), materialId, modelId}, {}},
          {"C", {Text("OP"), textureId, materialId, Text("DiffuseColor")}, {}}}}};
}

} // namespace patina::test
