#include "core/trace/path/TraceScene.h"

#include "core/light/DfgTable.h"
#include "core/material/BrdfModel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace patina {
namespace {

constexpr int kDfgSize = static_cast<int>(shading::kDfgTableSize);

// Whether rays meet the same triangles, and pass through the same of them.
bool sameGeometry(const TraceInputs& a, const TraceInputs& b) {
    const auto solid = [](const Material& m, const Material& n) {
        return m.alphaMode == n.alphaMode &&
               (m.alphaMode == AlphaMode::Opaque ||
                (m.opacity == n.opacity && m.alphaCutoff == n.alphaCutoff &&
                 m.baseColorMap == n.baseColorMap));
    };
    return a.meshes == b.meshes && std::ranges::all_of(a.meshes, [&](const TraceMesh& mesh) {
               return solid(a.materials.at(mesh.material), b.materials.at(mesh.material));
           });
}

bool sameLobe(const ShadingModel& a, const ShadingModel& b) {
    return a.distribution == b.distribution && a.visibility == b.visibility;
}

} // namespace

Result<void> TraceScene::buildGeometry(const JobContext& job, const TraceScene* previous) {
    BakeInputs geometry;
    for (const TraceMesh& mesh : m_inputs.meshes) {
        if (!mesh.mesh || mesh.mesh->indices.empty())
            continue; // as makeBakeGeometry() does
        const Material& material = m_inputs.materials.at(mesh.material);
        geometry.meshes.push_back({mesh.id, material.id, mesh.mesh, mesh.transform,
                                   material.doubleSided, bakeSurface(material)});
        const glm::mat3 linear(mesh.transform);
        m_instances.push_back(
            {mesh.material, linear, glm::determinant(linear) < 0.0f ? -1.0f : 1.0f, {}});
    }
    if (geometry.meshes.empty())
        return {};
    if (previous != nullptr && sameGeometry(m_inputs, previous->m_inputs)) {
        m_scene = previous->m_scene;
    } else {
        Result<BakeScene> scene = BakeScene::build(geometry, job);
        if (!scene)
            return scene.error();
        m_scene = std::make_shared<const BakeScene>(*std::move(scene));
    }
    m_centre = m_scene->geometry->centre;
    m_metresPerUnit = static_cast<float>(1.0 / m_scene->geometry->unitsPerMetre);
    return {};
}

Result<TraceScene> TraceScene::build(const TraceInputs& inputs, const JobContext& job,
                                     const TraceScene* previous) {
    TraceScene result;
    result.m_inputs = inputs;
    if (Result<void> built = result.buildGeometry(job, previous); !built)
        return built.error();
    result.m_materials.reserve(inputs.materials.size());
    for (const Material& material : inputs.materials)
        result.m_materials.emplace_back(material);
    for (const TraceEnvironment& environment : inputs.environments) {
        std::shared_ptr<const EnvironmentSampler> sampler;
        if (previous != nullptr) {
            const auto& known = previous->m_inputs.environments;
            if (const auto same = std::ranges::find(known, environment); same != known.end())
                sampler = previous->m_environments[static_cast<std::size_t>(same - known.begin())];
        }
        result.m_environments.push_back(
            sampler ? sampler : std::make_shared<const EnvironmentSampler>(environment));
        result.m_environmentPower += result.m_environments.back()->power();
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    }
    result.m_lights = LightSampler(inputs.lights);
    result.m_model = brdfModel(inputs.model);
    if (previous != nullptr && sameLobe(inputs.model, previous->m_inputs.model)) {
        result.m_dfg = previous->m_dfg;
    } else {
        const Image table =
            computeDfgTable(kDfgSize, inputs.model.distribution,
                            iblVisibility(inputs.model.visibility), DfgTexels::ToTheEnds);
        std::vector<glm::vec3> dfg;
        for (std::size_t i = 0; i < table.f32().size(); i += 3)
            dfg.emplace_back(table.f32()[i], table.f32()[i + 1], table.f32()[i + 2]);
        result.m_dfg = std::make_shared<const std::vector<glm::vec3>>(std::move(dfg));
    }
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    result.collectEmissive();
    result.collectGlass(previous);
    return result;
}

