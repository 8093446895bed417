#include "core/radiosity/document/Reexpose.h"

#include "core/base/Limits.h"
#include "core/base/LowerCase.h"
#include "core/export/Export.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/io/ImageIO.h"
#include "core/math/Shading.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/MappedGltf.h"
#include "core/radiosity/document/SolvedFiles.h"
#include "core/radiosity/document/SolvedLightMap.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

std::string kindOf(const fs::path& file) {
    return lowerCase(file.extension().string());
}

// k of a request, and the colours that it makes of all lights.
ShownColors colorsOf(const ShownLights& lights, const ExposureRequest& request, Reexposed& result) {
    if (request.kind != ExposureRequest::Kind::None)
        result.k = request.kind == ExposureRequest::Kind::Value ? request.k : exposureOf(lights);
    ShownColors colors;
    for (const ShownLight& light : lights) {
        colors.push_back(exposedColors(light.radiance, result.k));
        result.vertices += light.radiance.size();
    }
    return colors;
}

Error noLight(const fs::path& file) {
    return {ErrorKind::InputBroken,
            "it holds no light from patina bake radiosity; bake the scene into it first",
            file,
            {}};
}

Result<Reexposed> written(const FilesTogether& files, Reexposed result) {
    Result<std::vector<fs::path>> paths = files.write();
    if (!paths)
        return paths.error();
    result.files = *std::move(paths);
    return result;
}

// A document and the picture of its light map, as MappedGltf.
class MappedCollada {
  public:
    static Result<MappedCollada> from(ColladaDocument document, const fs::path& file) {
        const Result<ColladaLightMap> names = document.lightMap();
        if (!names)
            return names.error();
        for (const std::string& name : {names->picture, names->radiance})
            if (!liesBeside(name))
                return Error{ErrorKind::InputBroken,
                             fmt::format("it names \"{:.80}\", which is no file beside it; put it "
                                         "there, and name it by its name alone",
                                         name),
                             file,
                             {}};
        // It is written anew: one that is missing is no fault.
        Result<Bytes> picture =
            readFile(file.parent_path() / names->picture, limits::kMaxModelFileBytes);
        return MappedCollada(std::move(document), *names, picture ? *std::move(picture) : Bytes());
    }

    [[nodiscard]] const std::string& radiance() const { return m_names.radiance; }
    [[nodiscard]] const std::string& pictureName() const { return m_names.picture; }
    [[nodiscard]] const Bytes& picture() const { return m_picture; }
    // The document does not say which exposure its picture has.
    Result<void> addFiles(const fs::path& output, const MapNames& names, Bytes picture, double,
                          FilesTogether& files, std::vector<std::string>&) && {
        if (Result<void> renamed = m_document.renameLightMap({names.picture, names.radiance});
            !renamed)
            return renamed;
        files.add(output.parent_path() / names.picture, std::move(picture));
        const std::string text = m_document.text();
        const auto bytes = std::as_bytes(std::span(text));
        files.add(output, Bytes(bytes.begin(), bytes.end()));
        return {};
    }

  private:
    MappedCollada(ColladaDocument document, ColladaLightMap names, Bytes picture)
        : m_document(std::move(document))
        , m_names(std::move(names))
        , m_picture(std::move(picture)) {}

    ColladaDocument m_document;
    ColladaLightMap m_names;
    Bytes m_picture;
};

// Whether a light map beside a file is the one that its picture shows, as far as its size says.
// One that is missing or damaged is written anew.
Result<void> checkSize(WorkerClient& worker, const Bytes& picture, const fs::path& file,
                       const fs::path& radiance, int side) {
    const Result<LoadedImage> shown = loadImageFromMemory(worker, picture, "light map.png");
    if (!shown || (shown->image().width() == side && shown->image().height() == side))
        return {};
    return Error{ErrorKind::InputBroken,
                 fmt::format("it has {0} × {0} texels, and the picture of it that {1} shows {2} × "
                             "{3}: they are not of one bake; bake the scene again",
                             side, file.filename().string(), shown->image().width(),
                             shown->image().height()),
                 radiance,
                 {}};
}

