#include "app/cli/BakeInfo.h"
#include "app/cli/Commands.h"
#include "app/cli/LightInfo.h"
#include "app/cli/LongRadiosity.h"
#include "app/cli/SceneSetup.h"
#include "app/cli/TracedPicture.h"
#include "app/cli/Vectors.h"
#include "core/bake/file/BakeHeader.h"
#include "core/bake/file/BakePacking.h"
#include "core/bake/transfer/BakeCheckpoint.h"
#include "core/base/ById.h"
#include "core/base/LowerCase.h"
#include "core/document/AbsentBake.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Source.h"
#include "core/edit/Parameters.h"
#include "core/io/ImageIO.h"
#include "core/io/MeshImport.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/MaterialInputs.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightMix.h"
#include "core/radiosity/file/RadiosityFile.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/Scene.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace patina::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

void listBuiltins(Report& report) {
    const auto list = [&](const char* key, const char* title,
                          const std::vector<library::Entry>& entries) {
        Rows rows;
        for (const library::Entry& entry : entries) {
            report.json()["builtin"][key].push_back(
                {{"name", "builtin:" + entry.name}, {"title", entry.title}, {"help", entry.help}});
            rows.emplace_back("builtin:" + entry.name, entry.help);
        }
        report.table(title, rows);
    };
    list("models", "Models", library::models());
    list("environments", "Environments", library::environments());
    list("materials", "Materials", library::materials());
}

std::string imageText(const Image& image) {
    return fmt::format("{} × {}, {} channel{}, {}", image.width(), image.height(), image.channels(),
                       image.channels() == 1 ? "" : "s",
                       image.type() == PixelType::U8    ? "8 bit"
                       : image.type() == PixelType::U16 ? "16 bit"
                                                        : "float");
}

Json imageJson(const Image& image) {
    return {{"width", image.width()},
            {"height", image.height()},
            {"channels", image.channels()},
            {"type", image.type() == PixelType::U8    ? "uint8"
                     : image.type() == PixelType::U16 ? "uint16"
                                                      : "float"}};
}

void describeMeshes(Report& report, const Document& document) {
    Rows rows;
    const ById materials(document.materials);
    for (const MeshInstance& mesh : document.meshes) {
        const Material* material = materials.find(mesh.material);
        const std::string materialName = material != nullptr ? material->name : "";
        report.json()["meshes"].push_back({{"name", mesh.name},
                                           {"vertices", mesh.mesh->vertexCount()},
                                           {"triangles", mesh.mesh->triangleCount()},
                                           {"material", materialName},
                                           {"visible", mesh.visible}});
        rows.emplace_back(mesh.name, fmt::format("{} triangles, {} vertices, {}{}",
                                                 countText(mesh.mesh->triangleCount()),
                                                 countText(mesh.mesh->vertexCount()), materialName,
                                                 mesh.visible ? "" : " (hidden)"));
    }
    report.table(fmt::format("Meshes ({})", rows.size()), rows);
}

std::string lowerCase(std::string_view label) {
    std::string text(label);
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

void describeMaterials(Report& report, const Document& document) {
    report.line(fmt::format("Materials ({})", document.materials.size()));
    for (const Material& material : document.materials) {
        Json json = {{"name", material.name}, {"baseColor", vectorJson(material.baseColor)}};
        std::string numbers;
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.role == InputRole::Number) {
                json[std::string(info.id)] = material.*info.number;
                numbers += fmt::format(", {} {:.3g}", lowerCase(info.parameters.label),
                                       material.*info.number);
            }
        json.update({{"emissive", vectorJson(material.emissive * material.emissiveStrength)},
                     {"opacity", material.opacity},
                     {"maps", Json::object()}});
        report.line(fmt::format("  {}  base colour {:.3g} {:.3g} {:.3g}{}", material.name,
                                material.baseColor.r, material.baseColor.g, material.baseColor.b,
                                numbers));
        Rows rows;
        for (const MaterialInputInfo& info : kMaterialInputs) {
            const MapSlot& slot = material.*info.map;
            if (!slot.assigned())
                continue;
            Json map = {{"source", slot.source}};
            if (slot.image != nullptr)
                map.update(imageJson(*slot.image));
            else
                map["problem"] = slot.problem;
            json["maps"][std::string(info.id)] = std::move(map);
            rows.emplace_back(fmt::format("    {}", info.id),
                              fmt::format("{}  {}", slot.source,
                                          slot.image != nullptr ? imageText(*slot.image)
                                                                : "missing: " + slot.problem));
        }
        report.json()["materials"].push_back(std::move(json));
        report.table({}, rows);
    }
}

