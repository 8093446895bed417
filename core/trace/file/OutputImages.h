// Film and outputs of a traced picture as images, each with the name that it has in a file.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/math/Camera.h"
#include "core/trace/path/Film.h"
#include "core/trace/path/TraceOutputs.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

enum class OutputKind {
    Beauty,
    Background,
    Emission,
    DirectDiffuse,
    DirectSpecular,
    IndirectDiffuse,
    IndirectSpecular,
    Albedo,
    Normal,
    Position,
    Depth,
    Coverage,
    Samples,
    StandardError
};

struct OutputInfo {
    OutputKind kind;
    std::string_view id;    // as in files and options: "directDiffuse"
    std::string_view label; // "Direct diffuse"
    std::string_view unit;  // "m", or empty
    std::string_view channels;
};

[[nodiscard]] std::span<const OutputInfo> outputInfos(); // in the order of files

// "all", or names separated by commas, in any order; the picture itself is always the first. Usage
// error naming those that there are.
Result<std::vector<const OutputInfo*>> parseOutputs(std::string_view text);
// As parseOutputs() reads them.
[[nodiscard]] std::string namesOf(std::span<const OutputInfo* const> chosen);
// Whether any of them is read from TraceOutputs.
[[nodiscard]] bool needTraceOutputs(std::span<const OutputInfo* const> chosen);

// F32, linear, with the channels' names. What is of a surface is the mean over the paths that met
// one, and 0 where none did; light is the mean over all paths. `camera`: where the picture was
// taken; `alpha`: of the beauty. `outputs` may be empty for kinds that do not need them.
[[nodiscard]] Image outputImage(OutputKind kind, const Film& film, const TraceOutputs& outputs,
                                const Camera& camera, bool alpha);

} // namespace patina
