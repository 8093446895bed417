#include "core/export/Export.h"
#include "core/export/ExportContents.h"
#include "core/export/GltfEnvironment.h"

#include <fmt/format.h>
#include <system_error>

namespace patina {

ExportPlan planExport(const Document& document, const ExportSettings& settings) {
    const ExportContents contents = gatherContents(document, settings);
    const bool glb = settings.format == ExportFormat::Glb;
    ExportPlan plan;
    plan.settings = settings;
    plan.warnings = contents.warnings;
    const auto add = [&](PlannedFile file) {
        std::error_code ignored;
        file.overwrites = !file.embedded && std::filesystem::exists(file.path, ignored);
        plan.files.push_back(std::move(file));
    };

    const bool textured = !contents.textures.textures.empty();
    const char* all = textured ? "Geometry, materials and textures" : "Geometry and materials";
    add({settings.output, glb ? all : "Scene and materials", "", glb ? "GLB" : "glTF (JSON)"});
    if (!glb)
        add({contents.buffer, "Geometry", "", "binary"});
    for (const PackedTexture& texture : contents.textures.textures)
        add({contents.texturePath(settings, texture), texture.contents,
             texture.kind == PackKind::Color ? "sRGB" : "linear", texture.formatText(), glb});
    if (contents.environment != nullptr)
        add({contents.environmentPath(settings),
             fmt::format("Environment's light: {} levels of 6 faces, irradiance",
                         kGltfEnvironmentLevels),
             "linear", fmt::format("PNG 8-bit RGBD {0} × {0}", kGltfEnvironmentSize), true});
    if (contents.transfer != nullptr) {
        const TransferLayout& layout = contents.transferLayout;
        add({contents.transferLightPath(settings),
             fmt::format("Light for radiance transfer: {} bands", layout.bands), "linear", "JSON"});
        add({contents.transferShaderPath(settings),
             fmt::format("Shader for the attributes _PRT_0 to _PRT_{}", layout.attributes() - 1),
             "", "GLSL"});
    }
    return plan;
}

} // namespace patina
