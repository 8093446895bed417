// What the Light lab shows: the environment and everything computed from it for shading, as
// pictures by the direction in the world. A value; what is heavy is shared.
#pragma once

#include "core/light/EnvironmentLookup.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

enum class LabKind {
    Environment,
    Faces,           // of the cubemap that reflections start from; `index` 1…6: one of them alone
    Irradiance,      // from nine coefficients
    IrradianceExact, // as surfaces take it: the last prefiltered level is irradiance / pi
    Harmonics,       // the sum of `index` bands, 1…8
    Prefiltered,     // roughnessStep(`index`)
    Dfg              // channel `index` of the table: scale, bias, mean direction
};

struct LabView {
    LabKind kind = LabKind::Environment;
    int index = 0;
    friend bool operator==(const LabView&, const LabView&) = default;

    [[nodiscard]] bool isCross() const { return kind == LabKind::Faces && index == 0; }
    [[nodiscard]] bool isFace() const { return kind == LabKind::Faces && index > 0; }
    [[nodiscard]] bool isTable() const { return kind == LabKind::Dfg; }
    [[nodiscard]] bool isIrradiance() const {
        return kind == LabKind::Irradiance || kind == LabKind::IrradianceExact;
    }
};

// One of the faces +X -X +Y -Y +Z -Z, 1…6: its name, and its column and row in a cross.
struct LabFace {
    const char* name; // UTF-8
    int column, row;
};
[[nodiscard]] const LabFace& labFace(int index);

// Smaller pictures of what is large: those of any size are drawn from them.
struct LabReductions {
    std::vector<ImagePtr> environment;      // finest first
    std::array<ImagePtr, kMaxShOrder> sums; // of 1…8 bands, small lat-longs
};
using LabReductionsPtr = std::shared_ptr<const LabReductions>;

// Null after a cancel.
[[nodiscard]] LabReductionsPtr reduceForPictures(const EnvironmentAnalysis& analysis,
                                                 const JobContext& job);

struct LabLight {
    EnvironmentLookup lookup;
    LabReductionsPtr reductions; // of its analysis; null as long as that is

    // Radiance (irradiance for the irradiance maps) that the scene gets from a direction of the
    // world; nothing while it is not computed. Not of the DFG table.
    [[nodiscard]] std::optional<glm::vec3> value(LabView view, const glm::vec3& world) const;
};

} // namespace patina::editor
