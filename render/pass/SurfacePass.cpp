#include "render/pass/SurfacePass.h"

#include "core/document/Lighting.h"
#include "core/document/ViewChoices.h"
#include "render/shader/GeneratedShaders.h"

#include <algorithm>
#include <array>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace patina::render {

namespace {

// Bit i of SurfaceFeature.
constexpr std::array<const char*, kSurfaceFeatureCount> kDefines{
    "HAS_MOVED_MAPS",     "HAS_PICKED_COLORS",   "ALPHA_MASK",       "ALPHA_BLEND",
    "DOUBLE_SIDED",       "HAS_PLACEHOLDER",     "HAS_TEXEL_AO",     "HAS_VERTEX_AO",
    "HAS_TRANSFER",       "HAS_PUNCTUAL_LIGHTS", "HAS_AREA_LIGHTS",  "HAS_SHADOWS",
    "HAS_SHADOWS_2",      "HAS_SHADOWS_3",       "HAS_SHADOWS_4",    "HAS_DOMINANT_LIGHT",
    "HAS_TEXEL_TRANSFER", "HAS_TRANSFER_CONE",   "HAS_TRANSMISSION", "HAS_IOR",
    "THIN_WALLED",        "HAS_LIGHT_MAP",       "HAS_RADIOSITY",    "HAS_SH_IRRADIANCE"};

// The choices of the model: name of the define, value, default.
struct ModelChoice {
    const char* name;
    int value, standard;
};

std::array<ModelChoice, 6> modelChoices(const ShadingModel& model) {
    const ShadingModel standard;
    return {{{"MODEL_DISTRIBUTION", int(model.distribution), int(standard.distribution)},
             {"MODEL_VISIBILITY", int(model.visibility), int(standard.visibility)},
             {"MODEL_FRESNEL", int(model.fresnel), int(standard.fresnel)},
             {"MODEL_DIFFUSE", int(model.diffuse), int(standard.diffuse)},
             {"MODEL_MULTI_SCATTER", int(model.multiScatter), int(standard.multiScatter)},
             {"MODEL_LOBE_DIRECTION", int(model.lobeDirection), int(standard.lobeDirection)}}};
}

// Four bits each.
unsigned modelKey(const ShadingModel& model) {
    unsigned key = 0;
    for (const ModelChoice& choice : modelChoices(model))
        key = key << 4 | static_cast<unsigned>(choice.value);
    return key;
}

constexpr unsigned kVisibilityUnit = 6, kPrefilteredUnit = 7, kDfgUnit = 8, kLobesUnit = 9,
                   kExitUnit = 13, kConeUnit = 14, kNumbersUnit = 15, // 10…12: shadows
    kLightMapUnit = kExitUnit; // a light map and transfer never light a surface together

// A few lights are unrolled into the program, which is much faster on software OpenGL; many, or
// area lights, whose code is long, run in loops. Zero: loops. Shadows are unrolled with their
// lights: a loop would index their visibilities by a variable, which takes llvmpipe longer to
// compile and to draw.
glm::ivec4 unrolledEnds(const SurfaceSettings& settings) {
    constexpr int kMostUnrolled = 4;
    const bool few = settings.output == SurfaceOutput::Picture && settings.hasPunctualLights &&
                     !settings.hasAreaLights && settings.lightEnds.y <= kMostUnrolled;
    return few ? settings.lightEnds : glm::ivec4(0);
}

std::vector<const char*> outputDefines(SurfaceOutput output) {
    switch (output) {
    case SurfaceOutput::Picture:
        break;
    case SurfaceOutput::OneView:
        return {"VIEWS", "VIEW_OUTPUTS 1"};
    case SurfaceOutput::EightViews:
        return {"VIEWS", "VIEW_OUTPUTS 8"};
    case SurfaceOutput::Inspection:
        return {"VIEWS", "INSPECT"};
    }
    return {};
}

// Eight bits each.
unsigned endsKey(const glm::ivec4& ends) {
    unsigned key = 0;
    for (int i = 0; i < 4; ++i)
        key = key << 8 | static_cast<unsigned>(ends[i]);
    return key;
}

} // namespace

