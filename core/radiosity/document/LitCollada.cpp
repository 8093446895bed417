#include "core/radiosity/document/LitCollada.h"

#include "core/export/Export.h"
#include "core/export/collada/NewColladaDocument.h"
#include "core/math/Bounds.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

// The vertices' light as COLLADA has it: colours as displays want them.
template <class LitMesh>
void addLight(const LitVertices& light, LitMesh& mesh) {
    for (const glm::vec4& color : light.colors)
        mesh.colors.emplace_back(shading::srgbEncode(glm::vec3(color)), color.w);
    for (const glm::vec3& radiance : light.radiance)
        mesh.radiosity.push_back(std::numbers::pi_v<float> * radiance);
    for (const glm::vec3& radiance : light.whiteRadiance)
        mesh.white.push_back(std::numbers::pi_v<float> * radiance);
    mesh.lightMapUvs.insert(mesh.lightMapUvs.end(), light.lightMapUvs.begin(),
                            light.lightMapUvs.end());
}

std::optional<ColladaLightMap> lightMapOf(const LitDocument& lit,
                                          const std::filesystem::path& output) {
    if (lit.lightMap == nullptr)
        return std::nullopt;
    return ColladaLightMap{lightMapPath(output, ".png").filename().string(),
                           lightMapPath(output, ".exr").filename().string()};
}

void addMesh(const Mesh& from, Mesh& to) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.uvs.insert(to.uvs.end(), from.uvs.begin(), from.uvs.end());
    for (const std::uint32_t index : from.indices)
        to.indices.push_back(first + index);
}

Bounds boundsOf(const Mesh& mesh) {
    Bounds bounds; // of what triangles use
    for (const std::uint32_t index : mesh.indices)
        bounds.add(mesh.positions[index]);
    return bounds;
}

// How far two boxes are apart, relative to their size.
double apart(const Bounds& a, const Bounds& b) {
    const double size = std::max({glm::length(a.max - a.min), glm::length(b.max - b.min), 1e-20f});
    return std::max(glm::length(a.min - b.min), glm::length(a.max - b.max)) / size;
}

} // namespace

Result<LitCollada> newLitCollada(const LitDocument& lit, const Camera& camera,
                                 std::chrono::sys_seconds modified,
                                 const std::filesystem::path& output) {
    NewColladaScene scene;
    std::vector<std::string> notices;
    scene.lightMap = lightMapOf(lit, output);
    scene.name = "Scene";
    scene.camera = camera;
    for (const Material& material : lit.document.materials) {
        ColladaMaterial& copy = scene.materials.emplace_back();
        copy.name = material.name;
        const glm::vec3 color = shading::srgbEncode(material.baseColor);
        copy.opacity = material.opacity;
        // Its light is in the vertices: lit once more it would be too dark, and shaded twice.
        copy.unlit = !scene.lightMap;
        (copy.unlit ? copy.emission : copy.diffuse) = color;
        if (scene.lightMap) {
            copy.emissionTexture = scene.lightMap->picture;
            if (material.alphaMode == AlphaMode::Mask)
                notices.push_back(fmt::format("{} is not cut out: COLLADA takes its light map for "
                                              "its whole surface",
                                              material.name));
        } else if (material.baseColorMap.image != nullptr) {
            copy.emissionTexture = material.baseColorMap.source;
        }
    }
    for (const MeshInstance& instance : lit.document.meshes) {
        NewColladaMesh& mesh = scene.meshes.emplace_back();
        mesh.name = instance.name;
        const auto material =
            std::ranges::find(lit.document.materials, instance.material, &Material::id);
        if (material != lit.document.materials.end())
            mesh.material = static_cast<int>(material - lit.document.materials.begin());
        mesh.mesh = *instance.mesh;
        addLight(lit.lit->at(instance.id), mesh);
    }
    Result<ColladaDocument> document = newColladaDocument(scene, modified);
    if (!document)
        return document.error();
    return LitCollada{std::move(*document), std::move(notices)};
}

Result<LitCollada> lightCollada(ColladaDocument collada, const Document& source,
                                const LitDocument& lit, std::chrono::sys_seconds modified,
                                const std::filesystem::path& output) {
    // Where each mesh of the document is, and the lit ones that it has become: one for each side.
    struct Surface {
        Bounds bounds;
        std::vector<const MeshInstance*> lit;
        bool taken = false;
    };
    std::vector<Surface> surfaces;
    for (const MeshInstance& instance : source.meshes) {
        Surface surface;
        for (const std::uint32_t index : instance.mesh->indices)
            surface.bounds.add(glm::vec3(instance.placement.matrix() *
                                         glm::vec4(instance.mesh->positions[index], 1.0f)));
        for (const MeshInstance& part : lit.document.meshes)
            if (lit.instanceOf.at(part.id) == instance.id)
                surface.lit.push_back(&part);
        if (!surface.lit.empty())
            surfaces.push_back(std::move(surface));
    }
    const std::optional<ColladaLightMap> lightMap = lightMapOf(lit, output);
    std::vector<ColladaLitMesh> meshes;
    LitCollada result{std::move(collada), {}};
    for (std::size_t i = 0; i < result.document.instances().size(); ++i) {
        const ColladaInstance& instance = result.document.instances()[i];
        const Result<ColladaMesh> mesh = result.document.mesh(i);
        if (!mesh)
            return mesh.error();
        const Bounds bounds = boundsOf(mesh->mesh);
        Surface* nearest = nullptr;
        for (Surface& surface : surfaces)
            if (!surface.taken && (nearest == nullptr ||
                                   apart(surface.bounds, bounds) < apart(nearest->bounds, bounds)))
                nearest = &surface;
        if (nearest == nullptr || apart(nearest->bounds, bounds) > 1e-3) {
            result.notices.push_back(fmt::format(
                "{} was not lit: its surface was left out when the scene was read", instance.path));
            continue;
        }
        nearest->taken = true;
        ColladaLitMesh& lightened = meshes.emplace_back();
        lightened.instance = i;
        for (const MeshInstance* part : nearest->lit) {
            addMesh(*part->mesh, lightened.mesh);
            addLight(lit.lit->at(part->id), lightened);
        }
    }
    if (meshes.empty())
        return Error{ErrorKind::InputBroken,
                     "None of the document's surfaces is where the scene's are, so that no light "
                     "can be put into it; write the light to a .glb instead.",
                     {},
                     {}};
    Result<std::vector<std::string>> notices =
        result.document.light(meshes, modified, lightMap ? &*lightMap : nullptr);
    if (!notices)
        return notices.error();
    result.notices.insert(result.notices.end(), notices->begin(), notices->end());
    return result;
}

} // namespace patina
