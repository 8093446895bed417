#include "core/radiosity/document/RadiosityLightMap.h"

#include "core/bake/domain/BakePoints.h"
#include "core/bake/domain/GutterFill.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/math/Shading.h"
#include "core/mesh/UvUnwrap.h"
#include "core/radiosity/document/Reexpose.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <utility>

namespace patina {
namespace {

using namespace radiosity;

constexpr float kMapMarginTexels = 2.0f;
constexpr std::size_t kMapTexelsAtATime = 64;
constexpr Id kMapMaterial = 1; // of all surfaces, as texelPoints() sees them

// A side of a mesh of the scene as it becomes a surface.
struct MapSide {
    std::uint32_t mesh = 0;
    bool back = false;
    bool turned = false;                  // triangles run the other way round than the scene's
    std::vector<std::uint32_t> triangles; // of the mesh: each of the surface's
    Mesh surface;                         // world; uvs: in the light map
    std::vector<std::uint32_t> origins;   // of each vertex, in the scene's mesh
};

std::vector<MapSide> sidesOf(const SolvedSurfaces& solved) {
    const BakeGeometry& geometry = *solved.scene.geometry();
    std::vector<MapSide> sides;
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m)
        for (const bool back : {false, true}) {
            const BakeGeometryMesh& from = geometry.meshes[m];
            MapSide side;
            side.mesh = m;
            side.back = back;
            side.turned = back != (from.winding < 0.0f);
            std::vector<std::uint32_t> numbers(from.positions.size(), kNone);
            for (std::uint32_t t = 0; t < from.mesh->triangleCount(); ++t) {
                if (!solved.elements.divides(m, t, back))
                    continue;
                side.triangles.push_back(t);
                const std::uint32_t* corner = from.mesh->indices.data() + 3 * std::size_t{t};
                for (const std::uint32_t v :
                     {corner[0], corner[side.turned ? 2 : 1], corner[side.turned ? 1 : 2]}) {
                    if (numbers[v] == kNone) {
                        numbers[v] = static_cast<std::uint32_t>(side.origins.size());
                        side.origins.push_back(v);
                        side.surface.positions.push_back(solved.scene.toWorld(from.positions[v]));
                        side.surface.normals.push_back(back ? -from.normals[v] : from.normals[v]);
                    }
                    side.surface.indices.push_back(numbers[v]);
                }
            }
            if (!side.triangles.empty())
                sides.push_back(std::move(side));
        }
    return sides;
}

Result<void> layOut(std::vector<MapSide>& sides, int size) {
    std::vector<Mesh> meshes;
    std::vector<std::vector<std::uint32_t>> origins;
    std::size_t triangles = 0;
    for (MapSide& side : sides) {
        triangles += side.triangles.size();
        meshes.push_back(std::move(side.surface));
        origins.push_back(std::move(side.origins));
    }
    if (triangles > kMaxChartedTriangles)
        return Error{ErrorKind::Usage,
                     fmt::format("The scene's surfaces have {} triangles, and a light map takes {} "
                                 "at most; bake it with --target vertex.",
                                 triangles, kMaxChartedTriangles),
                     {},
                     {}};
    UnwrapSettings settings;
    settings.resolution = size;
    settings.marginTexels = kMapMarginTexels;
    const int needed = unwrapUvsTogether(meshes, settings, origins);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        sides[i].surface = std::move(meshes[i]);
        sides[i].origins = std::move(origins[i]);
    }
    if (needed > kMaxRadiosityMapSize)
        return Error{
            ErrorKind::Usage,
            fmt::format("The scene's surfaces come apart into more pieces than a light map "
                        "of {} texels has room for; bake it with --target vertex.",
                        kMaxRadiosityMapSize),
            {},
            {}};
    if (needed > size)
        return Error{ErrorKind::Usage,
                     fmt::format("A light map of {} texels has no room for all pieces of the "
                                 "scene's surfaces; use --size {}.",
                                 size, needed),
                     {},
                     {}};
    return {};
}

// The sides as texelPoints() rasterises them.
BakeGeometry mapGeometry(const std::vector<MapSide>& sides) {
    BakeGeometry geometry;
    for (const MapSide& side : sides) {
        BakeGeometryMesh& mesh = geometry.meshes.emplace_back();
        mesh.material = kMapMaterial;
        mesh.mesh = std::make_shared<const Mesh>(side.surface);
        mesh.positions = side.surface.positions;
        mesh.normals = side.surface.normals;
    }
    return geometry;
}