SurfaceFeatures surfaceFeatures(const SurfaceFeatures& material, const SurfaceBakes& bakes,
                                const SurfaceSettings& settings) {
    SurfaceFeatures result = material;
    unsigned& features = result.flags;
    if (settings.hasPunctualLights)
        features |= HasPunctualLights;
    for (int i = 0; i < settings.shadows; ++i)
        features |= HasShadows << i;
    if (settings.hasAreaLights)
        features |= HasAreaLights;
    const bool openSky = settings.lighting == LightingMode::Unshadowed;
    if (openSky || (readsBake(settings.lighting) && bakes.transfer))
        features |= HasTransfer;
    // Views show what a bake knows in other light, too; only an open sky knows of none.
    if (bakes.transfer &&
        (readsBake(settings.lighting) || (settings.output != SurfaceOutput::Picture && !openSky))) {
        features |= HasTransferCone;
        if (bakes.texelTransfer)
            features |= HasTexelTransfer;
    }
    if (settings.lighting == LightingMode::Cosine)
        features |= HasDominantLight;
    if (settings.lighting == LightingMode::ShIrradiance)
        features |= HasShIrradiance;
    if (bakes.radiosity) { // it has all diffuse light, and the shadows of all
        features |= HasTransfer | HasRadiosity;
        return result;
    }
    // Its light is that of the document's own environment.
    if (settings.lighting == LightingMode::LightMap && bakes.lightMap &&
        settings.isDocumentsLight) {
        features |= HasLightMap;
        result.maps[MaterialInput::Occlusion] = {};
        return result;
    }
    // One source of ambient visibility is used; the others would only cost fetches.
    if (bakes.texelAo)
        features |= HasTexelAo;
    else if (bakes.vertexAo)
        features |= HasVertexAo;
    if (hidesNothing(settings.lighting) || result.has(HasTexelAo | HasVertexAo))
        result.maps[MaterialInput::Occlusion] = {};
    if (hidesNothing(settings.lighting))
        features &= ~static_cast<unsigned>(HasTexelAo | HasVertexAo);
    return result;
}

SurfaceFeatures surfaceFeatures(const DrawItem& item, const SurfaceSettings& settings) {
    return surfaceFeatures(item.material->features,
                           {item.transfer != nullptr, item.transfer && item.transfer->side > 0,
                            item.texelAo != nullptr, item.visibility != nullptr,
                            item.lightMap != nullptr, item.radiosity != nullptr},
                           settings);
}

SurfaceVariant surfaceVariant(const SurfaceFeatures& features, const SurfaceSettings& settings) {
    return {features, modelKey(settings.model), endsKey(unrolledEnds(settings)),
            (settings.hasManyLights() ? 1u << 8 : 0u) |
                static_cast<unsigned>(settings.output) << 1 | (settings.floats ? 1u : 0u)};
}

void hashVariant(Hasher& hasher, const SurfaceVariant& variant) {
    hasher.value(variant.features.flags);
    for (const MapUse& map : variant.features.maps.values)
        hasher.value(map.used).value(map.channel).value(map.texelOf);
    hasher.value(variant.model).value(variant.lightEnds).value(variant.output);
}

std::vector<std::string> surfaceDefines(const SurfaceFeatures& features) {
    std::vector<std::string> defines;
    for (std::size_t bit = 0; bit < kDefines.size(); ++bit)
        if (features.has(1u << bit))
            defines.emplace_back(kDefines[bit]);
    for (const MaterialInputInfo& info : kMaterialInputs) {
        const MapUse& use = features.maps[info.input];
        if (!use.used)
            continue;
        const std::string name = inputDefine(info);
        defines.push_back(fmt::format("HAS_{}_MAP", name));
        if (!readsOneChannel(info))
            continue;
        const auto owner = static_cast<MaterialInput>(use.texelOf);
        defines.push_back(
            fmt::format("{}_TEXEL {}.{}", name, texelName(inputInfo(owner)), "rgba"[use.channel]));
        if (owner == info.input)
            defines.push_back("FETCH_" + name);
    }
    return defines;
}

