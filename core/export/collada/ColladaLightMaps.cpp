#include "core/export/collada/ColladaLightMaps.h"

#include "core/export/collada/ColladaElements.h"
#include "core/export/collada/ColladaMaterials.h"
#include "core/export/collada/OwnNodes.h"

#include <fmt/format.h>
#include <string_view>

namespace patina::collada {
namespace {

constexpr const char* kMapSampler = "light-map-sampler";
constexpr const char* kMapSurface = "light-map-surface";
constexpr const char* kMapTexcoord = "LightMap";

// lambert, phong, blinn or constant.
xml_node shadingOf(xml_node effect) {
    const xml_node technique = effect.child("profile_COMMON").child("technique");
    for (const char* name : {"lambert", "phong", "blinn", "constant"})
        if (const xml_node shading = technique.child(name))
            return shading;
    return {};
}

} // namespace

LightMapMaterials::LightMapMaterials(Tree& tree, const std::string& picture)
    : m_tree(tree)
    , m_image(tree.newId("light-map")) {
    const xml_node images = library("library_images");
    const xml_node image = insertAfter(images, lastOf(images, {"image"}), "image");
    setAttribute(image, "id", m_image);
    if (isVersion15())
        append(append(image, "init_from"), "ref", uriOf(picture));
    else
        append(image, "init_from", uriOf(picture));
    indent(image);
    m_tree.add(image, m_image);
}

bool LightMapMaterials::isVersion15() const {
    return std::string_view(m_tree.root().attribute("version").value()).starts_with("1.5");
}

xml_node LightMapMaterials::library(const char* name) {
    const xml_node root = m_tree.root();
    if (const xml_node found = root.child(name))
        return found;
    return insertAfter(root, root.child("asset"), name);
}

void LightMapMaterials::bind(xml_node instance, const std::string& symbol, int set) {
    xml_node material = instance.child("bind_material");
    if (!material)
        material = insertAfter(instance, {}, "bind_material");
    xml_node common = material.child("technique_common");
    if (!common)
        common = insertAfter(material, lastOf(material, {"param"}), "technique_common");
    xml_node bound = boundMaterial(instance, symbol);
    xml_node original;
    if (bound) {
        original = m_tree.resolve(bound.attribute("target").value(), {"material"}, bound);
    } else {
        bound = insertAfter(common, lastOf(common, {"instance_material"}), "instance_material");
        setAttribute(bound, "symbol", symbol);
    }
    setAttribute(bound, "target", "#" + materialLike(original));
    const xml_node input =
        insertAfter(bound, lastOf(bound, {"bind", "bind_vertex_input"}), "bind_vertex_input");
    setAttribute(input, "semantic", kMapTexcoord);
    setAttribute(input, "input_semantic", "TEXCOORD");
    setAttribute(input, "input_set", fmt::to_string(set));
}

std::string LightMapMaterials::materialLike(xml_node original) {
    const std::string id = original.attribute("id").value();
    const auto [known, isNew] = m_copies.try_emplace(id);
    if (!isNew)
        return known->second;
    const xml_node effect = effectLike(
        original ? m_tree.resolve(original.child("instance_effect").attribute("url").value(),
                                  {"effect"}, original)
                 : xml_node());
    const xml_node materials = library("library_materials");
    const xml_node copy = insertAfter(materials, lastOf(materials, {"material"}), "material");
    known->second = m_tree.newId(id.empty() ? "light-map-material" : id + "-lit");
    setAttribute(copy, "id", known->second);
    if (original.attribute("name"))
        setAttribute(copy, "name", original.attribute("name").value());
    setAttribute(append(copy, "instance_effect"), "url",
                 "#" + std::string(effect.attribute("id").value()));
    indent(copy);
    m_tree.add(copy, known->second);
    return known->second;
}

xml_node LightMapMaterials::effectLike(xml_node original) {
    const xml_node effects = library("library_effects");
    const xml_node last = lastOf(effects, {"effect"});
    xml_node effect;
    if (shadingOf(original)) {
        effect = insertCopyAfter(effects, last, original);
        setAttribute(effect, "id", fmt::format("{}-lit", original.attribute("id").value()));
        renameIds(m_tree, effect);
    } else {
        effect = insertAfter(effects, last, "effect");
        const std::string id = m_tree.newId("light-map-effect");
        setAttribute(effect, "id", id);
        m_tree.add(effect, id);
        const xml_node technique = append(append(effect, "profile_COMMON"), "technique");
        setAttribute(technique, "sid", "common");
        append(technique, "lambert");
        indent(effect);
    }
    addParameters(effect.child("profile_COMMON"));

    // What is left says how much of the surface is there.
    xml_node shading = shadingOf(effect);
    for (const char* name :
         {"emission", "ambient", "diffuse", "specular", "shininess", "reflective", "reflectivity"})
        while (const xml_node child = shading.child(name)) {
            if (const xml_node line = child.previous_sibling();
                line.type() == pugi::node_pcdata && trimmed(line.value()).empty())
                shading.remove_child(line);
            shading.remove_child(child);
        }
    if (std::string_view(shading.name()) != "constant") {
        const xml_node diffuse = insertAfter(shading, {}, "diffuse");
        append(diffuse, "color", "0 0 0 1");
        indent(diffuse);
    }
    const xml_node emission = insertAfter(shading, {}, "emission");
    const xml_node texture = append(emission, "texture");
    setAttribute(texture, "texture", kMapSampler);
    setAttribute(texture, "texcoord", kMapTexcoord);
    indent(emission);
    return effect;
}

// COLLADA 1.5 has no surfaces.
void LightMapMaterials::addParameters(xml_node profile) {
    const xml_node first = profile.child("asset");
    const xml_node sampler = insertAfter(profile, first, "newparam");
    setAttribute(sampler, "sid", kMapSampler);
    const xml_node sampled = append(sampler, "sampler2D");
    if (isVersion15()) {
        setAttribute(append(sampled, "instance_image"), "url", "#" + m_image);
    } else {
        append(sampled, "source", kMapSurface);
        const xml_node parameter = insertAfter(profile, first, "newparam");
        setAttribute(parameter, "sid", kMapSurface);
        const xml_node surface = append(parameter, "surface");
        setAttribute(surface, "type", "2D");
        append(surface, "init_from", m_image);
        indent(parameter);
    }
    indent(sampler);
}

} // namespace patina::collada
