#include "render/scene/GpuScene.h"

#include "core/bake/document/TexelPlaces.h"
#include "core/base/Check.h"
#include "core/base/Log.h"
#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/light/LobeTable.h"
#include "core/material/Material.h"
#include "core/mix/TransferLight.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "render/scene/LightBlocks.h"
#include "render/scene/LightMapTexture.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>

namespace patina::render {

namespace {

// A document may name a material that is not there (a damaged project): such meshes show in the
// default material.
constexpr Id kFallbackMaterial = 0;

// Of environments that are not shown: four of 2048 × 1024, or some fifteen of 1024 × 512.
constexpr std::size_t kKeptTextureBytes = std::size_t{96} << 20;

InstanceBlock packInstance(const MeshInstance& mesh) {
    const glm::mat3 linear(mesh.placement.matrix());
    InstanceBlock block;
    block.model = mesh.placement.matrix();
    block.handedness = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    // A flat transform (a scale of zero) has no inverse; its normals stay as they are.
    const bool invertible = glm::determinant(linear) != 0.0f;
    block.normalToWorld = glm::mat4(invertible ? glm::inverseTranspose(linear) : linear);
    block.id = mesh.id;
    block.materialId = mesh.material;
    return block;
}

ModelBlock packModel(const ShadingModel& model) {
    return {glm::vec4(model.conductorN, model.f90), glm::vec4(model.conductorK, model.ior)};
}

gl::Texture makeLobes(gl::Context& context) {
    gl::Texture texture(
        context, "lobes of area lights",
        {.format = gl::PixelFormat::Rgba32f, .width = kLobeTableSize, .height = kLobeTableSize});
    texture.upload(0, 4, gl::SampleType::F32, lobeTable().data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Clamp);
    return texture;
}

} // namespace

GpuScene::GpuScene(gl::Context& context)
    : m_context(context)
    , m_documentLight(context)
    , m_dfgTextures(context)
    , m_dfg(&m_dfgTextures.of(m_document.model))
    , m_modelBlock(context, "shading model", sizeof(ModelBlock))
    , m_lobes(makeLobes(context))
    , m_manyLights(context)
    , m_textures(context)
    , m_visibility(context, BakeKind::AoVertex)
    , m_transfer(context) {
    // What an empty document shows.
    m_modelBlock.writeValue(packModel(m_document.model));
    updateGpuMaterial(m_context, m_textures, Material{}, m_materials[kFallbackMaterial]);
}

Dirty GpuScene::update(const Document& document) {
    const Dirty dirty = dirtyBetween(m_document, document);
    m_document = document;

    std::erase_if(m_kept, [](const auto& kept) { return kept.source.expired(); });
    // Numbers of the view, the lights and the environment are read anew for each frame.
    m_documentLight.show(shownEnvironment(m_document));
    for (auto& [id, other] : m_otherLights)
        other.light.show(shownEnvironment(m_document, other.environment));
    if (dirty.model) {
        m_modelBlock.writeValue(packModel(m_document.model));
        m_dfg = &m_dfgTextures.of(m_document.model);
    }
    if (dirty.instances)
        updateMeshes();
    updateMaterials(dirty);
    if (dirty.bakes) {
        m_visibility.update(m_document);
        if (m_transfer.update(m_document))
            clearBouncedLight(); // it rests on what was there before
        updateTexelBakes();
        updateLightMaps();
    }
    if (dirty.casters)
        ++m_shapeRevision;
    if (dirty.places) {
        m_texelPlaces.clear();
        ++m_placeRevision;
    }
    if (dirty.instances || dirty.materialSet || dirty.bakes)
        rebuildItems();
    return dirty;
}

// --- Environments --------------------------------------------------------------------------------

LightId GpuScene::addLight(const Environment& environment) {
    const LightId id = ++m_lastLight;
    m_otherLights.emplace(id, OtherLight{environment, EnvironmentLight(m_context)});
    changeLight(id, environment);
    return id;
}

void GpuScene::changeLight(LightId light, const Environment& environment) {
    const auto found = m_otherLights.find(light);
    CHECK(found != m_otherLights.end());
    found->second.environment = environment;
    found->second.light.show(shownEnvironment(m_document, environment));
}

void GpuScene::removeLight(LightId light) {
    keepTextures(this->light(light).textures());
    CHECK(m_otherLights.erase(light) == 1);
    for (auto* lit : {&m_lit, &m_litTexels})
        for (auto& [id, elements] : *lit)
            elements.byLight.erase(light);
}

EnvironmentLight& GpuScene::light(LightId light) {
    return const_cast<EnvironmentLight&>(std::as_const(*this).light(light));
}

const EnvironmentLight& GpuScene::light(LightId light) const {
    if (light == kDocumentLight)
        return m_documentLight;
    const auto found = m_otherLights.find(light);
    CHECK(found != m_otherLights.end());
    return found->second.light;
}

const Environment& GpuScene::environment(LightId light) const {
    if (light == kDocumentLight)
        return m_document.environment();
    const auto found = m_otherLights.find(light);
    CHECK(found != m_otherLights.end());
    return found->second.environment;
}

const EnvironmentTextures* GpuScene::texturesOf(const EnvironmentTexelsPtr& texels) const {
    const auto isOf = [&](const EnvironmentTextures& textures) {
        return textures.source.lock() == texels;
    };
    if (!texels)
        return nullptr;
    if (isOf(m_documentLight.textures()))
        return &m_documentLight.textures();
    for (const auto& [id, other] : m_otherLights)
        if (isOf(other.light.textures()))
            return &other.light.textures();
    const auto kept = std::ranges::find_if(m_kept, isOf);
    return kept == m_kept.end() ? nullptr : &*kept;
}

void GpuScene::keepTextures(const EnvironmentTextures& textures) {
    std::erase_if(m_kept, [&](const EnvironmentTextures& kept) {
        return kept.source.expired() || kept.prefiltered == textures.prefiltered;
    });
    if (!textures.source.expired())
        m_kept.push_front(textures);
    std::size_t bytes = 0;
    std::erase_if(m_kept, [&](const EnvironmentTextures& kept) {
        bytes += kept.bytes();
        return bytes > kKeptTextureBytes;
    });
}

// --- What a document holds -----------------------------------------------------------------------

void GpuScene::updateMeshes() {
    std::set<MeshPtr> used;
    for (const MeshInstance& instance : m_document.meshes)
        if (instance.mesh)
            used.insert(instance.mesh);
    std::erase_if(m_meshes, [&](const auto& entry) { return !used.contains(entry.first); });
    for (const MeshPtr& mesh : used)
        if (!m_meshes.contains(mesh))
            m_meshes.emplace(mesh, makeGpuMesh(m_context, *mesh));
}

void GpuScene::updateMaterials(const Dirty& dirty) {
    // Until all are renewed, what they showed is held: a map that one hands to another stays.
    std::vector<PerInput<TexturePtr>> shown;
    for (const Id id : dirty.materials) {
        GpuMaterial& material = m_materials[id];
        shown.push_back(material.maps);
        updateGpuMaterial(m_context, m_textures, *m_document.material(id), material);
    }
    if (!dirty.materialSet)
        return;
    std::set<Id> ids{kFallbackMaterial};
    for (const Material& material : m_document.materials)
        ids.insert(material.id);
    std::erase_if(m_materials, [&](const auto& entry) { return !ids.contains(entry.first); });
}

void GpuScene::updateTexelBakes() {
    std::map<Id, TexturePtr> textures;
    for (const BakeArtifactPtr& bake : m_document.bakes)
        if (bake->kind == BakeKind::AoTexel)
            for (const TexelBake& texels : bake->texels)
                if (texels.image)
                    textures[texels.material] = m_textures.texture(texels.image);
    m_texelBakes = std::move(textures); // only now: what both hold is not uploaded again
}

void GpuScene::updateLightMaps() {
    BakeArtifactPtr bake = findBake(m_document, BakeKind::LightMap);
    if (bake == m_lightMapBake)
        return;
    m_lightMapBake = std::move(bake);
    m_lightMaps.clear();
    if (m_lightMapBake)
        for (const TexelBake& texels : m_lightMapBake->texels)
            m_lightMaps.emplace(texels.material, makeLightMap(m_context, texels));
}

void GpuScene::rebuildItems() {
    ++m_rebuilds;
    m_items.clear();
    m_bounds = {};
    std::set<Id> ids;
    for (const MeshInstance& instance : m_document.meshes) {
        ids.insert(instance.id);
        const auto mesh = m_meshes.find(instance.mesh);
        if (!instance.visible || mesh == m_meshes.end() || mesh->second.indexCount == 0)
            continue;
        DrawItem item;
        item.id = instance.id;
        item.materialId = instance.material;
        item.transform = instance.placement.matrix();
        item.mesh = &mesh->second;
        const auto material = m_materials.find(instance.material);
        item.material =
            material != m_materials.end() ? &material->second : &m_materials.at(kFallbackMaterial);

        attachBakes(item);
        const InstanceOnGpu& placed = onGpu(instance);
        item.instanceBlock = &placed.buffer;
        item.normalToWorld = glm::mat3(placed.block.normalToWorld);
        item.mirrored = placed.block.handedness < 0.0f;
        item.bounds = item.mesh->bounds.transformed(instance.placement.matrix());
        m_bounds.add(item.bounds);
        m_items.push_back(item);
    }
    std::erase_if(m_instances, [&](const auto& entry) { return !ids.contains(entry.first); });
    std::erase_if(m_lit, [&](const auto& entry) { return !ids.contains(entry.first); });
    std::erase_if(m_litTexels,
                  [&](const auto& entry) { return m_transfer.ofMaterial(entry.first) == nullptr; });
    applyNearShadows();
    rebuildRadiosityItems();
}

void GpuScene::setRadiosity(const ShownRadiosityPtr& radiosity) {
    const bool sameShape = radiosity && m_radiosity && radiosity->shape == m_radiosity->shape;
    m_radiosity = radiosity;
    if (!sameShape) {
        m_radiositySurfaces.clear();
        if (radiosity)
            for (const RadiositySurface& surface : radiosity->shape->surfaces) {
                RadiosityOnGpu& onGpu = m_radiositySurfaces.emplace_back();
                // Its light is that of all its vertices.
                onGpu.mesh = makeGpuMesh(m_context, *surface.mesh, false);
                onGpu.vertices = gl::Buffer(m_context, "radiosity",
                                            std::max<std::size_t>(surface.lights.size(), 1) *
                                                sizeof(RadiosityVertex));
                onGpu.instance = gl::Buffer(m_context, "instance", sizeof(InstanceBlock));
            }
        rebuildRadiosityItems();
    }
    if (!radiosity)
        return;
    constexpr float kPerPi = std::numbers::inv_pi_v<float>;
    std::vector<RadiosityVertex> values;
    for (std::size_t s = 0; s < m_radiositySurfaces.size(); ++s) {
        const RadiositySurface& surface = radiosity->shape->surfaces[s];
        values.clear();
        for (std::size_t v = 0; v < surface.lights.size(); ++v) {
            const ShownRadiosity::Element& element = radiosity->elements[surface.elements[v]];
            values.push_back({glm::vec4(kPerPi * radiosity->irradiance[surface.lights[v]], 0.0f),
                              glm::vec4(kPerPi * element.radiosity, element.area),
                              glm::vec4(kPerPi * element.unshot, element.share)});
        }
        m_radiositySurfaces[s].vertices.write(
            0, std::as_bytes(std::span<const RadiosityVertex>(values)));
    }
}

void GpuScene::rebuildRadiosityItems() {
    m_radiosityItems.clear();
    if (!m_radiosity)
        return;
    std::unordered_map<Id, const DrawItem*> items;
    for (const DrawItem& item : m_items)
        items.emplace(item.id, &item);
    const std::vector<RadiositySurface>& surfaces = m_radiosity->shape->surfaces;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto found = items.find(surfaces[s].instance);
        if (found == items.end())
            continue;
        const DrawItem* whole = found->second;
        RadiosityOnGpu& onGpu = m_radiositySurfaces[s];
        InstanceBlock block;
        block.id = whole->id;
        block.materialId = whole->materialId;
        onGpu.instance.writeValue(block);
        DrawItem item = *whole;
        item.mesh = &onGpu.mesh;
        item.instanceBlock = &onGpu.instance;
        item.radiosity = &onGpu.vertices;
        item.visibility = nullptr;
        item.transfer = nullptr;
        item.texelAo = item.lightMap = nullptr;
        item.transform = glm::mat4(1.0f);
        item.normalToWorld = glm::mat3(1.0f);
        item.mirrored = false;
        item.bounds = onGpu.mesh.bounds;
        m_radiosityItems.push_back(item);
    }
}