template <class File>
Result<Reexposed> reexposeMap(WorkerClient& worker, File file, const fs::path& solved,
                              const fs::path& output, const ExposureRequest& request,
                              const JobContext& job) {
    const fs::path radiance = solved.parent_path() / file.radiance();
    const Result<SolvedLightMap> map = SolvedLightMap::read(worker, radiance, job);
    if (!map && map.error().kind == ErrorKind::InputMissing)
        return Error{ErrorKind::InputMissing,
                     fmt::format("the light map of {}, which has its light, is not beside it; put "
                                 "it there, or bake the scene again",
                                 solved.filename().string()),
                     radiance, map.error().message};
    if (!map)
        return map.error();
    if (Result<void> fits = checkSize(worker, file.picture(), solved, radiance, map->side()); !fits)
        return fits.error();
    const Result<double> k = map->exposureOf(request);
    if (!k)
        return k.error();
    Result<Bytes> picture = map->picture(worker, *k);
    if (!picture)
        return picture.error();

    Reexposed result;
    result.k = *k;
    result.lightMapSide = map->side();
    MapNames names{file.radiance(), file.pictureName()};
    // What belongs to a file that is replaced is beside it, also where `output` is a link to it.
    const bool inPlace = isSameFile(solved, output);
    const fs::path& target = inPlace ? solved : output;
    FilesTogether files(target);
    if (!inPlace) {
        const fs::path goesTo = lightMapPath(output, ".exr");
        names = {goesTo.filename().string(), lightMapPath(output, ".png").filename().string()};
        if (!isSameFile(radiance, goesTo))
            files.add(goesTo, map->bytes());
    }
    if (Result<void> added =
            std::move(file).addFiles(target, names, *std::move(picture), *k, files, result.notices);
        !added)
        return added.error();
    if (job.cancelled())
        return bakeCancelled();
    return written(files, std::move(result));
}

// The map itself becomes a picture.
Result<Reexposed> reexposeMapAlone(WorkerClient& worker, const fs::path& solved,
                                   const fs::path& output, const ExposureRequest& request,
                                   const JobContext& job) {
    const Result<SolvedLightMap> map = SolvedLightMap::read(worker, solved, job);
    if (!map)
        return map.error();
    const Result<double> k = map->exposureOf(request);
    if (!k)
        return k.error();
    Result<Bytes> picture = map->picture(worker, *k);
    if (!picture)
        return picture.error();
    FilesTogether files(output);
    files.add(output, *std::move(picture));
    Reexposed result;
    result.k = *k;
    result.lightMapSide = map->side();
    return written(files, std::move(result));
}

template <class File>
Result<Reexposed> reexposeVertices(File file, const fs::path& solved, const fs::path& output,
                                   const ExposureRequest& request) {
    if (file.lights().empty())
        return noLight(solved);
    Reexposed result;
    file.setColors(colorsOf(file.lights(), request, result));
    FilesTogether files(output);
    std::move(file).addFiles(output, files, result.notices);
    return written(files, std::move(result));
}

// Which of the two exposures would be meant by the other's light cannot be said.
Error inBoth(const fs::path& file) {
    return {ErrorKind::InputBroken,
            "it has light at vertices and light in a light map; expose the files that it was made "
            "of anew",
            file,
            {}};
}

Result<Reexposed> reexposeGltf(WorkerClient& worker, const fs::path& solved, const fs::path& output,
                               const ExposureRequest& request, const JobContext& job) {
    Result<SolvedGltf> file = SolvedGltf::read(solved);
    if (!file)
        return file.error();
    if (!file->showsLightMap())
        return reexposeVertices(*std::move(file), solved, output, request);
    if (!file->lights().empty())
        return inBoth(solved);
    Result<MappedGltf> mapped = MappedGltf::read(solved);
    if (!mapped)
        return mapped.error();
    return reexposeMap(worker, *std::move(mapped), solved, output, request, job);
}

Result<Reexposed> reexposePly(const fs::path& solved, const fs::path& output,
                              const ExposureRequest& request) {
    Result<SolvedPly> file = SolvedPly::read(solved);
    if (!file)
        return file.error();
    return reexposeVertices(*std::move(file), solved, output, request);
}

// The scene that was lit need not be the one that the document names (--visual-scene).
Result<void> takeLitScene(ColladaDocument& document) {
    const std::size_t named = document.scene();
    std::vector<std::size_t> order{named};
    for (std::size_t scene = 0; scene < document.scenes().size(); ++scene)
        if (scene != named)
            order.push_back(scene);
    for (const std::size_t scene : order) {
        if (Result<void> taken = document.takeScene(scene); !taken)
            return taken;
        const Result<std::vector<ColladaLitGeometry>> geometries = document.litGeometries();
        if (!geometries)
            return geometries.error();
        if (document.showsLightMap() || !geometries->empty())
            return {};
    }
    return document.takeScene(named);
}