// Points of a texel about its own, in the triangle that it shows.
class MapTexel {
  public:
    MapTexel(const MapSide& side, const SurfacePlace& place, int size)
        : m_side(side)
        , m_place(place) {
        const std::uint32_t* corner = side.surface.indices.data() + 3 * std::size_t{place.triangle};
        const glm::dvec2 a(side.surface.uvs[corner[0]]),
            x = glm::dvec2(side.surface.uvs[corner[1]]) - a,
            y = glm::dvec2(side.surface.uvs[corner[2]]) - a;
        const double area = x.x * y.y - x.y * y.x, quarter = 0.25 / size;
        std::array<glm::vec2, 4> all{};
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec2 by(i % 2 == 0 ? -quarter : quarter, i < 2 ? -quarter : quarter);
            all[i] = {place.b1 + (by.x * y.y - by.y * y.x) / area,
                      place.b2 + (x.x * by.y - x.y * by.x) / area};
        }
        for (const glm::vec2& b : all)
            if (b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f) // not where it is no number
                m_weights.at(m_count++) = b;
        if (m_count == 0)
            m_weights.at(m_count++) = {place.b1, place.b2};
    }

    [[nodiscard]] std::size_t count() const { return m_count; }
    // A little clear of the triangle's border, so that rays do not begin within its neighbour.
    [[nodiscard]] SidePlace place(std::size_t i) const {
        constexpr float kInwards = 1e-4f;
        const glm::vec2 b = glm::mix(m_weights.at(i), glm::vec2(1.0f / 3.0f), kInwards);
        return {m_side.mesh, m_side.triangles[m_place.triangle],
                m_side.turned ? glm::vec2(b.y, b.x) : b, m_side.back};
    }

  private:
    const MapSide& m_side;
    SurfacePlace m_place;
    std::array<glm::vec2, 4> m_weights{};
    std::size_t m_count = 0;
};

LightMapSurface surfaceOf(const SolvedSurfaces& solved, MapSide&& side) {
    const BakeGeometryMesh& from = solved.scene.geometry()->meshes[side.mesh];
    LightMapSurface surface;
    surface.instance = from.id;
    surface.back = side.back;
    surface.uvs = std::exchange(side.surface.uvs, {});
    for (const std::uint32_t v : side.origins)
        side.surface.uvs.push_back(from.mesh->uvs[v]);
    surface.mesh = std::make_shared<const Mesh>(std::move(side.surface));
    return surface;
}

// What is left of a material whose light is in the light map: what is cut out.
Material blackBut(const Material& material, const ImagePtr& map) {
    Material result;
    result.id = material.id;
    result.name = material.name;
    result.baseColor = glm::vec3(0.0f);
    result.metallic = 0.0f;
    result.perceptualRoughness = 1.0f;
    result.emissive = glm::vec3(1.0f);
    result.emissiveStrength = 1.0f;
    result.emissiveMap.source = kLightMapSource;
    result.emissiveMap.image = map;
    result.opacity = material.opacity;
    result.alphaMode = material.alphaMode;
    result.alphaCutoff = material.alphaCutoff;
    if (material.alphaMode != AlphaMode::Opaque)
        result.baseColorMap = material.baseColorMap;
    return result;
}

} // namespace

