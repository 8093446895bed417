// Image-based light as files for other programs: the prefiltered cubemap with its levels, the
// irradiance cubemap, the DFG table, spherical harmonics, and a manifest that states the
// conventions (docs/maths/ibl.md).
#pragma once

#include "core/base/AtomicFolder.h"
#include "core/image/FloatTexture.h"
#include "core/light/Ibl.h"
#include "core/light/Orientation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

enum class IblFileFormat { Exr, Hdr, Ktx2, Dds };
enum class IblLayout { Faces, LatLong }; // of Exr and Hdr, one file per face or level

struct IblPackageSettings {
    IblFileFormat format = IblFileFormat::Exr;
    IblLayout layout = IblLayout::Faces;
    // Exr: half or float. Hdr has its own texels. The DFG table is never Rgb9E5, nor in an .hdr:
    // shared exponents are too coarse for it.
    TexelFormat texels = TexelFormat::Rgba16F;
};

struct IblPackageSource { // what the manifest says about the origin of light and table
    std::string environment;
    Orientation orientation;
    float exposureEv = 0.0f;
    std::string distribution, visibility; // of the DFG table, as in the parameter table
};

struct IblPackage {
    std::vector<FolderFile> files; // with manifest.json
    std::size_t clamped = 0;       // texels brighter than the format can hold
};

// `maps` with their irradiance cube. Errors: Cancelled, and what encoding an image may fail with.
Result<IblPackage> packIbl(WorkerClient& worker, const IblMaps& maps, const Image& dfgTable,
                           const IblPackageSource& source, const IblPackageSettings& settings,
                           const JobContext& job);

// Whether the folder holds a package and nothing else, so that a new one may replace it.
[[nodiscard]] bool isIblPackage(const std::filesystem::path& folder);

} // namespace patina