std::vector<std::string> modelDefines(const ShadingModel& model) {
    std::vector<std::string> defines;
    for (const ModelChoice& choice : modelChoices(model))
        if (choice.value != choice.standard)
            defines.push_back(std::string(choice.name) + ' ' + std::to_string(choice.value));
    return defines;
}

void drawItem(const DrawItem& item, bool cull, const GpuMesh::Coarse* coarse,
              std::span<const TriangleRange> ranges) {
    (cull ? glEnable : glDisable)(GL_CULL_FACE);
    glFrontFace(item.mirrored ? GL_CW : GL_CCW);
    item.instanceBlock->bindUniform(kInstanceBinding);
    item.material->block.bindUniform(kMaterialBinding);
    item.mesh->array.bind();
    const GpuMesh& mesh = *item.mesh;
    const auto draw = [](std::uint64_t firstIndex, std::uint64_t count) {
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(
                           static_cast<std::uintptr_t>(firstIndex * sizeof(std::uint32_t))));
    };
    if (coarse != nullptr)
        return draw(static_cast<std::uint64_t>(coarse->first),
                    static_cast<std::uint64_t>(coarse->count));
    if (ranges.empty())
        return draw(0, static_cast<std::uint64_t>(mesh.indexCount));
    for (const TriangleRange& range : ranges)
        draw(3 * range.first, 3 * range.count);
}

// `wanted` of the triangles in `ranges`, counted from the first of them.
static std::vector<TriangleRange> part(const std::vector<TriangleRange>& ranges,
                                       const TriangleRange& wanted) {
    std::vector<TriangleRange> result;
    std::uint64_t before = 0;
    for (const TriangleRange& range : ranges) {
        const std::uint64_t first = std::max(before, wanted.first);
        const std::uint64_t end = std::min(before + range.count, wanted.end());
        if (first < end)
            result.push_back({range.first + first - before, end - first});
        before += range.count;
    }
    return result;
}

// What the variant reads of a bake: textures, or attributes of the mesh's vertices.
static void bindTransfer(const DrawItem& item, const SurfaceFeatures& features,
                         const SurfaceSettings& settings) {
    const LightingMode lighting = settings.lighting;
    if (features.has(HasRadiosity)) {
        constexpr std::size_t kVertex = sizeof(RadiosityVertex);
        const gl::VertexArray& array = item.mesh->array;
        array.setFloats(4, 3, *item.radiosity, offsetof(RadiosityVertex, exitRadiance), kVertex);
        array.setFloats(5, 4, *item.radiosity, offsetof(RadiosityVertex, sent), kVertex);
        array.setFloats(6, 4, *item.radiosity, offsetof(RadiosityVertex, unshot), kVertex);
        return;
    }
    if (features.has(HasTexelTransfer)) {
        if (features.has(HasTransfer))
            item.lit->stage(settings.light, lighting).texels.bind(kExitUnit);
        item.transfer->coneTexels.bind(kConeUnit);
        if (!item.transfer->numberTexels.empty())
            item.transfer->numberTexels.bind(kNumbersUnit);
        else
            glBindTextureUnit(kNumbersUnit, 0); // reads as zero
        return;
    }
    const gl::VertexArray& array = item.mesh->array;
    constexpr std::size_t kVector = 4 * sizeof(float);
    if (features.has(HasTransfer)) {
        const LitElements& lit =
            lighting == LightingMode::Unshadowed ? *item.litVertices : *item.lit;
        array.setFloats(4, 3, lit.stage(settings.light, lighting).values, 0, kVector);
    }
    if (features.has(HasTransferCone)) {
        array.setFloats(5, 4, item.transfer->cone, 0, kVector);
        if (!item.transfer->numbers.empty())
            array.setFloats(6, 2, item.transfer->numbers, 0, 2 * sizeof(float));
        else
            array.setConstant(6);
    }
}

