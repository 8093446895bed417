#include "core/radiosity/document/Reexpose.h"

#include "core/base/LowerCase.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/math/Shading.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/SolvedFiles.h"

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

Error inLightMap(const fs::path& file) {
    return {ErrorKind::Usage,
            "its light is in a light map, and only light at vertices is exposed anew; bake the "
            "scene again with another --exposure",
            file,
            {}};
}

template <class File>
Result<Reexposed> reexposeFile(const fs::path& solved, const fs::path& output,
                               const ExposureRequest& request) {
    Result<File> file = File::read(solved);
    if (!file)
        return file.error();
    if (file->showsLightMap())
        return inLightMap(solved);
    if (file->lights().empty())
        return noLight(solved);
    Reexposed result;
    file->setColors(colorsOf(file->lights(), request, result));
    if (Result<void> written = file->write(output, result); !written)
        return written.error();
    return result;
}

Result<Reexposed> reexposeCollada(const fs::path& solved, const fs::path& output,
                                  const ExposureRequest& request) {
    Result<ColladaDocument> document = ColladaDocument::read(solved);
    if (!document)
        return document.error();
    Result<std::vector<ColladaLitGeometry>> geometries = document->litGeometries();
    if (!geometries)
        return geometries.error();
    if (document->showsLightMap())
        return inLightMap(solved);
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
    if (Result<void> written = document->write(output); !written)
        return written.error();
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

Result<Reexposed> reexpose(const fs::path& solved, const fs::path& output,
                           const ExposureRequest& exposure) {
    const std::string kind = kindOf(solved);
    if (kind != kindOf(output))
        return Error{ErrorKind::Usage,
                     fmt::format("a {} file is exposed anew into another {}, not a {}", kind, kind,
                                 kindOf(output)),
                     output,
                     {}};
    if (kind == ".glb" || kind == ".gltf")
        return reexposeFile<SolvedGltf>(solved, output, exposure);
    if (kind == ".ply")
        return reexposeFile<SolvedPly>(solved, output, exposure);
    if (kind == ".dae")
        return reexposeCollada(solved, output, exposure);
    return Error{ErrorKind::Usage,
                 "only .dae, .glb, .gltf and .ply hold light that can be exposed anew",
                 solved,
                 {}};
}

} // namespace patina
