#include "core/radiosity/document/LitDocument.h"

#include "core/document/Snapshot.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr double kMiddleGrey = 0.18;
// Of the scene's radius. A depth buffer of 24 bits tells as little apart at the far end of a scene
// whose near plane is at a 10,000th of its far one.
constexpr float kBackOffset = 1e-3f;

float cutOff(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

const Material* materialOf(const Document& document, Id id) {
    const auto found = std::ranges::find(document.materials, id, &Material::id);
    return found != document.materials.end() ? &*found : nullptr;
}

const Material* materialOf(const Document& document, const LitPart& part) {
    const auto instance = std::ranges::find(document.meshes, part.instance, &MeshInstance::id);
    return instance != document.meshes.end() ? materialOf(document, instance->material) : nullptr;
}

bool isTextured(const Material* material) {
    return material != nullptr && material->baseColorMap.image != nullptr;
}

// What becomes colours: where a texture multiplies them, the light of a white surface.
const std::vector<glm::vec3>& shownLight(const Document& document, const LitPart& part) {
    return isTextured(materialOf(document, part)) ? part.irradiance : part.radiosity;
}

// Along its normals; each vertex that others share a place with goes its own way.
MeshPtr movedOut(const Mesh& mesh, float distance) {
    auto moved = std::make_shared<Mesh>(mesh);
    for (std::size_t v = 0; v < moved->positions.size(); ++v)
        moved->positions[v] += distance * moved->normals[v];
    return moved;
}

// As its light already is in the vertices: what is left is a texture, and what is cut out.
Material shown(const Material& material, bool textured) {
    Material result;
    result.id = material.id;
    result.name = material.name;
    if (textured) {
        result.baseColor = material.baseColor;
        result.baseColorMap = material.baseColorMap;
    } else {
        result.baseColor = glm::vec3(1.0f);
    }
    result.metallic = 0.0f;
    result.opacity = material.opacity;
    result.alphaMode = material.alphaMode;
    result.alphaCutoff = material.alphaCutoff;
    return result;
}

} // namespace

glm::vec3 exposed(const glm::vec3& radiance, double k) {
    glm::vec3 result;
    for (int c = 0; c < 3; ++c)
        result[c] = cutOff(-std::expm1(-k * std::max(0.0, double{radiance[c]})));
    return result;
}

double automaticExposure(const Document& document, const std::vector<LitPart>& parts) {
    struct Piece { // a triangle
        LitArea lit;
        double irradiance;
        bool glows; // sends more than it receives
    };
    std::vector<Piece> pieces;
    double area = 0.0, arriving = 0.0;
    for (const LitPart& part : parts) {
        const std::vector<glm::vec3>& shown = shownLight(document, part);
        for (std::size_t i = 0; i < part.mesh->indices.size(); i += 3) {
            const std::uint32_t* v = part.mesh->indices.data() + i;
            const glm::vec3 &a = part.mesh->positions[v[0]], &b = part.mesh->positions[v[1]],
                            &c = part.mesh->positions[v[2]];
            const auto mean = [v](const std::vector<glm::vec3>& light) {
                return double{shading::luminance((light[v[0]] + light[v[1]] + light[v[2]]) / 3.0f)};
            };
            const Piece piece{{glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a))),
                               mean(shown) / std::numbers::pi},
                              mean(part.irradiance),
                              mean(part.radiosity) > 1.001 * mean(part.irradiance)};
            pieces.push_back(piece);
            area += piece.lit.area;
            arriving += piece.lit.area * piece.irradiance;
        }
    }
    // The inside of things, where next to no light comes, is not what is looked at.
    const double dark = area > 0.0 ? kDarkShare * arriving / area : 0.0;
    std::vector<LitArea> seen;
    for (const Piece& piece : pieces)
        if (!piece.glows && piece.irradiance > dark && piece.lit.radiance > 0.0)
            seen.push_back(piece.lit);
    return exposureOfMedian(std::move(seen));
}

double exposureOfMedian(std::vector<LitArea> pieces) {
    std::ranges::sort(pieces, {}, &LitArea::radiance);
    double lit = 0.0, below = 0.0;
    for (const LitArea& piece : pieces)
        lit += piece.area;
    for (const LitArea& piece : pieces) {
        below += piece.area;
        if (below >= 0.5 * lit)
            return -std::log1p(-kMiddleGrey) / piece.radiance;
    }
    return 1.0;
}

LitDocument withoutLight(const Document& document, std::optional<double> exposure) {
    LitDocument result;
    result.document = document;
    result.exposure = exposure;
    result.backOffset = kBackOffset * document.bounds().radius();
    Document& lit = result.document;
    lit.meshes.clear();
    lit.materials.clear();
    lit.lights.clear();
    lit.snapshots.clear();
    lit.bakes = {};
    return result;
}

MeshInstance& addPart(LitDocument& lit, const MeshInstance& instance, bool back, MeshPtr mesh) {
    MeshInstance& copy = lit.document.meshes.emplace_back(instance);
    copy.id = static_cast<Id>(lit.document.meshes.size());
    if (back)
        copy.name += " (back)";
    copy.mesh = back ? movedOut(*mesh, lit.backOffset) : std::move(mesh);
    copy.placement = {};
    lit.instanceOf[copy.id] = instance.id;
    return copy;
}

LitDocument litDocument(const Document& document, const std::vector<LitPart>& parts,
                        std::optional<double> exposure) {
    LitDocument result = withoutLight(document, exposure);
    Document& lit = result.document;
    LitMeshes meshes;
    for (const LitPart& part : parts) {
        const auto instance = std::ranges::find(document.meshes, part.instance, &MeshInstance::id);
        if (instance == document.meshes.end())
            continue;
        const Material* material = materialOf(document, instance->material);
        if (material != nullptr && materialOf(lit, material->id) == nullptr)
            lit.materials.push_back(shown(*material, isTextured(material)));
        LitVertices& vertices = meshes[addPart(result, *instance, part.back, part.mesh).id];
        const std::vector<glm::vec3>& light = shownLight(document, part);
        for (std::size_t v = 0; v < part.radiosity.size(); ++v) {
            const auto pi = std::numbers::pi_v<float>;
            const glm::vec3 color = exposure ? exposed(light[v] / pi, *exposure)
                                             : glm::clamp(light[v] / pi, 0.0f, 1.0f);
            vertices.colors.emplace_back(color, 1.0f);
            vertices.radiance.push_back(part.radiosity[v] / pi);
            if (isTextured(material))
                vertices.whiteRadiance.push_back(light[v] / pi);
        }
    }
    result.lit = std::make_shared<const LitMeshes>(std::move(meshes));
    return result;
}

} // namespace patina