void describeScene(Report& report, const OpenedScene& scene) {
    const Document& document = scene.document;
    const Bounds bounds = document.bounds();
    Json& json = report.json();
    json["kind"] = scene.isProject ? "project" : "model";
    json["counts"] = {{"meshes", document.meshes.size()},
                      {"materials", document.materials.size()},
                      {"lights", document.lights.size()},
                      {"triangles", document.triangleCount()}};
    json["bounds"] = {{"min", vectorJson(bounds.min)}, {"max", vectorJson(bounds.max)}};
    const glm::vec3 size = bounds.size();
    report.table({}, {{"kind", scene.isProject ? "Patina project" : "model"},
                      {"triangles", countText(document.triangleCount())},
                      {"size", fmt::format("{:.4g} × {:.4g} × {:.4g} m", size.x, size.y, size.z)}});
    describeMeshes(report, document);
    describeMaterials(report, document);

    Rows lights;
    for (const Light& light : document.lights) {
        const ParameterInfo& typeInfo = *findParameter("light.type");
        const std::string type = formatParameterValue(typeInfo, typeInfo.get(document, light.id));
        json["lights"].push_back({{"name", light.name},
                                  {"type", type},
                                  {"intensity", lightIntensity(light)},
                                  {"unit", std::string(intensityUnit(light.type))},
                                  {"active", isActive(document, light)}});
        lights.emplace_back(light.name, fmt::format("{}, {:.4g} {}{}", type, lightIntensity(light),
                                                    intensityUnit(light.type),
                                                    isActive(document, light) ? "" : ", off"));
    }
    if (!lights.empty())
        report.table(fmt::format("Lights ({})", lights.size()), lights);
    Rows cameras;
    for (const SceneCamera& camera : scene.cameras) {
        json["cameras"].push_back({{"name", camera.name},
                                   {"position", vectorJson(camera.position)},
                                   {"forward", vectorJson(camera.forward)},
                                   {"up", vectorJson(camera.up)},
                                   {"fovDeg", camera.fovDeg}});
        cameras.emplace_back(camera.name,
                             fmt::format("at {:.4g} {:.4g} {:.4g}, {:.4g}° high", camera.position.x,
                                         camera.position.y, camera.position.z, camera.fovDeg));
    }
    if (!cameras.empty())
        report.table(fmt::format("Cameras ({}), for --camera scene:NAME", cameras.size()), cameras);
    if (scene.isProject) {
        json["environment"] = environmentName(document.environment());
        Rows environments;
        for (const Environment& environment : document.environments) {
            const bool first = environment.id == document.mix.first;
            const bool second = environment.id == document.mix.second;
            json["environments"].push_back({{"name", environmentTitle(environment)},
                                            {"shows", environmentName(environment)},
                                            {"first", first},
                                            {"second", second}});
            environments.emplace_back(environmentTitle(environment),
                                      environmentName(environment) +
                                          (first && document.environments.size() > 1
                                               ? ", lights the scene"
                                           : second ? ", to fade to"
                                                    : ""));
        }
        report.table(environments.size() > 1 ? fmt::format("Environments ({})", environments.size())
                                             : "Environment",
                     environments);
    }
    Rows bakes;
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (isAbsent(*bake)) // among the notices
            continue;
        json["bakes"].push_back({{"kind", kindText(bake->kind)}, {"samples", bake->samplesDone}});
        bakes.emplace_back(kindText(bake->kind),
                           restsOnRays(*bake)
                               ? fmt::format("{} rays per element", bake->samplesDone)
                               : "in closed form, without rays");
    }
    if (!bakes.empty())
        report.table(fmt::format("Bakes ({})", bakes.size()), bakes);

    Rows missing;
    for (const std::string& file : scene.missingFiles)
        missing.emplace_back(file, "");
    if (!missing.empty())
        report.table(fmt::format("Missing files ({})", missing.size()), missing);
}

