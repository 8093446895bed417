#include "core/base/Check.h"
#include "core/base/LowerCase.h"
#include "core/export/Export.h"
#include "core/export/GltfExport.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <system_error>

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
