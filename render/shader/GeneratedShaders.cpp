#include "render/shader/GeneratedShaders.h"

#include "core/document/Views.h"
#include "core/material/MaterialInputs.h"

#include <array>
#include <cctype>
#include <fmt/format.h>

namespace patina::render {
namespace {

std::string viewNumbers() {
    std::string text;
#define VIEW(kind, ...) text += fmt::format("const int {} = {};\n", #kind, shading::kind);
#define RECORD(kind) text += fmt::format("const int {} = {};\n", #kind, shading::kind);
#include "core/document/ViewTable.inc"
    return text + fmt::format("const int kViewCount = {};\nconst int kRecordCount = {};\n",
                              shading::kViewCount, shading::kRecordCount);
}

// "metallic" of "material.metallic".
std::string_view numberName(const MaterialInputInfo& info) {
    const std::string_view id = info.parameters.value();
    return id.substr(id.rfind('.') + 1);
}

std::string blockMembers() {
    std::string text;
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.number != nullptr)
            text += fmt::format("    float u_{};\n", numberName(info));
    for (const MaterialInputInfo& info : kMaterialInputs)
        text += fmt::format("    Map u_{}Map;\n", info.id);
    return text;
}

std::string maps() {
    std::string text;
    for (const MaterialInputInfo& info : kMaterialInputs)
        text += fmt::format("layout(binding = {}) uniform sampler2D u_{}Texture;\n",
                            mapUnit(info.input), info.id);
    text += "// 1 where there is no map.\nstruct MapNumbers {\n";
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (readsOneChannel(info))
            text += fmt::format("    float {};\n", info.id);
    text += "};\nMapNumbers mapNumbers(vec2 uv) {\n    MapNumbers numbers;\n";
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (readsOneChannel(info))
            text += fmt::format("#ifdef FETCH_{0}\n"
                                "    vec4 {1} = texture(u_{2}Texture, mapUv(u_{2}Map, uv));\n"
                                "#endif\n",
                                inputDefine(info), texelName(info), info.id);
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (readsOneChannel(info))
            text += fmt::format("#ifdef {0}_TEXEL\n"
                                "    numbers.{1} = {0}_TEXEL;\n"
                                "#else\n"
                                "    numbers.{1} = 1.0;\n"
                                "#endif\n",
                                inputDefine(info), info.id);
    return text + "    return numbers;\n}\n";
}

std::string surfaceInputs() {
    std::string set = "void setNumbers(inout SurfaceInputs inputs, MapNumbers map) {\n";
    std::string record = "#ifdef VIEWS\nvoid recordNumbers(SurfaceInputs inputs) {\n";
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.role != InputRole::Number)
            continue;
        const std::string_view name = numberName(info);
        const std::string value = fmt::format("clamp(u_{} * map.{}, 0.0, 1.0)", name, info.id);
        if (info.rare)
            set += fmt::format("#ifdef HAS_{2}\n"
                               "    inputs.{0} = {1};\n"
                               "#else\n"
                               "    inputs.{0} = 0.0;\n"
                               "#endif\n",
                               name, value, inputDefine(info));
        else
            set += fmt::format("    inputs.{} = {};\n", name, value);
        record += fmt::format("    record({}, inputs.{});\n", viewOf(info.input), name);
    }
    return set + "}\n" + record + "}\n#endif\n";
}

} // namespace

std::string inputDefine(const MaterialInputInfo& info) {
    std::string define;
    for (const char c : info.id) {
        if (std::isupper(static_cast<unsigned char>(c)))
            define += '_';
        define += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return define;
}

std::string texelName(const MaterialInputInfo& info) {
    return std::string(info.id) + "Texel";
}

std::optional<std::string> generatedShader(std::string_view name) {
    if (name == "generated/views.glsl")
        return viewNumbers();
    if (name == "generated/input-block.glsl")
        return blockMembers();
    if (name == "generated/inputs.glsl")
        return maps();
    if (name == "generated/surface-inputs.glsl")
        return surfaceInputs();
    return std::nullopt;
}

} // namespace patina::render