// Every key of a glTF file, so that nothing in it is lost without a word.
Result<void> describeKeys(Session& session, const std::string& file) {
    const Result<std::vector<ModelKey>> keys = gltfKeys(session.worker(), file);
    if (!keys)
        return keys.error();
    constexpr std::array<const char*, 3> kUses{"used", "kept", "left out"};
    std::array<std::size_t, kUses.size()> counts{};
    Json& list = session.report().json()["gltfKeys"] = Json::array();
    for (const ModelKey& key : *keys) {
        const auto use = static_cast<std::size_t>(key.use);
        ++counts[use];
        list.push_back({{"key", key.key}, {"use", kUses[use]}, {"count", key.count}});
        if (key.use == KeyUse::LeftOut)
            list.back()["why"] = key.why;
    }
    session.report().line(
        fmt::format("glTF keys: {} used, {} kept without being seen, {} left out (--json lists "
                    "them, with reasons)",
                    counts[0], counts[1], counts[2]));
    return {};
}

bool isGltf(const std::string& file) {
    const std::string extension = extensionOf(file);
    return extension == ".gltf" || extension == ".glb";
}

// How a floating-point picture shows its environment; nothing when it looks like none.
std::optional<EnvironmentPicture> environmentOf(Session& session, const std::string& file,
                                                const ImageInfo& info) {
    if (info.pixelType != "float" && info.pixelType != "half")
        return std::nullopt;
    std::vector<Notice> notices; // doubts are for those who light with it
    Result<EnvironmentPicture> picture = readEnvironmentPicture(
        session.worker(), file, EnvironmentLayout::Automatic, notices, session.job());
    if (!picture || (picture->mapping.isCommonLatLong() && info.width != 2 * info.height))
        return std::nullopt;
    return *std::move(picture);
}

Error noLight(const std::string& file) {
    return {ErrorKind::Usage, "--light is for environments and projects", file, {}};
}

// Images, environments and bakes: everything that is pixels. `light`: it must be an environment.
Result<void> describeImage(Session& session, const std::string& file, bool light) {
    Result<ImageInfo> info = inspectImage(session.worker(), file);
    if (!info)
        return info.error();
    const bool bake = isBakeFile(info->attributes);
    const std::optional<EnvironmentPicture> environment =
        bake ? std::nullopt : environmentOf(session, file, *info);
    if (light && !environment)
        return noLight(file);
    const char* kind = bake ? "bake" : environment ? "environment" : "image";
    Report& report = session.report();
    Json& json = report.json();
    json["kind"] = kind;
    json["format"] = info->format;
    if (environment) {
        const auto choices = findParameter("environment.layout")->choices;
        json["layout"] = choices[static_cast<std::size_t>(environment->layout)];
        json["openExrConvention"] = environment->convention == EnvironmentConvention::OpenExr;
    }
    json["width"] = info->width;
    json["height"] = info->height;
    json["channels"] = info->channels;
    json["pixelType"] = info->pixelType;
    json["channelNames"] = info->channelNames;
    if (!info->partNames.empty())
        json["parts"] = info->partNames;
    info->attributes.erase(kPackedAttribute); // it is listed as the bake's parts
    if (!info->attributes.empty())
        json["attributes"] = info->attributes;

    Rows rows = {{"kind", bake          ? "Patina bake"
                          : environment ? "environment"
                                        : "image"},
                 {"format", info->format},
                 {"size", fmt::format("{} × {} pixels", info->width, info->height)},
                 {"channels", fmt::format("{} ({}), {}", info->channels,
                                          fmt::join(info->channelNames, " "), info->pixelType)}};
    if (environment)
        rows.insert(rows.begin() + 1,
                    {"layout", fmt::format("{}{}", layoutLabel(environment->layout),
                                           environment->convention == EnvironmentConvention::OpenExr
                                               ? ", in OpenEXR's own convention"
                                               : "")});
    if (info->partNames.size() > 1)
        rows.emplace_back("parts", fmt::format("{}", fmt::join(info->partNames, ", ")));
    for (const auto& [key, value] : info->attributes)
        if (!bake && value.size() <= 200)
            rows.emplace_back(key, value);
    report.table({}, rows);
    if (!bake)
        return {};
    ImageLoadOptions options; // all of it: what is damaged or cut short is found
    options.sanitize = false;
    options.allParts = true;
    Result<LoadedImage> image = loadImage(session.worker(), file, options);
    if (!image)
        return image.error();
    const Result<std::vector<ImagePart>> parts = unpackParts(std::move(image->parts), file);
    if (!parts)
        return parts.error();
    return describeBake(report, *parts, file);
}

