#include "core/export/collada/NewColladaDocument.h"

#include "core/base/Check.h"
#include "core/export/Names.h"
#include "core/export/collada/ColladaElements.h"
#include "core/export/collada/ColladaLighting.h"
#include "core/math/Bounds.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>
#include <utility>

namespace patina {
namespace {

using collada::append;
using collada::numberText;
using collada::setAttribute;
using collada::uriOf;
using collada::xml_node;

constexpr const char* kLightMapSemantic = "LightMap";
constexpr int kLightMapSet = 1;

constexpr const char* kEmpty = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/></COLLADA>
)";

// The schema wants names (NCName) where one would put any text: no spaces, no leading digit. What
// is no ASCII is taken for letters.
std::string xmlName(const std::string& title) {
    std::string name = cleanName(title, "");
    for (char& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '.' ||
                           static_cast<unsigned char>(c) >= 0x80;
        c = plain ? c : '_';
    }
    if (!name.empty() && (name[0] == '-' || name[0] == '.' || (name[0] >= '0' && name[0] <= '9')))
        name.insert(0, "_");
    return name;
}

std::string colorText(const glm::vec3& color, float alpha) {
    return fmt::format("{} {} {} {}", color.r, color.g, color.b, alpha);
}

class NewDocument {
  public:
    explicit NewDocument(const NewColladaScene& scene)
        : m_tree(kEmpty, {})
        , m_scene(scene) {}

    std::string write(std::chrono::sys_seconds modified) {
        const xml_node root = m_tree.root();
        const xml_node asset = root.child("asset");
        collada::stampAsset(root, modified);
        withoutSpace(asset);
        const xml_node unit = append(asset, "unit");
        setAttribute(unit, "name", "meter");
        setAttribute(unit, "meter", "1");
        append(asset, "up_axis", "Y_UP");
        writeCamera();
        if (!m_scene.materials.empty())
            writeMaterials();
        writeGeometries();
        writeScene();
        collada::indent(root);
        return m_tree.text() + "\n";
    }

  private:
    // Laid out as part of the whole.
    static void withoutSpace(xml_node element) {
        for (xml_node child = element.first_child(); child;) {
            const xml_node next = child.next_sibling();
            if (child.type() == pugi::node_pcdata && collada::trimmed(child.value()).empty())
                element.remove_child(child);
            else
                withoutSpace(child);
            child = next;
        }
    }

    xml_node appendWithId(xml_node parent, const char* name, const std::string& id,
                          const std::string& title) {
        const xml_node element = append(parent, name);
        setAttribute(element, "id", id);
        if (!title.empty())
            setAttribute(element, "name", xmlName(title));
        m_tree.add(element, id);
        return element;
    }

    void writeCamera() {
        Bounds bounds;
        for (const NewColladaMesh& mesh : m_scene.meshes)
            for (const glm::vec3& p : mesh.mesh.positions)
                bounds.add(p);
        // Encloses all there is, wherever it is looked at from.
        const double reach =
            static_cast<double>(glm::length(m_scene.camera.position() - bounds.center())) +
            static_cast<double>(bounds.radius());
        const double farPlane = std::max(1.1 * reach, 0.01);
        m_camera = m_tree.newId("camera");
        const xml_node camera =
            appendWithId(append(m_tree.root(), "library_cameras"), "camera", m_camera, "Camera");
        const xml_node lens =
            append(append(append(camera, "optics"), "technique_common"), "perspective");
        append(lens, "yfov", numberText(static_cast<double>(m_scene.camera.fovDeg)));
        append(lens, "aspect_ratio", numberText(m_scene.aspect));
        append(lens, "znear", numberText(farPlane / 10000.0));
        append(lens, "zfar", numberText(farPlane));
    }