const std::vector<DrawItem>& GpuScene::items(LightingMode lighting, LightId light) const {
    const bool divided = lighting == LightingMode::Radiosity && !m_radiosityItems.empty() &&
                         environment(light) == environment(kDocumentLight);
    return divided ? m_radiosityItems : m_items;
}

const GpuScene::InstanceOnGpu& GpuScene::onGpu(const MeshInstance& mesh) {
    const InstanceBlock block = packInstance(mesh);
    InstanceOnGpu& known = m_instances[mesh.id];
    if (known.buffer.empty())
        known.buffer = gl::Buffer(m_context, "instance", sizeof(InstanceBlock));
    else if (std::memcmp(&known.block, &block, sizeof(block)) == 0)
        return known;
    known.buffer.writeValue(block);
    known.block = block;
    return known;
}

void GpuScene::attachBakes(DrawItem& item) {
    const auto count = item.mesh->vertexCount;
    const auto* ao = m_visibility.find(item.id, count);
    item.visibility = ao && ao->stride == 1 ? &ao->buffer : nullptr;
    item.transfer = m_transfer.ofMaterial(item.materialId);
    if (item.transfer == nullptr)
        item.transfer = m_transfer.ofMesh(item.id, count);
    const bool perTexel = item.transfer != nullptr && item.transfer->side > 0;
    item.litVertices = &m_lit[item.id];
    item.lit = perTexel ? &m_litTexels[item.materialId] : item.litVertices;
    item.texelAo = nullptr;
    if (const auto live = m_texelPreviews.find(item.materialId); live != m_texelPreviews.end())
        item.texelAo = &live->second;
    else if (const auto baked = m_texelBakes.find(item.materialId); baked != m_texelBakes.end())
        item.texelAo = baked->second.get();
    const auto lightMap = m_lightMaps.find(item.materialId);
    item.lightMap = lightMap != m_lightMaps.end() ? &lightMap->second : nullptr;
}

