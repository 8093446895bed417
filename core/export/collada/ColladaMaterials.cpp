#include "core/export/collada/ColladaMaterials.h"

#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace patina::collada {
namespace {

// What an effect's parts are looked up in.
struct EffectParts {
    xml_node effect, profile, shading; // shading: lambert, phong, blinn or constant
};

EffectParts effectOf(const Tree& tree, xml_node material) {
    const xml_node instance = material.child("instance_effect");
    if (!instance)
        throw Fault(
            fmt::format("{} has no <instance_effect>; export the scene again", describe(material)));
    EffectParts parts;
    parts.effect = tree.resolve(instance.attribute("url").value(), {"effect"}, instance);
    parts.profile = parts.effect.child("profile_COMMON");
    const xml_node technique = parts.profile.child("technique");
    for (const char* name : {"lambert", "phong", "blinn", "constant"})
        if (!parts.shading)
            parts.shading = technique.child(name);
    return parts;
}

xml_node parameter(const EffectParts& parts, std::string_view sid) {
    for (const xml_node& scope : {parts.profile.child("technique"), parts.profile, parts.effect})
        for (const xml_node& child : scope.children("newparam"))
            if (child.attribute("sid").value() == sid)
                return child;
    return {};
}

int hexDigit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// 1.4: the text of <init_from>; 1.5: its <ref>.
std::string fileOf(xml_node image) {
    const xml_node source = image.child("init_from");
    const xml_node reference = source.child("ref");
    const std::string uri = trimmed(textOf(reference ? reference : source));
    if (uri.empty())
        throw Fault(fmt::format("{} names no file (pictures inside the document are not read); "
                                "export the scene with its textures beside it",
                                describe(image)));
    return fileNameOf(uri);
}

// A <texture> names a sampler; that names a surface (1.4) or an image (1.5); the surface an image.
// Several exporters name the image at once.
std::string textureFile(const Tree& tree, const EffectParts& parts, xml_node texture) {
    const std::string sampler = texture.attribute("texture").value();
    const auto image = [&](const std::string& id) { return tree.find(id, {"image"}); };
    const xml_node sampled = parameter(parts, sampler).child("sampler2D");
    if (const xml_node instance = sampled.child("instance_image"))
        return fileOf(tree.resolve(instance.attribute("url").value(), {"image"}, instance));
    if (sampled.child("source")) {
        const std::string sid = trimmed(textOf(sampled.child("source")));
        const xml_node surface = parameter(parts, sid).child("surface");
        const std::string id = trimmed(textOf(surface.child("init_from")));
        if (const xml_node found = image(id))
            return fileOf(found);
        throw Fault(fmt::format("the surface \"{}\" of {} names no image; export the scene again",
                                sid, describe(parts.effect)));
    }
    if (const xml_node found = image(sampler))
        return fileOf(found);
    throw Fault(fmt::format("the texture \"{}\" of {} is neither a sampler nor an image; export "
                            "the scene again",
                            sampler, describe(parts.effect)));
}

// The value of <param ref>, where a colour or number is one.
xml_node withParameter(const EffectParts& parts, xml_node value,
                       std::initializer_list<const char*> kinds) {
    const xml_node reference = value.child("param");
    if (!reference)
        return value;
    const xml_node found = parameter(parts, reference.attribute("ref").value());
    for (const char* kind : kinds)
        if (found.child(kind))
            return found.child(kind);
    throw Fault(fmt::format("the parameter \"{}\" of {} is not there; export the scene again",
                            reference.attribute("ref").value(), describe(parts.effect)));
}

// A colour: three or four numbers; alpha is 1 where there are three.
std::optional<glm::vec4> colorOf(const EffectParts& parts, xml_node value) {
    xml_node element = value.child("color");
    if (value.child("param"))
        element = withParameter(parts, value, {"float4", "float3"});
    if (!element)
        return std::nullopt;
    const std::vector<float> numbers = floatsOf(element);
    if (numbers.size() != 3 && numbers.size() != 4)
        throw Fault(
            fmt::format("a colour of {} has {} numbers instead of 4; export the scene again",
                        describe(parts.effect), numbers.size()));
    return glm::vec4(numbers[0], numbers[1], numbers[2], numbers.size() == 4 ? numbers[3] : 1.0f);
}

void readColor(const Tree& tree, const EffectParts& parts, const char* name, glm::vec3& color,
               std::string& file) {
    const xml_node value = parts.shading.child(name);
    if (const xml_node texture = value.child("texture")) {
        file = textureFile(tree, parts, texture);
        color = glm::vec3(1.0f);
    } else if (const auto given = colorOf(parts, value)) {
        color = glm::vec3(*given);
    }
}

// COLLADA 1.5, "Determining Transparency": the luminance is Rec. 709's, as the text has it.
float opacityOf(const EffectParts& parts) {
    const xml_node transparent = parts.shading.child("transparent");
    const xml_node transparency = parts.shading.child("transparency");
    const std::optional<glm::vec4> color = transparent ? colorOf(parts, transparent) : std::nullopt;
    float amount = 1.0f;
    if (transparency) {
        xml_node element = transparency.child("float");
        if (transparency.child("param"))
            element = withParameter(parts, transparency, {"float"});
        if (const std::vector<float> numbers = floatsOf(element); !numbers.empty())
            amount = numbers[0];
    }
    if (!color && !transparency)
        return 1.0f;
    const glm::vec4 c = color.value_or(glm::vec4(1.0f));
    const float luminance = 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
    const std::string mode = transparent.attribute("opaque").as_string("A_ONE");
    const float opacity = mode == "RGB_ZERO"  ? 1.0f - luminance * amount
                          : mode == "RGB_ONE" ? luminance * amount
                          : mode == "A_ZERO"  ? 1.0f - c.a * amount
                                              : c.a * amount;
    return std::clamp(opacity, 0.0f, 1.0f);
}

// No part of COLLADA, but what many programs write: <double_sided>1 in an <extra>.
bool isDoubleSided(xml_node effect) {
    for (xml_node node = effect; node; node = nextElement(node, effect))
        if (std::string_view(node.name()) == "double_sided" &&
            std::string_view(node.parent().name()) == "technique") {
            const std::string value = trimmed(textOf(node));
            return value == "1" || value == "true";
        }
    return false;
}

} // namespace

