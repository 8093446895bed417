// Export: a plan that says exactly which files will be written (pure, what the dialog shows), and
// the run that writes them, each atomically.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

enum class ExportFormat { Glb, Gltf };
enum class ExportTextureFormat { Png, Jpeg };

struct ExportSettings {
    std::filesystem::path output; // OUT.glb or OUT.gltf
    ExportFormat format = ExportFormat::Glb;
    ExportTextureFormat textures = ExportTextureFormat::Png;
    int maxTextureSize = 0;          // 0: as they are
    bool includeBakedAo = true;      // an attached AoTexel bake becomes the occlusion texture
    bool includeTransfer = true;     // an attached PrtVertex bake becomes attributes _PRT_n
    int transferBands = 0;           // the first so many of its bands; 0: all
    bool includeLights = true;       // KHR_lights_punctual
    bool includeEnvironment = false; // EXT_lights_image_based
    bool visibleOnly = true;
};

struct PlannedFile {
    std::filesystem::path path; // inside another file: that file's path + "#" + name
    std::string
        contents; // "Geometry and materials", "Body: occlusion (R), roughness (G), metallic (B)"
    std::string colorSpace;  // "sRGB", "linear", ""
    std::string format;      // "GLB", "PNG 8-bit RGB 1024 × 1024"
    bool embedded = false;   // inside another file, the GLB or the .bin
    bool overwrites = false; // a file of that name exists
};

struct ExportPlan {
    ExportSettings settings;
    std::vector<PlannedFile> files;
    std::vector<std::string> warnings; // what the format cannot carry, missing maps, stale bakes
};

[[nodiscard]] ExportPlan planExport(const Document& document, const ExportSettings& settings);
// Writes what the plan says. Cancelled or failed: no partial file under a final name.
Result<std::vector<std::filesystem::path>> runExport(WorkerClient& worker, const Document& document,
                                                     const ExportPlan& plan, const JobContext& job);

} // namespace patina
