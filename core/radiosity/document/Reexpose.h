// Files that radiosity was written to, with the colours of another exposure: computed anew from the
// light that they hold, without solving.
#pragma once

#include "core/base/Result.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace patina {

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
    std::vector<std::filesystem::path> files; // that were written, `output` last
    std::vector<std::string> notices;
};

// Reads `solved` and writes `output`, which may be the same; both are .dae, .glb, .gltf or .ply.
// All but the colours is as it was: other programs' additions stay. A .gltf gets a buffer of its
// own, and its pictures are copied when it moves to another folder. Errors: Usage for different or
// other kinds of files; InputBroken for files without light, and where light and colours do not go
// together; Usage where the light is in a light map; those of reading and writing files.
Result<Reexposed> reexpose(const std::filesystem::path& solved, const std::filesystem::path& output,
                           const ExposureRequest& exposure);

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