// Tables for faces between a body and air; between two bodies light between facets stays lost.
void TraceScene::collectGlass(const TraceScene* previous) {
    const auto add = [&](float eta, bool thinWalled) {
        const auto isThat = [&](const GlassTable& table) {
            return table.thinWalled == thinWalled && (thinWalled || table.eta == eta);
        };
        if (std::ranges::any_of(m_glassTables, isThat))
            return;
        if (previous != nullptr)
            if (const auto known = std::ranges::find_if(previous->m_glassTables, isThat);
                known != previous->m_glassTables.end()) {
                m_glassTables.push_back(*known);
                return;
            }
        m_glassTables.push_back(
            {eta, thinWalled, std::make_shared<const GlassAlbedo>(eta, thinWalled)});
    };
    for (const Instance& instance : m_instances) {
        const TraceMaterial& material = m_materials[instance.material];
        if (!material.transmits())
            continue;
        const float ior = indexOf(material);
        const bool thinWalled = material.glass().thinWalled;
        const bool straight = thinWalled || glassEta(ior, 1.0f) == 1.0f;
        (straight ? m_hasStraightGlass : m_hasSolidGlass) = true;
        if (!material.mayBeRough())
            continue;
        add(thinWalled ? 1.5f : glassEta(ior, 1.0f), thinWalled);
        if (!thinWalled)
            add(glassEta(1.0f, ior), false);
    }
}

std::optional<std::string> TraceScene::limit() const {
    if (!m_hasSolidGlass || m_lights.empty() || !m_lights.anyWithoutExtent())
        return std::nullopt;
    return "Points, spots and directional lights without softness do not shine through solid "
           "transmissive materials, which no path can find them through: take spheres, rectangles, "
           "glowing meshes or a softness above 0°, or make the material thin-walled.";
}

// As makeSurface() has it.
float TraceScene::indexOf(const TraceMaterial& material) const {
    return shading::modelOfIndex(m_model, material.ior()).ior;
}

void TraceScene::collectEmissive() {
    if (m_scene)
        for (std::uint32_t m = 0; m < m_scene->geometry->meshes.size(); ++m) {
            const BakeGeometryMesh& mesh = m_scene->geometry->meshes[m];
            const TraceMaterial& material = m_materials[m_instances[m].material];
            if (!material.emits())
                continue;
            if (mesh.surface.alphaMode != AlphaMode::Opaque)
                m_instances[m].coverage = std::make_shared<const Coverage>(mesh.surface);
            const auto luminance = static_cast<double>(shading::luminance(material.emissive()));
            const double squareMetres = static_cast<double>(m_metresPerUnit) * m_metresPerUnit;
            const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
            for (std::size_t i = 0; i < indices.size(); i += 3) {
                const glm::vec3 a = mesh.positions[indices[i]];
                const glm::vec3 normal = glm::cross(mesh.positions[indices[i + 1]] - a,
                                                    mesh.positions[indices[i + 2]] - a);
                m_emissive.add({m, static_cast<std::uint32_t>(i / 3)},
                               0.5 * static_cast<double>(glm::length(normal)) * squareMetres,
                               luminance);
            }
        }
    m_emissive.finish();
}

ClosestRay TraceScene::closest(const glm::vec3& origin, const glm::vec3& direction) const {
    ClosestRay ray;
    ray.ray.origin = origin;
    ray.ray.direction = direction;
    if (m_scene)
        m_scene->rays.intersect({&ray, 1});
    return ray;
}

bool TraceScene::occluded(const glm::vec3& origin, const glm::vec3& direction,
                          float distance) const {
    if (!m_scene)
        return false;
    OcclusionRay ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.maxDistance = distance;
    m_scene->rays.occlude({&ray, 1});
    return ray.occluded();
}

TracePoint TraceScene::pointAt(const ClosestRay& hit) const {
    return pointAt(hit.mesh, hit.triangle, {hit.u, hit.v}, &hit.ray.direction);
}

TracePoint TraceScene::pointAt(const EmissiveTriangles::Triangle& triangle,
                               const glm::vec2& weights) const {
    return pointAt(triangle.mesh, triangle.index, weights, nullptr);
}