void GpuScene::previewVertices(BakeKind kind, Id mesh, int stride, std::span<const float> values) {
    CHECK(kind == BakeKind::AoVertex || kind == BakeKind::PrtVertex);
    if (kind == BakeKind::AoVertex)
        m_visibility.preview(mesh, stride, values);
    else
        m_transfer.preview(mesh, stride, values);
    for (DrawItem& item : m_items)
        if (item.id == mesh)
            attachBakes(item);
}

void GpuScene::previewTexels(Id material, int size, std::span<const float> values) {
    const auto side = static_cast<std::size_t>(size);
    CHECK_EQ(values.size(), side * side);
    gl::Texture& texture = m_texelPreviews[material];
    if (texture.width() != size) {
        texture = gl::Texture(m_context, "AO preview",
                              {.format = gl::PixelFormat::R32f, .width = size, .height = size});
        texture.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
    }
    texture.upload(0, 1, gl::SampleType::F32, values.data());
    for (DrawItem& item : m_items)
        if (item.materialId == material)
            attachBakes(item);
}

void GpuScene::clearPreview() {
    m_visibility.clearPreview();
    m_transfer.clearPreview();
    m_texelPreviews.clear();
    for (DrawItem& item : m_items)
        attachBakes(item);
}

void GpuScene::setBouncedLight(LightId light, Id mesh, std::span<const glm::vec3> radiance) {
    const auto found = m_lit.find(mesh);
    if (found == m_lit.end() || radiance.empty())
        return;
    std::vector<glm::vec4> values(radiance.size());
    std::ranges::transform(radiance, values.begin(),
                           [](const glm::vec3& c) { return glm::vec4(c, 0.0f); });
    LitByLight& lit = found->second.byLight[light];
    if (lit.bouncedLight.size() != values.size() * sizeof(glm::vec4))
        lit.bouncedLight =
            gl::Buffer(m_context, "bounced light", values.size() * sizeof(glm::vec4));
    lit.bouncedLight.write(0, std::as_bytes(std::span<const glm::vec4>(values)));
    ++lit.bouncedRevision;
}

