#include "core/export/ExportContents.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/lightmap/LightMap.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/base/ById.h"
#include "core/document/AbsentBake.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/export/GltfEnvironment.h"
#include "core/export/Names.h"
#include "core/export/Variants.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/material/ModelPresets.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace patina {
namespace {

void addInstances(const Document& document, const ExportSettings& settings,
                  ExportContents& contents) {
    const ById materials(document.materials);
    std::unordered_map<const Material*, int> exportedAs;
    for (const MeshInstance& instance : document.meshes) {
        if (settings.visibleOnly && !instance.visible)
            continue;
        if (instance.mesh == nullptr || instance.mesh->triangleCount() == 0) {
            contents.warnings.push_back(
                fmt::format("{}: there are no triangles to export", instance.name));
            continue;
        }
        ExportedInstance exported{&instance, decomposeMatrix(instance.placement.matrix()), -1};
        if (exported.transform.empty()) {
            contents.warnings.push_back(fmt::format(
                "{}: its transform flattens it to nothing and will be left out", instance.name));
            continue;
        }
        if (const Material* material = materials.find(instance.material)) {
            const auto [known, isNew] =
                exportedAs.try_emplace(material, static_cast<int>(contents.materials.size()));
            exported.material = known->second;
            if (isNew)
                contents.materials.push_back(material);
        }
        contents.instances.push_back(std::move(exported));
    }
}

// The snapshots, whose materials come behind those of the document; equal ones once.
void addVariants(const Document& document, const ExportSettings& settings,
                 ExportContents& contents) {
    if (!settings.includeVariants || !hasMaterialVariants(document))
        return;
    bool differs = false; // in what is exported
    for (ExportedInstance& exported : contents.instances)
        for (const Material* variant : variantsOf(document, *exported.instance)) {
            exported.variants.push_back(-1);
            if (variant == nullptr)
                continue;
            const auto known = std::ranges::find_if(contents.materials, [&](const Material* other) {
                return other == variant || *other == *variant;
            });
            exported.variants.back() = static_cast<int>(known - contents.materials.begin());
            if (known == contents.materials.end())
                contents.materials.push_back(variant);
            differs = true;
        }
    if (differs)
        for (const Snapshot& snapshot : document.snapshots)
            contents.variants.push_back(snapshot.name);
}

void warnAboutLightMap(const Document& document, const BakeArtifact& bake,
                       std::vector<std::string>& warnings) {
    if (bake.inputs != hashBakeInputs(bakeInputs(document)))
        warnings.emplace_back("the baked light map is older than the geometry; bake it again to "
                              "make it fit");
    else if (bake.light != hashLightMapLight(traceInputs(document)))
        warnings.emplace_back("the baked light map is of other lights, environments or materials; "
                              "bake it again to make it fit");
}

// Bakes that glTF cannot carry, and those that no longer fit.
void warnAboutBakes(const Document& document, const ExportSettings& settings,
                    std::vector<std::string>& warnings) {
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (bake == nullptr || isAbsent(*bake))
            continue;
        if (bake->kind == BakeKind::AoVertex)
            warnings.emplace_back("glTF has no place for ambient occlusion per vertex; bake it per "
                                  "texel to take it along");
        else if (bake->kind == BakeKind::PrtTexel)
            warnings.emplace_back("glTF has no place for radiance transfer per texel; it stays in "
                                  "the bake's own EXR file (per vertex is taken along)");
        else if (bake->kind == BakeKind::PrtVertex && settings.includeTransfer &&
                 bake->inputs != hashBakeInputs(bakeInputs(document)))
            warnings.emplace_back("the baked radiance transfer is older than the geometry; bake it "
                                  "again to make it fit");
        else if (bake->kind == BakeKind::AoTexel && settings.includeBakedAo &&
                 bake->inputs != hashBakeInputs(bakeInputs(document)))
            warnings.emplace_back("the baked ambient occlusion is older than the geometry; bake it "
                                  "again to make it fit");
        else if (bake->kind == BakeKind::LightMap && settings.includeLightMap)
            warnAboutLightMap(document, *bake, warnings);
    }
}

// Meshes whose vertices the bake has values for.
void addTransfer(const Document& document, const ExportSettings& settings,
                 ExportContents& contents) {
    const BakeArtifactPtr bake = findBake(document, BakeKind::PrtVertex);
    if (!settings.includeTransfer || bake == nullptr)
        return;
    for (ExportedInstance& exported : contents.instances)
        for (const VertexBake& vertices : bake->vertices)
            if (vertices.mesh == exported.instance->id && vertices.stride > 0 &&
                vertices.values.size() == exported.instance->mesh->vertexCount() *
                                              static_cast<std::size_t>(vertices.stride)) {
                exported.transfer = &vertices;
                contents.transfer = bake;
            }
    if (contents.transfer == nullptr)
        return;
    contents.transferLayout = transferLayout(*bake, settings.transferBands);
    if (contents.transferLayout.attributes() > kCommonAttributes)
        contents.warnings.push_back(fmt::format(
            "the radiance transfer takes {} vertex attributes, of which many programs read only "
            "{}; export fewer bands",
            contents.transferLayout.attributes(), kCommonAttributes));
}