    void writeMaterials() {
        for (const ColladaMaterial& material : m_scene.materials)
            for (const std::string& file : {material.diffuseTexture, material.emissionTexture})
                if (!file.empty())
                    m_images.try_emplace(file);
        if (!m_images.empty()) {
            const xml_node images = append(m_tree.root(), "library_images");
            for (auto& [file, id] : m_images) {
                id = m_tree.newId("image-" + file.substr(file.find_last_of('/') + 1));
                append(appendWithId(images, "image", id, {}), "init_from", uriOf(file));
            }
        }
        const xml_node effects = append(m_tree.root(), "library_effects");
        const xml_node materials = append(m_tree.root(), "library_materials");
        for (const ColladaMaterial& material : m_scene.materials) {
            const std::string name = material.name.empty() ? "material" : material.name;
            const std::string effect = m_tree.newId(name + "-effect");
            writeEffect(appendWithId(effects, "effect", effect, material.name), material);
            m_materials.push_back(m_tree.newId(name));
            setAttribute(
                append(appendWithId(materials, "material", m_materials.back(), material.name),
                       "instance_effect"),
                "url", "#" + effect);
        }
    }

    void writeEffect(xml_node effect, const ColladaMaterial& material) {
        const xml_node profile = append(effect, "profile_COMMON");
        for (const auto& [name, file] :
             {std::pair<const char*, const std::string&>{"diffuse", material.diffuseTexture},
              {"emission", material.emissionTexture}})
            if (!file.empty()) {
                const xml_node surfaceParam = append(profile, "newparam");
                setAttribute(surfaceParam, "sid", std::string(name) + "-surface");
                const xml_node surface = append(surfaceParam, "surface");
                setAttribute(surface, "type", "2D");
                append(surface, "init_from", m_images.at(file));
                const xml_node samplerParam = append(profile, "newparam");
                setAttribute(samplerParam, "sid", std::string(name) + "-sampler");
                append(append(samplerParam, "sampler2D"), "source", std::string(name) + "-surface");
            }
        const xml_node technique = append(profile, "technique");
        setAttribute(technique, "sid", "common");
        const xml_node shading = append(technique, material.unlit ? "constant" : "lambert");
        writeColor(shading, "emission", material.emission, material.emissionTexture);
        if (!material.unlit)
            writeColor(shading, "diffuse", material.diffuse, material.diffuseTexture);
        if (material.opacity < 1.0f) {
            const xml_node transparent = append(shading, "transparent");
            setAttribute(transparent, "opaque", "A_ONE");
            append(transparent, "color", colorText(glm::vec3(1.0f), 1.0f));
            append(append(shading, "transparency"), "float", fmt::to_string(material.opacity));
        }
        if (material.doubleSided) {
            const xml_node extra = append(append(effect, "extra"), "technique");
            setAttribute(extra, "profile", "GOOGLEEARTH");
            append(extra, "double_sided", "1");
        }
    }

    void writeColor(xml_node shading, const char* name, const glm::vec3& color,
                    const std::string& file) const {
        const xml_node element = append(shading, name);
        if (file.empty()) {
            append(element, "color", colorText(color, 1.0f));
            return;
        }
        const xml_node texture = append(element, "texture");
        setAttribute(texture, "texture", std::string(name) + "-sampler");
        // Materials glow with the light map alone.
        const bool isLightMap = m_scene.lightMap && std::string_view(name) == "emission";
        setAttribute(texture, "texcoord", isLightMap ? kLightMapSemantic : "UVMap");
    }

    void writeGeometries() {
        const xml_node library = append(m_tree.root(), "library_geometries");
        for (const NewColladaMesh& lit : m_scene.meshes) {
            const std::string name = lit.name.empty() ? "mesh" : lit.name;
            m_geometries.push_back(m_tree.newId(name + "-mesh"));
            const xml_node geometry =
                appendWithId(library, "geometry", m_geometries.back(), lit.name);
            collada::LitVertices vertices{lit.mesh.positions, lit.mesh.normals, lit.mesh.uvs,
                                          lit.colors,         lit.radiosity,    lit.white,
                                          lit.lightMapUvs};
            for (std::vector<glm::vec2>* uvs : {&vertices.uvs, &vertices.lightMapUvs})
                for (glm::vec2& uv : *uvs)
                    uv.y = 1.0f - uv.y;
            const std::vector<collada::LitTriangles> triangles{{lit.material >= 0 ? "material" : "",
                                                                vertices.uvs.empty() ? -1 : 0,
                                                                kLightMapSet, lit.mesh.indices}};
            collada::appendLitMesh(geometry, vertices, triangles,
                                   [&](xml_node element, std::string_view wanted) {
                                       std::string id = m_tree.newId(wanted);
                                       m_tree.add(element, id);
                                       return id;
                                   });
            if (m_scene.lightMap)
                collada::appendLightMap(geometry, *m_scene.lightMap);
            else
                collada::appendRadiosity(geometry, vertices);
        }
    }

