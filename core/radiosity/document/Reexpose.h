// Files that radiosity was written to, with the colours of another exposure: computed anew from the
// light that they hold, without solving.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

struct ExposureRequest {
    enum class Kind {
        Automatic, // the median, by area, of what has light becomes middle grey
        None,      // values as they are, cut off at 1
        Value
    };
    Kind kind = Kind::Automatic;
    double k = 1.0; // of Value: 1 - e^(-kL)
};

struct Reexposed {
    double k = 0.0; // 0: of ExposureRequest::Kind::None
    std::size_t vertices = 0;
    int lightMapSide = 0;                     // texels; 0: light is at vertices
    std::vector<std::filesystem::path> files; // that were written, `output` last
    std::vector<std::string> notices;
};

// Reads `solved` and writes `output`, which may be the same; both are .dae, .glb, .gltf or .ply.
// All but the colours, or the picture of the light map, is as it was: other programs' additions
// stay. A .gltf gets a buffer of its own, and its pictures are copied when it moves to another
// folder. The radiance of a light map is read beside `solved` and goes along to where a bake into
// `output` would write it (lightMapPath()). A light map alone, .exr, becomes a .png. All files are
// written or none, and those that were there stay. Errors: Usage for different or other kinds of
// files, and for the automatic exposure of light maps that do not hold it; InputBroken for files
// without light, and where light and colours, or light map and picture, do not go together;
// InputMissing, also of the light map; those of reading and writing files; Cancelled.
Result<Reexposed> reexpose(WorkerClient& worker, const std::filesystem::path& solved,
                           const std::filesystem::path& output, const ExposureRequest& exposure,
                           const JobContext& job);

// The light of vertices that share colours.
struct ShownLight {
    std::vector<glm::vec3> radiance; // that their colours are to show
    std::vector<double> areas;       // m²; of each vertex
};
// k that shows the median of it as middle grey. What has less than 2 % of the mean radiance, as the
// insides of things, has no say. Unlike automaticExposure(), which sees what glows, files do not.
[[nodiscard]] double exposureOf(std::span<const ShownLight> lights);
// Linear colours, 0…1. `k` 0: cut off at 1.
[[nodiscard]] glm::vec3 exposedColor(const glm::vec3& radiance, double k);
[[nodiscard]] std::vector<glm::vec3> exposedColors(const std::vector<glm::vec3>& radiance,
                                                   double k);

} // namespace patina