std::string fileNameOf(std::string_view uri) {
    // file:///a, file://localhost/a and file:/a all are /a; on Windows, file:///C:/a is C:/a.
    if (uri.starts_with("file:")) {
        uri.remove_prefix(5);
        if (uri.starts_with("//localhost/"))
            uri.remove_prefix(11);
        else if (uri.starts_with("///"))
            uri.remove_prefix(2);
        if (uri.size() > 2 && uri[0] == '/' && uri[2] == ':')
            uri.remove_prefix(1);
    }
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
        if (uri[i] == '%' && high >= 0 && low >= 0 && high * 16 + low != 0) {
            name += static_cast<char>(high * 16 + low);
            i += 2;
        } else {
            name += uri[i];
        }
    }
    return name;
}

ColladaMaterial readMaterial(const Tree& tree, xml_node material) {
    const EffectParts parts = effectOf(tree, material);
    ColladaMaterial result;
    result.id = material.attribute("id").value();
    result.name = material.attribute("name").value();
    if (result.name.empty())
        result.name = result.id;
    // What an effect does not name adds nothing (a constant one only glows).
    if (parts.shading && !parts.shading.child("diffuse"))
        result.diffuse = glm::vec3(0.0f);
    readColor(tree, parts, "diffuse", result.diffuse, result.diffuseTexture);
    readColor(tree, parts, "emission", result.emission, result.emissionTexture);
    result.unlit = std::string_view(parts.shading.name()) == "constant";
    result.opacity = opacityOf(parts);
    result.doubleSided = isDoubleSided(parts.effect);
    return result;
}

xml_node boundMaterial(xml_node instance, std::string_view symbol) {
    for (const xml_node& bound :
         instance.child("bind_material").child("technique_common").children("instance_material"))
        if (bound.attribute("symbol").value() == symbol)
            return bound;
    return {};
}

int textureSet(const Tree& tree, xml_node instanceMaterial) {
    if (!instanceMaterial)
        return -1;
    const xml_node material =
        tree.resolve(instanceMaterial.attribute("target").value(), {"material"}, instanceMaterial);
    const xml_node texture = effectOf(tree, material).shading.child("diffuse").child("texture");
    const std::string_view name = texture.attribute("texcoord").value();
    for (const xml_node& bind : instanceMaterial.children("bind_vertex_input"))
        if (texture && bind.attribute("semantic").value() == name &&
            std::string_view(bind.attribute("input_semantic").value()) == "TEXCOORD")
            return static_cast<int>(
                std::min<std::uint64_t>(countOf(bind, "input_set", 0), 1u << 20));
    return -1;
}

} // namespace patina::collada