    static void bindSet(xml_node bound, const char* semantic, int set) {
        const xml_node bind = append(bound, "bind_vertex_input");
        setAttribute(bind, "semantic", semantic);
        setAttribute(bind, "input_semantic", "TEXCOORD");
        setAttribute(bind, "input_set", fmt::to_string(set));
    }

    void writeScene() {
        const std::string id = m_tree.newId("scene");
        const xml_node scene = appendWithId(append(m_tree.root(), "library_visual_scenes"),
                                            "visual_scene", id, m_scene.name);
        for (std::size_t i = 0; i < m_scene.meshes.size(); ++i) {
            const NewColladaMesh& lit = m_scene.meshes[i];
            const std::string name = lit.name.empty() ? "mesh" : lit.name;
            const xml_node node = appendWithId(scene, "node", m_tree.newId(name), lit.name);
            const xml_node instance = append(node, "instance_geometry");
            setAttribute(instance, "url", "#" + m_geometries[i]);
            if (lit.material < 0)
                continue;
            const xml_node bound = append(
                append(append(instance, "bind_material"), "technique_common"), "instance_material");
            setAttribute(bound, "symbol", "material");
            setAttribute(bound, "target",
                         "#" + m_materials[static_cast<std::size_t>(lit.material)]);
            if (!lit.mesh.uvs.empty())
                bindSet(bound, "UVMap", 0);
            if (m_scene.lightMap)
                bindSet(bound, kLightMapSemantic, kLightMapSet);
        }
        const xml_node camera = appendWithId(scene, "node", m_tree.newId("camera-node"), "Camera");
        // A camera looks along its -Z.
        const Camera& view = m_scene.camera;
        append(camera, "matrix",
               collada::matrixText({glm::dvec4(view.right(), 0.0), glm::dvec4(view.up(), 0.0),
                                    glm::dvec4(-view.forward(), 0.0),
                                    glm::dvec4(view.position(), 1.0)}));
        setAttribute(append(camera, "instance_camera"), "url", "#" + m_camera);
        setAttribute(append(append(m_tree.root(), "scene"), "instance_visual_scene"), "url",
                     "#" + id);
    }

    collada::Tree m_tree;
    const NewColladaScene& m_scene;
    std::string m_camera;
    std::map<std::string, std::string> m_images; // ids by file
    std::vector<std::string> m_materials, m_geometries;
};

} // namespace

Result<ColladaDocument> newColladaDocument(const NewColladaScene& scene,
                                           std::chrono::sys_seconds modified) {
    const auto wrong = [](std::string message) {
        return Error{ErrorKind::Usage, std::move(message), {}, {}};
    };
    if (scene.meshes.empty())
        return wrong("the scene has no lit mesh; bake one first");
    for (const NewColladaMesh& lit : scene.meshes) {
        CHECK_LT(lit.material, static_cast<int>(scene.materials.size()));
        if (auto problem =
                collada::problemOf(lit.mesh, lit.colors, lit.radiosity, lit.white, lit.lightMapUvs,
                                   scene.lightMap.has_value(), "\"" + lit.name + "\""))
            return wrong(std::move(*problem));
    }
    // What is written is what is read: the limits are those of files from elsewhere.
    ColladaLimits limits;
    limits.elements = std::max(limits.elements, scene.meshes.size());
    std::string text = NewDocument(scene).write(modified);
    limits.fileBytes = std::max(limits.fileBytes, text.size());
    return ColladaDocument::parse(std::move(text), {}, limits);
}

} // namespace patina
