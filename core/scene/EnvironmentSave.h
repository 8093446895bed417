// Writing the environment of a scene as files of any layout.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <vector>

namespace patina {

class WorkerClient;

struct EnvironmentSaveSettings {
    std::filesystem::path
        output; // .exr (32-bit float) or .hdr; six faces add _px, _nx … to its name
    EnvironmentLayout layout = EnvironmentLayout::LatLong;
    int size = 0; // as EnvironmentMapping::imageSize() counts; 0: keeps the detail
    // .exr as lat-long or vertical strip: the conventions that OpenEXR's envmap attribute
    // announces, and the attribute. Programs that do not know it see such a lat-long half a turn
    // away.
    bool openExrEnvmap = false;
};

// What a file needs to keep the detail of a lat-long of this width: its own width, the same
// diameter, or a third of it (a multiple of 8) for a face.
[[nodiscard]] int environmentSaveSize(EnvironmentLayout layout, int latLongWidth);

// The files that will be written. Usage error when the settings make no sense together.
Result<std::vector<std::filesystem::path>>
environmentOutputs(const EnvironmentSaveSettings& settings);

// Writes the environment as the scene shows it, rotated, tilted, rolled and brightened by
// exposureEv. Every file is written atomically; after an error or a cancel none of the new ones is
// left. Errors: those of environmentOutputs(), CannotCreate, Io, Cancelled.
Result<std::vector<std::filesystem::path>> saveEnvironment(WorkerClient& worker,
                                                           const Environment& environment,
                                                           const EnvironmentSaveSettings& settings,
                                                           const JobContext& job = {});

} // namespace patina
