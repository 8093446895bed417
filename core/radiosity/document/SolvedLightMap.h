// The light map of a solution as it is in its file: what its picture is made of, for any exposure.
// Private to this module.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/image/Image.h"
#include "core/radiosity/document/Reexpose.h"

#include <filesystem>
#include <optional>

namespace patina {

class WorkerClient;

class SolvedLightMap {
  public:
    // Errors: InputMissing; InputBroken for what is no such file, or holds numbers that are not
    // finite; Cancelled.
    static Result<SolvedLightMap> read(WorkerClient& worker, const std::filesystem::path& file,
                                       const JobContext& job);

    [[nodiscard]] const Bytes& bytes() const { return m_bytes; }  // of the file
    [[nodiscard]] int side() const { return m_radiance.width(); } // texels
    // k, 0 of Kind::None. Errors: Usage for the automatic one of files of older versions, which do
    // not hold it.
    [[nodiscard]] Result<double> exposureOf(const ExposureRequest& request) const;
    // A PNG, 8-bit sRGB.
    [[nodiscard]] Result<Bytes> picture(WorkerClient& worker, double k) const;

  private:
    std::filesystem::path m_file;
    Bytes m_bytes;
    Image m_radiance; // RGB, F32
    std::optional<double> m_automatic;
};

} // namespace patina