Result<Reexposed> reexposeCollada(WorkerClient& worker, const fs::path& solved,
                                  const fs::path& output, const ExposureRequest& request,
                                  const JobContext& job) {
    Result<ColladaDocument> document = ColladaDocument::read(solved);
    if (!document)
        return document.error();
    if (Result<void> taken = takeLitScene(*document); !taken)
        return taken.error();
    Result<std::vector<ColladaLitGeometry>> geometries = document->litGeometries();
    if (!geometries)
        return geometries.error();
    if (document->showsLightMap()) {
        if (!geometries->empty())
            return inBoth(solved);
        Result<MappedCollada> mapped = MappedCollada::from(*std::move(document), solved);
        if (!mapped)
            return mapped.error();
        return reexposeMap(worker, *std::move(mapped), solved, output, request, job);
    }
    if (geometries->empty())
        return noLight(solved);
    ShownLights lights;
    for (ColladaLitGeometry& geometry : *geometries) {
        ShownLight& light = lights.emplace_back();
        for (const glm::vec3& radiosity : geometry.shown)
            light.radiance.push_back(radiosity / std::numbers::pi_v<float>);
        light.areas = std::move(geometry.areas);
    }
    Reexposed result;
    std::vector<std::vector<glm::vec4>> encoded;
    for (const std::vector<glm::vec3>& colors : colorsOf(lights, request, result)) {
        encoded.emplace_back();
        for (const glm::vec3& color : colors)
            encoded.back().emplace_back(shading::srgbEncode(color), 1.0f);
    }
    if (Result<void> changed = document->recolor(encoded); !changed)
        return changed.error();
    if (Result<void> saved = document->write(output); !saved)
        return saved.error();
    result.files.push_back(output);
    return result;
}

} // namespace

double exposureOf(std::span<const ShownLight> lights) {
    std::vector<LitArea> pieces;
    double area = 0.0, sum = 0.0;
    for (const ShownLight& light : lights)
        for (std::size_t v = 0; v < light.radiance.size(); ++v) {
            const double radiance = double{shading::luminance(light.radiance[v])};
            pieces.push_back({light.areas[v], radiance});
            area += light.areas[v];
            sum += light.areas[v] * radiance;
        }
    const double dark = area > 0.0 ? kDarkShare * sum / area : 0.0;
    std::erase_if(pieces, [dark](const LitArea& piece) { return !(piece.radiance > dark); });
    return exposureOfMedian(std::move(pieces));
}

glm::vec3 exposedColor(const glm::vec3& radiance, double k) {
    return k > 0.0 ? exposed(radiance, k) : glm::clamp(radiance, 0.0f, 1.0f);
}

std::vector<glm::vec3> exposedColors(const std::vector<glm::vec3>& radiance, double k) {
    std::vector<glm::vec3> colors;
    for (const glm::vec3& light : radiance)
        colors.push_back(exposedColor(light, k));
    return colors;
}

Result<Reexposed> reexpose(WorkerClient& worker, const fs::path& solved, const fs::path& output,
                           const ExposureRequest& exposure, const JobContext& job) {
    const std::string kind = kindOf(solved);
    if (kind == ".exr" && kindOf(output) != ".png")
        return Error{
            ErrorKind::Usage,
            fmt::format("a light map (.exr) is exposed anew into a .png, not a {}", kindOf(output)),
            output,
            {}};
    if (kind == ".exr")
        return reexposeMapAlone(worker, solved, output, exposure, job);
    if (kind != kindOf(output))
        return Error{ErrorKind::Usage,
                     fmt::format("a {} file is exposed anew into another {}, not a {}", kind, kind,
                                 kindOf(output)),
                     output,
                     {}};
    if (kind == ".glb" || kind == ".gltf")
        return reexposeGltf(worker, solved, output, exposure, job);
    if (kind == ".ply")
        return reexposePly(solved, output, exposure);
    if (kind == ".dae")
        return reexposeCollada(worker, solved, output, exposure, job);
    return Error{ErrorKind::Usage,
                 "only .dae, .glb, .gltf and .ply, and light maps (.exr), hold light that can be "
                 "exposed anew",
                 solved,
                 {}};
}

} // namespace patina
