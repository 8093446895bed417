// A document's environment as glTF's EXT_lights_image_based carries it (docs/maths/ibl.md).
#pragma once

#include "core/base/AtomicFile.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <array>
#include <glm/ext/quaternion_double.hpp>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

// Sizes 256 … 16: the extension wants the blurriest level to have about 16 texels.
inline constexpr int kGltfEnvironmentSize = 256;
inline constexpr int kGltfEnvironmentLevels = 5;

struct GltfEnvironment {
    std::string name;
    double intensity = 1.0;              // multiplies everything below
    glm::dquat rotation{1.0, 0, 0, 0};   // w, x, y, z
    std::array<glm::vec3, 9> irradiance; // E_lm, orthonormal, Condon-Shortley; white: 11.1367, 0 …
    std::vector<std::array<Bytes, 6>> images; // PNG in RGBD, sharpest level first
};

// How the radiance is fitted into RGBD.
struct RgbdFit {
    float scale = 1.0f;     // radiance is stored divided by this power of two
    bool tooBright = false; // some of it is above 255 · scale and will be cut
};
// 1 for ordinary images, whose mean is between 1/4 and 4: they keep their numbers.
[[nodiscard]] RgbdFit fitRgbd(const Image& environment);

// Computes and encodes the light. The environment has an image. Errors: Cancelled, encoding.
Result<GltfEnvironment> encodeGltfEnvironment(WorkerClient& worker, const Environment& environment,
                                              const JobContext& job);

} // namespace patina