// The files of each exported material that the light map is of.
void addLightMaps(const Document& document, const ExportSettings& settings,
                  ExportContents& contents) {
    const BakeArtifactPtr bake = findBake(document, BakeKind::LightMap);
    if (!settings.includeLightMap || bake == nullptr)
        return;
    UniqueNames names;
    const std::string stem = fileSafeName(settings.output.stem().string(), "scene");
    for (std::size_t i = 0; i < contents.materials.size(); ++i) {
        const Material& material = *contents.materials[i];
        if (std::ranges::find(contents.instances, static_cast<int>(i),
                              &ExportedInstance::material) == contents.instances.end())
            continue; // a snapshot's, of which no light is baked
        for (const TexelBake& texels : bake->texels) {
            if (texels.material != material.id || texels.stride != kLightMapStride)
                continue;
            ExportedLightMap map{static_cast<int>(i), &texels, {}};
            const std::string name = names.take(fileSafeName(material.name, "material"));
            for (std::size_t part = 0; part < kLightMapParts.size(); ++part)
                map.paths[part] =
                    settings.output.parent_path() /
                    fmt::format("{}_{}_{}.exr", stem, name, kLightMapParts[part].suffix);
            contents.lightMaps.push_back(std::move(map));
        }
    }
}

// Solo is for looking: lights that are switched on are exported whether or not another one is solo.
void addLight(const Light& light, ExportContents& contents) {
    if (light.type == LightType::Sphere || light.type == LightType::Rectangle)
        contents.warnings.push_back(fmt::format(
            "glTF has no area lights: \"{}\" is left out; switch its type to point or spot to take "
            "it along",
            light.name));
    else
        contents.lights.push_back(&light);
}

void addEnvironment(const Document& document, ExportContents& contents) {
    const Environment& environment = document.environment();
    const bool missing = environment.kind == EnvironmentKind::Image && !environment.problem.empty();
    if (environment.image == nullptr || missing) {
        contents.warnings.emplace_back(
            "the environment's image is missing, so that its light is left out");
        return;
    }
    std::optional<Environment> mixed = mixedEnvironment(document);
    if (!mixed) {
        contents.warnings.emplace_back("the environment is off, so none is written");
        return;
    }
    contents.environment = std::make_shared<const Environment>(std::move(*mixed));
    if (fitRgbd(*contents.environment->image).tooBright)
        contents.warnings.emplace_back(
            "the environment has lights that are brighter than glTF's 8-bit images can hold; "
            "mirrors will show them dimmer");
}

} // namespace

std::filesystem::path ExportContents::texturePath(const ExportSettings& settings,
                                                  const PackedTexture& texture) const {
    const std::string name = texture.name + texture.extension();
    if (settings.format == ExportFormat::Glb)
        return settings.output.string() + "#" + name;
    return settings.output.parent_path() / name;
}

std::filesystem::path ExportContents::transferLightPath(const ExportSettings& settings) const {
    const std::string stem = fileSafeName(settings.output.stem().string(), "scene");
    return settings.output.parent_path() / (stem + "-light.json");
}

std::filesystem::path ExportContents::transferShaderPath(const ExportSettings& settings) const {
    const std::string stem = fileSafeName(settings.output.stem().string(), "scene");
    return settings.output.parent_path() / (stem + "-prt.glsl");
}

std::filesystem::path ExportContents::lightMapShaderPath(const ExportSettings& settings) const {
    const std::string stem = fileSafeName(settings.output.stem().string(), "scene");
    return settings.output.parent_path() / (stem + "-light-map.glsl");
}

std::filesystem::path ExportContents::environmentPath(const ExportSettings& settings) const {
    const std::filesystem::path& file =
        settings.format == ExportFormat::Glb ? settings.output : buffer;
    return file.string() + "#environment";
}

ExportContents gatherContents(const Document& document, const ExportSettings& settings) {
    ExportContents contents;
    addInstances(document, settings, contents);
    addVariants(document, settings, contents);
    addTransfer(document, settings, contents);
    addLightMaps(document, settings, contents);
    if (settings.lit != nullptr)
        for (ExportedInstance& exported : contents.instances)
            if (const auto light = settings.lit->find(exported.instance->id);
                light != settings.lit->end())
                exported.light = &light->second;
    if (settings.includeLights)
        for (const Light& light : document.lights)
            if (light.enabled)
                addLight(light, contents);

    // The names of files beside the .gltf start with its own, in characters that need no escaping.
    std::string stem;
    if (settings.format == ExportFormat::Gltf) {
        stem = fileSafeName(settings.output.stem().string(), "scene");
        contents.buffer = settings.output.parent_path() / (stem + ".bin");
    }
    contents.textures = planTextures(document, contents.materials, settings, stem);
    contents.warnings.insert(contents.warnings.end(), contents.textures.warnings.begin(),
                             contents.textures.warnings.end());
    warnAboutBakes(document, settings, contents.warnings);
    if (!sameChoices(document.model, ShadingModel{}))
        contents.warnings.emplace_back("glTF has no place for the shading model: programs that "
                                       "open the file shade with their own");
    if (settings.includeEnvironment)
        addEnvironment(document, contents);
    return contents;
}

} // namespace patina