Result<const gl::Program*> SurfacePass::program(const SurfaceFeatures& features,
                                                const SurfaceSettings& settings) {
    const SurfaceVariant variant = surfaceVariant(features, settings);
    if (m_drops != m_shaders.drops()) {
        m_drops = m_shaders.drops();
        m_programs.clear();
    }
    if (const auto known = m_programs.find(variant); known != m_programs.end()) {
        m_shaders.touch(*known->second);
        return known->second;
    }
    std::vector<std::string> defines = surfaceDefines(features);
    for (std::string& define : modelDefines(settings.model))
        defines.push_back(std::move(define));
    if (const glm::ivec4 ends = unrolledEnds(settings); ends != glm::ivec4(0))
        defines.push_back(
            fmt::format("LIGHT_ENDS ivec4({}, {}, {}, {})", ends.x, ends.y, ends.z, ends.w));
    if (settings.hasManyLights())
        defines.emplace_back("MANY_LIGHTS");
    for (const char* define : outputDefines(settings.output))
        defines.emplace_back(define);
    if (settings.floats)
        defines.emplace_back("FLOATS");
    defines.insert(defines.end(), m_studyDefines.begin(), m_studyDefines.end());
    auto made = m_shaders.program({{"surface.vert", "surface.frag"}, std::move(defines)});
    if (made)
        m_programs.emplace(variant, *made);
    return made;
}

Result<void> SurfacePass::draw(const GpuScene& scene, const std::vector<const DrawItem*>& items,
                               const SurfaceSettings& settings) {
    scene.light(settings.light).prefiltered().bind(kPrefilteredUnit);
    scene.dfg().bind(kDfgUnit);
    scene.modelBlock().bindUniform(kModelBinding);
    scene.lobes().bind(kLobesUnit);
    TriangleRange rest = settings.triangles; // of this item and those after it
    for (const DrawItem* item : items) {
        const std::vector<TriangleRange> visible = visibleTriangles(*item, settings.clip);
        const std::vector<TriangleRange> ranges = part(visible, rest);
        std::uint64_t count = 0;
        for (const TriangleRange& range : visible)
            count += range.count;
        const std::uint64_t end = rest.end() > count ? rest.end() - count : 0;
        const std::uint64_t first = rest.first > count ? rest.first - count : 0;
        rest = {first, end - first};
        if (ranges.empty())
            continue;
        const SurfaceFeatures features = surfaceFeatures(*item, settings);
        const auto shader = program(features, settings);
        if (!shader)
            return shader.error();
        (*shader)->use();
        for (const MaterialInputInfo& info : kMaterialInputs)
            bindMap(*item->material, info.input);
        if (features.has(HasTexelAo))
            item->texelAo->bind(kVisibilityUnit);
        if (features.has(HasVertexAo))
            item->visibility->bindStorage(kVisibilityBinding);
        bindTransfer(*item, features, settings);
        if (features.has(HasLightMap))
            item->lightMap->bind(kLightMapUnit);
        drawItem(*item, isCulled(*item),
                 settings.coarseView ? coarseFor(*item, *settings.coarseView) : nullptr, ranges);
    }
    return {};
}

Result<void> SurfacePass::drawOpaque(const GpuScene& scene, const DrawList& list,
                                     const SurfaceSettings& settings) {
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    return draw(scene, list.opaque, settings);
}

Result<void> SurfacePass::drawBlended(const GpuScene& scene, const DrawList& list,
                                      const SurfaceSettings& settings) {
    if (list.blended.empty())
        return {};
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied
    glDepthMask(GL_FALSE);
    Result<void> done = draw(scene, list.blended, settings);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    return done;
}

} // namespace patina::render