void GpuScene::clearBouncedLight() {
    for (auto& [mesh, elements] : m_lit)
        for (auto& [light, lit] : elements.byLight)
            if (!lit.bouncedLight.empty()) {
                lit.bouncedLight = {};
                ++lit.bouncedRevision;
            }
}

void GpuScene::setNearShadows(const NearShadowsPtr& shadows) {
    m_nearShadows = shadows;
    applyNearShadows();
}

void GpuScene::applyNearShadows() {
    // The parts of meshes and of materials by id.
    std::unordered_map<Id, std::size_t> ofMeshes, ofMaterials;
    if (m_nearShadows)
        for (std::size_t p = 0; p < m_nearShadows->request.parts.size(); ++p) {
            const NearPart& part = m_nearShadows->request.parts[p];
            (part.side > 0 ? ofMaterials : ofMeshes).insert_or_assign(part.id, p);
        }
    const auto partOf = [](const std::unordered_map<Id, std::size_t>& parts, Id id) {
        const auto found = parts.find(id);
        return found != parts.end() ? std::optional(found->second) : std::nullopt;
    };
    for (auto& [mesh, lit] : m_lit)
        applyNearShadows(lit, partOf(ofMeshes, mesh));
    for (auto& [material, lit] : m_litTexels)
        applyNearShadows(lit, partOf(ofMaterials, material));
}

