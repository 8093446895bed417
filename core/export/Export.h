// Export: a plan that says exactly which files will be written, what dialogs show, and has a
// function for each that makes it; and the run, which calls these and writes the files, each
// atomically. A format is a row of exportFormats() with the function that plans it.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/export/LitVertices.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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
    bool includeBakedAo = true;      // an attached AoTexel bake becomes the occlusion texture, else
                                     // what a light map says of ambient visibility
    bool includeTransfer = false;    // an attached PrtVertex bake becomes attributes _PRT_n
    int transferBands = 0;           // the first so many of its bands; 0: all
    bool includeLightMap = true;     // an attached LightMap bake becomes files beside the scene
                                     // (core/export/LightMapExport.h)
    bool includeLights = true;       // KHR_lights_punctual
    bool includeEnvironment = false; // EXT_lights_image_based
    bool includeVariants = true;     // KHR_materials_variants: one for each snapshot, where any has
                                     // other materials (core/export/Variants.h)
    bool visibleOnly = true;
    // Meshes whose vertices have their light: shown as it is (KHR_materials_unlit), as COLOR_0 and
    // unclamped as _RADIANCE. Null: none.
    std::shared_ptr<const LitMeshes> lit;
    // Instead the coordinates of `lit` in this: TEXCOORD_1 of the emissive texture, which is its
    // picture. Its radiance is a file beside the scene (lightMapPath()). Null: none.
    std::shared_ptr<const LitTexels> lightMap;
};

// The bytes of a file; empty for what lies inside another file, whose function has kept it.
using MakeFile = std::function<Result<Bytes>(WorkerClient& worker, const JobContext& job)>;

struct PlannedFile {
    std::filesystem::path path; // inside another file: that file's path + "#" + name
    std::string
        contents; // "Geometry and materials", "Body: occlusion (R), roughness (G), metallic (B)"
    std::string colorSpace;  // "sRGB", "linear", ""
    std::string format;      // "GLB", "PNG 8-bit RGB 1024 × 1024"
    bool embedded = false;   // inside another file, the GLB or the .bin
    bool overwrites = false; // a file of that name exists
    MakeFile make;
    int stage = 0; // files of one are made side by side, after those of the stages before
};

// Holds what it needs of the document as it was: edits that follow are not exported.
struct ExportPlan {
    ExportSettings settings;
    std::vector<PlannedFile> files;
    std::vector<std::string> warnings; // what the format cannot carry, missing maps, stale bakes
    std::optional<Error> problem;      // why it cannot be run
};

struct ExportFormatInfo {
    ExportFormat format;
    const char* extension; // without the dot
    const char* label;     // "GLB (one file)"
    const char* filter;    // of file dialogs: "glTF binary"
    ExportPlan (*plan)(const Document& document, const ExportSettings& settings);
};
[[nodiscard]] std::span<const ExportFormatInfo> exportFormats();
// By the extension. Errors: Usage, with the extensions that there are.
[[nodiscard]] Result<ExportFormat> exportFormatOf(const std::filesystem::path& output);

[[nodiscard]] ExportPlan planExport(const Document& document, const ExportSettings& settings);
// The linear light of a light map beside a scene's file: OUT_light-map.exr of OUT.glb; with ".png"
// its picture, where that is no part of the file.
[[nodiscard]] std::filesystem::path lightMapPath(const std::filesystem::path& output,
                                                 const char* extension);
// That file's bytes: OpenEXR, RGB, 32-bit, with the attribute kAutomaticExposureAttribute. Errors:
// those of encodeImage().
[[nodiscard]] Result<Bytes> encodeLightMap(WorkerClient& worker, const Image& radiance,
                                           double automaticExposure);
// It as a part of a plan.
[[nodiscard]] PlannedFile plannedRadiance(const std::filesystem::path& output,
                                          std::shared_ptr<const LitTexels> lightMap, int stage);
// Writes what the plan says, what refers to other files last, and returns their paths. A plan is
// run by one at a time. Cancelled or failed: no partial file under a final name.
Result<std::vector<std::filesystem::path>> runExport(WorkerClient& worker, const ExportPlan& plan,
                                                     const JobContext& job);

} // namespace patina