Result<RadiosityLightMap> radiosityLightMap(const SolvedSurfaces& solved, const Solution& solution,
                                            const RadiosityMapSettings& settings,
                                            const JobContext& job) {
    if (settings.size < 1 || settings.size > kMaxRadiosityMapSize)
        return Error{ErrorKind::Usage,
                     fmt::format("The side of a light map is 1 to {} texels, not {}.",
                                 kMaxRadiosityMapSize, settings.size),
                     {},
                     {}};
    job.setActivity("unwrapping");
    std::vector<MapSide> sides = sidesOf(solved);
    if (Result<void> laidOut = layOut(sides, settings.size); !laidOut)
        return laidOut.error();
    std::vector<SurfacePlace> places;
    const TexelPoints texels =
        texelPoints(mapGeometry(sides), kMapMaterial, settings.size, job, &places);
    if (job.cancelled())
        return bakeCancelled();

    job.setActivity("lighting texels");
    const SeenSolution seen(solved.scene, solved.elements, solved.lit, solution);
    const auto side = static_cast<std::size_t>(settings.size);
    Image radiance(settings.size, settings.size, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> out = radiance.f32();
    RadiosityLightMap map;
    map.side = settings.size;
    map.lit.assign(side * side, 0);
    parallelFor(
        job, texels.texels.size(), kMapTexelsAtATime, [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            for (std::size_t t = begin; t < end && !job.cancelled(); ++t) {
                const SurfacePlace& first = places[texels.firstPoint[t]];
                const MapTexel texel(sides[first.mesh], first, settings.size);
                PictureSettings picture = settings.picture;
                picture.gatherRays =
                    std::max(picture.gatherRays / static_cast<int>(texel.count()), 1);
                glm::vec3 sum(0.0f);
                int count = 0;
                for (std::size_t i = 0; i < texel.count(); ++i) {
                    const SidePlace place = texel.place(i);
                    // Only interpolated light goes on below what stands on a surface.
                    if (picture.look == radiosity::Look::Gathered && seen.isBuried(place))
                        continue;
                    const std::uint32_t seed = seedFor(seedFor(picture.seed, texels.texels[t]),
                                                       static_cast<std::uint32_t>(i));
                    sum += seen.radianceAt(place, picture, seed);
                    ++count;
                }
                if (count == 0)
                    continue;
                map.lit[texels.texels[t]] = 1;
                for (std::size_t c = 0; c < 3; ++c)
                    out[3 * std::size_t{texels.texels[t]} + c] =
                        sum[static_cast<glm::length_t>(c)] / static_cast<float>(count);
            }
            job.setProgress(static_cast<double>(end) / static_cast<double>(texels.texels.size()));
        });
    if (job.cancelled())
        return bakeCancelled();
    fillGutters(out, map.lit, settings.size, std::array{0.0f, 0.0f, 0.0f});
    map.radiance = std::make_shared<const Image>(std::move(radiance));
    for (MapSide& of : sides)
        map.surfaces.push_back(surfaceOf(solved, std::move(of)));
    return map;
}

ImagePtr shownLightMap(const Image& radiance, std::optional<double> exposure) {
    Image shown(radiance.width(), radiance.height(), 3, PixelType::U8, ColorEncoding::Srgb);
    const std::span<const float> light = radiance.f32();
    const std::span<std::uint8_t> out = shown.u8();
    for (std::size_t i = 0; i < out.size(); i += 3) {
        const glm::vec3 color =
            exposedColor({light[i], light[i + 1], light[i + 2]}, exposure.value_or(0.0));
        for (std::size_t c = 0; c < 3; ++c)
            out[i + c] = static_cast<std::uint8_t>(
                std::lround(255.0f * shading::srgbEncode(color[static_cast<glm::length_t>(c)])));
    }
    return std::make_shared<const Image>(std::move(shown));
}

LitDocument litDocument(const Document& document, const RadiosityLightMap& map,
                        std::optional<double> exposure, double automatic) {
    LitDocument result = withoutLight(document, exposure);
    Document& lit = result.document;
    const ImagePtr shown = shownLightMap(*map.radiance, exposure);
    LitMeshes meshes;
    for (const LightMapSurface& surface : map.surfaces) {
        const auto instance =
            std::ranges::find(document.meshes, surface.instance, &MeshInstance::id);
        if (instance == document.meshes.end())
            continue;
        MeshInstance& copy = addPart(result, *instance, surface.back, surface.mesh);
        meshes[copy.id].lightMapUvs = surface.uvs;
        const auto material =
            std::ranges::find(document.materials, instance->material, &Material::id);
        if (material == document.materials.end()) {
            Material plain;
            plain.id = instance->material;
            plain.name = "Light map";
            if (std::ranges::find(lit.materials, plain.id, &Material::id) == lit.materials.end())
                lit.materials.push_back(blackBut(plain, shown));
        } else if (std::ranges::find(lit.materials, material->id, &Material::id) ==
                   lit.materials.end()) {
            lit.materials.push_back(blackBut(*material, shown));
        }
    }
    result.lit = std::make_shared<const LitMeshes>(std::move(meshes));
    result.lightMap =
        std::make_shared<const LitTexels>(LitTexels{map.radiance, shown, exposure, automatic});
    return result;
}

} // namespace patina