// `part`: of the shadows; nothing: they know none.
void GpuScene::applyNearShadows(LitElements& lit, std::optional<std::size_t> part) {
    constexpr std::size_t kMostBytes = std::size_t{64} << 20; // of a buffer; drivers take 128 MiB
    NearShareBuffers& known = lit.nearShares;
    std::vector<NearShares> sources;
    if (m_nearShadows && part)
        for (const std::vector<NearShares>& shares : m_nearShadows->shares)
            if (const NearShares& own = shares.at(*part); !own->empty())
                sources.push_back(own);
    CHECK(sources.empty() || sources.size() == m_nearShadows->shares.size());
    if (sources == known.sources)
        return;
    ++lit.nearSharesRevision;
    if (sources.empty()) {
        known = {};
        return;
    }
    // A light that moves renews its own.
    const std::size_t elements = sources.front()->size(), bytes = elements * sizeof(float);
    const bool fits = known.elements == elements && known.sources.size() == sources.size();
    if (!fits) {
        known.elements = elements;
        known.perBuffer = std::clamp<std::size_t>(kMostBytes / bytes, 1, sources.size());
        known.buffers.clear();
        for (std::size_t first = 0; first < sources.size(); first += known.perBuffer)
            known.buffers.emplace_back(m_context, "shares of lights",
                                       std::min(known.perBuffer, sources.size() - first) * bytes);
    }
    for (std::size_t l = 0; l < sources.size(); ++l) {
        CHECK_EQ(sources[l]->size(), elements);
        if (!fits || known.sources[l] != sources[l])
            known.buffers[l / known.perBuffer].write(l % known.perBuffer * bytes,
                                                     std::as_bytes(std::span(*sources[l])));
    }
    known.sources = std::move(sources);
}

std::vector<Id> GpuScene::nearShareLights() const {
    std::vector<Id> ids;
    if (m_nearShadows)
        for (const NearLight& light : m_nearShadows->request.lights)
            ids.push_back(light.id);
    return ids;
}

std::vector<glm::vec3> GpuScene::transferLight(LightId id, int order) const {
    std::vector<glm::vec3> sum = light(id).transferLight(
        id == kDocumentLight ? environmentParts(m_document)
                             : environmentParts(m_document, environment(id)),
        order);
    addDistantLights(m_document, order, sum);
    return sum;
}

const gl::Buffer& GpuScene::texelPlaces(Id material, int side) {
    const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    gl::Buffer& buffer = m_texelPlaces[material];
    if (buffer.size() != count * sizeof(TexelPlace))
        buffer = gl::Buffer::of<TexelPlace>(m_context, "places of texels",
                                            patina::texelPlaces(m_document, material, side));
    return buffer;
}

void GpuScene::fill(FrameBlock& frame, LightId id, float reflectionMix,
                    std::span<const Id> shadows) const {
    light(id).fill(frame);
    frame.mix = mixWeights(reflectionMix);
    packLights(m_document, shadows, frame);
}

void GpuScene::setManyLights(std::span<const Id> shadows) {
    m_manyLights.set(packLights(m_document, shadows), m_bounds);
}

} // namespace patina::render
