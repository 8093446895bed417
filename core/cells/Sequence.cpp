#include "core/cells/Sequence.h"

#include "core/base/Check.h"
#include "core/light/Environment.h"

#include <cmath>
#include <fmt/format.h>

namespace patina {
namespace {

// -180 … 180, as both parameters have it.
float wrapped(float degrees) {
    return std::remainder(degrees, 360.0f);
}

} // namespace

Cell sequenceCell(const Document& document, Turning turning, int frame, int count) {
    CHECK(count > 0 && frame >= 0 && frame < count);
    const float step = 360.0f * static_cast<float>(frame) / static_cast<float>(count);
    Cell cell;
    if (frame == 0)
        return cell;
    if (turning == Turning::Camera) {
        cell.camera = document.view.camera;
        cell.camera->yawDeg = wrapped(cell.camera->yawDeg + step);
    } else {
        cell.own.push_back({{Scope::Environment, 0},
                            findParameter("environment.rotationDeg"),
                            wrapped(document.environment().rotationDeg + step)});
    }
    return cell;
}

std::filesystem::path sequenceFile(const std::filesystem::path& file, int frame) {
    std::filesystem::path numbered = file;
    numbered.replace_filename(
        fmt::format("{}-{:04}{}", file.stem().string(), frame + 1, file.extension().string()));
    return numbered;
}

} // namespace patina