TracePoint TraceScene::pointAt(std::uint32_t meshIndex, std::uint32_t triangle,
                               const glm::vec2& weights, const glm::vec3* direction) const {
    const BakeGeometryMesh& mesh = m_scene->geometry->meshes[meshIndex];
    const Instance& instance = m_instances[meshIndex];
    const std::uint32_t* index = mesh.mesh->indices.data() + 3 * std::size_t{triangle};
    const glm::vec3 w(1.0f - weights.x - weights.y, weights.x, weights.y);
    const auto between = [&](const auto& values) {
        return w.x * values[index[0]] + w.y * values[index[1]] + w.z * values[index[2]];
    };
    const glm::vec3 a = mesh.positions[index[0]], b = mesh.positions[index[1]],
                    c = mesh.positions[index[2]];
    TracePoint point;
    point.mesh = meshIndex;
    point.triangle = triangle;
    point.position = w.x * a + w.y * b + w.z * c;
    point.uv = between(mesh.mesh->uvs);
    point.material = &m_materials[instance.material];
    // The front: where the corners run counter-clockwise.
    const glm::vec3 cross = mesh.winding * glm::cross(b - a, c - a);
    const float length = glm::length(cross);
    point.face = length > 0.0f ? cross / length : glm::vec3(0.0f, 1.0f, 0.0f);
    if (direction == nullptr) {
        point.normal = point.face;
        return point;
    }
    point.isBack = glm::dot(point.face, *direction) > 0.0f;
    const glm::vec3 smooth = between(mesh.normals);
    const float smoothLength = glm::length(smooth);
    point.normal = smoothLength > 0.0f ? smooth / smoothLength : point.face;
    if (point.material->hasNormalMap()) {
        const glm::vec4 tangent = between(mesh.mesh->tangents);
        point.normal = point.material->shadingNormal(
            point.normal,
            glm::vec4(instance.linear * glm::vec3(tangent), tangent.w * instance.handedness),
            point.uv);
    }
    if (point.isBack) {
        point.face = -point.face;
        point.normal = -point.normal;
    }
    return point;
}

// Bilinear between texels at i / (size - 1), both coordinates in 0…1.
glm::vec3 TraceScene::dfg(float NoV, float perceptualRoughness) const {
    const float x = std::clamp(NoV, 0.0f, 1.0f) * (kDfgSize - 1);
    const float y = std::clamp(perceptualRoughness, 0.0f, 1.0f) * (kDfgSize - 1);
    const int i = std::min(static_cast<int>(x), kDfgSize - 2),
              j = std::min(static_cast<int>(y), kDfgSize - 2);
    const glm::vec3* texel = m_dfg->data() + j * kDfgSize + i;
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return glm::mix(glm::mix(texel[0], texel[1], fx),
                    glm::mix(texel[kDfgSize], texel[kDfgSize + 1], fx), fy);
}

shading::SurfaceTerms TraceScene::surface(const TracePoint& point, const glm::vec3& v) const {
    const shading::SurfaceInputs inputs = point.material->inputsAt(point.uv);
    const float NoV = glm::clamp(glm::dot(point.normal, v), shading::kMinNoV, 1.0f);
    return shading::makeSurface(m_model, inputs, point.normal, v,
                                glm::vec2(dfg(NoV, inputs.perceptualRoughness)));
}

glm::vec3 TraceScene::lobeDirection(const shading::SurfaceTerms& terms) const {
    return glm::normalize(
        shading::lobeDirection(terms, dfg(terms.NoV, terms.perceptualRoughness).z));
}

TraceSurface TraceScene::surfaceIn(const TracePoint& point, const glm::vec3& v,
                                   const Media& media) const {
    TraceSurface surface;
    shading::SurfaceInputs inputs = point.material->inputsAt(point.uv);
    const float NoV = glm::clamp(glm::dot(point.normal, v), shading::kMinNoV, 1.0f);
    const glm::vec2 entry(dfg(NoV, inputs.perceptualRoughness));
    // KHR_materials_transmission: mix(mix(opaque non-metal, glass, transmission), metal, metallic).
    // Without the glass there remain the metal and the opaque non-metal in their proportion.
    surface.glassShare = inputs.transmission * (1.0f - inputs.metallic);
    if (surface.glassShare > 0.0f) {
        surface.ior = indexOf(*point.material);
        surface.glass = glassTerms(point, v, inputs, media, surface.ior);
        inputs.metallic = surface.glassShare < 1.0f
                              ? std::min(inputs.metallic / (1.0f - surface.glassShare), 1.0f)
                              : 0.0f;
        inputs.transmission = 0.0f;
    }
    surface.opaque = shading::makeSurface(m_model, inputs, point.normal, v, entry);
    return surface;
}

