// OpenColorIO's displays and views. A configuration is a file like any other: a worker reads
// it and answers with the view as shader text and textures, so that neither the editor nor the
// command line is linked with the library or can be brought down by a broken configuration.
//
// Patina's linear Rec.709 enters a configuration through its role `aces_interchange` where there is
// one, else as the colour space it knows by one of the usual names, else as its role
// `scene_linear`; DisplayTransform::space says which.
#pragma once

#include "core/base/Result.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

// The OpenColorIO configuration in force: `chosen` where it is not empty, else what the environment
// variable OCIO names; an absolute path. Empty: there is none.
[[nodiscard]] std::string openColorIoConfig(const std::string& chosen);

// What a configuration offers.
struct DisplayMenu {
    struct Display {
        std::string name;
        std::string defaultView;
        std::vector<std::string> views;
        friend bool operator==(const Display&, const Display&) = default;
    };
    std::vector<Display> displays; // at least one, each with a view
    std::string defaultDisplay;

    [[nodiscard]] const Display* find(const std::string& name) const; // empty: the default one
    friend bool operator==(const DisplayMenu&, const DisplayMenu&) = default;
};

// One view of one display, ready for the GPU.
struct DisplayTransform {
    std::string config, display, view; // the file, and the names as resolved
    std::string space;                 // what linear Rec.709 enters the configuration as
    // GLSL 4.0 that defines `vec4 ocioDisplay(vec4)`: exposed linear Rec.709 to display values.
    std::string shader;

    struct Table {
        std::string sampler; // name in `shader`
        int width = 0;
        int height = 0;     // 0: a sampler1D
        int depth = 0;      // 0: no sampler3D
        int channels = 0;   // 1 or 3
        bool linear = true; // interpolated
        std::vector<float> values;
    };
    std::vector<Table> tables;

    // Display values of greys of 0.18 · 2^x, x from -kCurveStops to +kCurveStops in even steps.
    static constexpr int kCurveStops = 8;
    std::vector<float> curve;
};
using DisplayTransformPtr = std::shared_ptr<const DisplayTransform>;

// Errors name the file: InputMissing, InputBroken (no configuration, or it refers to files that are
// missing).
Result<DisplayMenu> loadDisplayMenu(WorkerClient& worker, const std::string& config);
// Empty names: the defaults of the configuration. Errors also for names that it does not have.
Result<DisplayTransform> loadDisplayTransform(WorkerClient& worker, const std::string& config,
                                              const std::string& display, const std::string& view);

} // namespace patina