bool isScene(const std::string& file) {
    const std::vector<std::string>& models = modelExtensions();
    const std::string extension = extensionOf(file);
    return extension == ".patina" ||
           std::find(models.begin(), models.end(), extension) != models.end();
}

Result<void> describeLightOfFile(Session& session, const std::string& file,
                                 const std::optional<glm::vec3>& direction) {
    const Result<Document> document = openEnvironmentFor(session, file);
    return document ? describeLight(session, *document, direction) : document.error();
}

bool isBuiltinEnvironment(const std::string& name) {
    const std::vector<library::Entry>& all = library::environments();
    return std::any_of(all.begin(), all.end(), [&](auto& entry) { return entry.name == name; });
}

} // namespace

Result<void> run(Session& session, const InfoOptions& options) {
    session.expectNoImages(); // those of models are not looked at
    Report& report = session.report();
    report.json()["settings"] = {{"file", options.file}};
    const Result<std::optional<glm::vec3>> direction = parseDirection(options.direction);
    if (!direction)
        return direction.error();
    const bool builtin = isBuiltin(options.file);
    if (builtin && isBuiltinEnvironment(builtinName(options.file))) {
        Result<ImagePtr> image = library::environment(builtinName(options.file));
        if (!image)
            return image.error();
        report.json()["kind"] = "environment";
        report.json().update(imageJson(**image));
        report.json()["layout"] = "latLong";
        report.table({}, {{"kind", "environment"},
                          {"layout", std::string(layoutLabel(EnvironmentLayout::LatLong))},
                          {"size", imageText(**image)}});
        return options.light ? describeLightOfFile(session, options.file, *direction)
                             : Result<void>();
    }
    const bool checkpoint = !builtin && looksLikeCheckpoint(options.file);
    const bool film = !builtin && looksLikeFilm(options.file);
    const bool solution = !builtin && radiosity::looksLikeRadiosity(options.file);
    if (!builtin && !checkpoint && !film && !solution && !isScene(options.file)) {
        const Result<void> described = describeImage(session, options.file, options.light);
        return described && options.light ? describeLightOfFile(session, options.file, *direction)
                                          : described;
    }
    if (options.light && extensionOf(options.file) != ".patina")
        return noLight(options.file);
    if (options.file == "builtin:list") {
        listBuiltins(report);
        return {};
    }
    if (checkpoint)
        return describeUnfinishedBake(report, options.file);
    if (film)
        return describeUnfinishedPicture(report, options.file);
    if (solution)
        return describeUnfinishedRadiosity(report, options.file);

    Result<OpenedScene> scene = openNamedScene(session, options.file);
    if (!scene)
        return scene.error();
    report.add(*scene);
    describeScene(report, *scene);
    if (isGltf(options.file))
        if (Result<void> described = describeKeys(session, options.file); !described)
            return described;
    if (!options.light)
        return {};
    resolveBlend(scene->document, session.job());
    return describeLight(session, scene->document, *direction);
}

} // namespace patina::cli