GlassTerms TraceScene::glassTerms(const TracePoint& point, const glm::vec3& v,
                                  const shading::SurfaceInputs& inputs, const Media& media,
                                  float ior) const {
    GlassTerms glass;
    glass.v = v;
    glass.thinWalled = point.material->glass().thinWalled;
    glass.tint = inputs.baseColor;
    if (glass.thinWalled) {
        glass.eta = glassEta(ior, 1.0f);
    } else if (!point.isBack) {
        glass.eta = glassEta(ior, media.innermost().ior);
    } else {
        Media outside = media;
        outside.leave(point.material);
        glass.eta = glassEta(outside.innermost().ior, ior);
    }
    glass.alpha = glassAlpha(inputs.perceptualRoughness, glass.eta, glass.thinWalled);
    // A normal that is interpolated or mapped and would mirror light into the surface is bent just
    // so far that it does not: glass that loses light at its rim has a black one.
    constexpr float kLeastAbove = 1e-3f;
    const glm::vec3 mirrored = 2.0f * glm::dot(point.normal, v) * point.normal - v;
    const float above = glm::dot(mirrored, point.face);
    glass.n =
        above >= kLeastAbove
            ? point.normal
            : glm::normalize(v + glm::normalize(mirrored + (kLeastAbove - above) * point.face));
    glass.NoV = glm::clamp(glm::dot(glass.n, v), shading::kMinNoV, 1.0f);
    if (!glass.isSmooth() && m_model.multiScatter != 0)
        for (const GlassTable& table : m_glassTables)
            if (table.thinWalled == glass.thinWalled &&
                (table.thinWalled || table.eta == glass.eta))
                glass.gain = 1.0f / table.albedo->at(glass.NoV, inputs.perceptualRoughness);
    return glass;
}

glm::vec3 TraceScene::toWorld(const glm::vec3& scenePoint) const {
    return glm::vec3(m_centre + glm::dvec3(scenePoint) * static_cast<double>(m_metresPerUnit));
}

glm::vec3 TraceScene::toScene(const glm::dvec3& worldPoint) const {
    return glm::vec3((worldPoint - m_centre) / static_cast<double>(m_metresPerUnit));
}

// --- Environments --------------------------------------------------------------------------------

glm::vec3 TraceScene::environmentRadiance(const glm::vec3& direction) const {
    glm::vec3 sum(0.0f);
    for (const auto& environment : m_environments)
        sum += environment->radiance(direction);
    return sum;
}

glm::vec3 TraceScene::meanEnvironment() const {
    glm::vec3 sum(0.0f);
    for (const auto& environment : m_environments)
        sum += environment->mean();
    return sum;
}

EnvironmentSampler::Sample TraceScene::sampleEnvironment(glm::vec2 u) const {
    return endOf(EnvironmentSampler::find(searchEnvironment(u)));
}

// One of them by its power, and a direction of it.
EnvironmentSampler::Search TraceScene::searchEnvironment(glm::vec2 u) const {
    if (!hasEnvironment())
        return {};
    if (m_environments.size() == 1)
        return m_environments.front()->begin(u);
    const EnvironmentSampler* chosen = m_environments.front().get();
    float before = 0.0f;
    for (const auto& environment : m_environments) {
        const auto share = static_cast<float>(environment->power() / m_environmentPower);
        if (!(share > 0.0f))
            continue;
        chosen = environment.get();
        if (u.x < before + share) {
            u.x = std::clamp((u.x - before) / share, 0.0f, 1.0f - 0x1p-24f);
            break;
        }
        before += share;
    }
    return chosen->begin(u);
}

EnvironmentSampler::Sample TraceScene::endOf(const EnvironmentSampler::Search& search) const {
    EnvironmentSampler::Sample sample = EnvironmentSampler::end(search);
    if (m_environments.size() > 1 && hasEnvironment()) {
        sample.pdf = environmentPdf(sample.direction);
        sample.radiance = environmentRadiance(sample.direction);
    }
    return sample;
}

EnvironmentSampler::Lookup TraceScene::lookUpEnvironment(const glm::vec3& direction) const {
    if (m_environments.size() == 1 && hasEnvironment())
        return m_environments.front()->lookUp(direction);
    return {environmentRadiance(direction), environmentPdf(direction)};
}

float TraceScene::environmentPdf(const glm::vec3& direction) const {
    if (!hasEnvironment())
        return 0.0f;
    double sum = 0.0;
    for (const auto& environment : m_environments)
        sum += environment->power() / m_environmentPower *
               static_cast<double>(environment->pdf(direction));
    return static_cast<float>(sum);
}

} // namespace patina
