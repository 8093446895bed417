#include "core/base/Check.h"
#include "core/base/LowerCase.h"
#include "core/export/Export.h"
#include "core/export/GltfExport.h"
#include "core/export/Names.h"
#include "core/io/ImageIO.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace patina {
namespace {

constexpr std::array<ExportFormatInfo, 2> kFormats{{
    {ExportFormat::Glb, "glb", "GLB (one file)", "glTF binary", planGltf},
    {ExportFormat::Gltf, "gltf", "glTF (separate files)", "glTF", planGltf},
}};

} // namespace

std::span<const ExportFormatInfo> exportFormats() {
    return kFormats;
}

Result<ExportFormat> exportFormatOf(const std::filesystem::path& output) {
    std::string names;
    for (const ExportFormatInfo& info : kFormats) {
        if (extensionOf(output) == std::string(".") + info.extension)
            return info.format;
        names += fmt::format("{}.{}", names.empty() ? "" : " or ", info.extension);
    }
    return Error{ErrorKind::Usage,
                 fmt::format("the extension decides the format; name the output {}", names),
                 output,
                 {}};
}

std::filesystem::path lightMapPath(const std::filesystem::path& output, const char* extension) {
    return output.parent_path() / fmt::format("{}_{}{}",
                                              fileSafeName(output.stem().string(), "scene"),
                                              kLightMapName, extension);
}

Result<Bytes> encodeLightMap(WorkerClient& worker, const Image& radiance,
                             double automaticExposure) {
    std::vector<ImagePart> parts(1);
    parts[0].image = radiance;
    parts[0].attributes[kAutomaticExposureAttribute] = fmt::format("{}", automaticExposure);
    return encodeImage(worker, std::move(parts), ImageFileFormat::Exr);
}

PlannedFile plannedRadiance(const std::filesystem::path& output,
                            std::shared_ptr<const LitTexels> lightMap, int stage) {
    const Image& image = *lightMap->radiance;
    return {lightMapPath(output, ".exr"),
            "Light map: radiance, W/(m² sr)",
            "linear",
            fmt::format("EXR 32-bit RGB {} × {}", image.width(), image.height()),
            false,
            false,
            [lightMap = std::move(lightMap)](WorkerClient& worker, const JobContext& job) {
                job.setActivity("packing the light map");
                return encodeLightMap(worker, *lightMap->radiance, lightMap->automaticExposure);
            },
            stage};
}

ExportPlan planExport(const Document& document, const ExportSettings& settings) {
    const auto info = std::ranges::find(kFormats, settings.format, &ExportFormatInfo::format);
    CHECK(info != kFormats.end());
    ExportPlan plan = info->plan(document, settings);
    for (PlannedFile& file : plan.files) {
        std::error_code ignored;
        file.overwrites = !file.embedded && std::filesystem::exists(file.path, ignored);
    }
    return plan;
}

} // namespace patina
