// Environment files of every layout: reading them, and telling which layout they have.
#pragma once

#include "core/document/Document.h"
#include "core/light/EnvironmentMapping.h"
#include "core/scene/Scene.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace patina {

// Floating-point pictures with longer sides are averaged down to it while they are read: still
// twice what the light is kept at.
inline constexpr int kMaxEnvironmentSide = 8192;

// A picture of the environment as it is in its file (six files: on top of each other).
struct EnvironmentPicture {
    Image image;                                           // F32 RGB, linear Rec.709
    EnvironmentLayout layout = EnvironmentLayout::LatLong; // never Automatic
    EnvironmentConvention convention = EnvironmentConvention::Common;
    EnvironmentMapping mapping;
};

// `layout` Automatic guesses: OpenEXR's envmap attribute, names of six files, proportions, unused
// corners that are empty; what fits nothing is taken for a lat-long. A layout that is given is not
// questioned, but its proportions must fit. `notices` receives doubts, repaired pixels and a low
// dynamic range.
// Errors: those of loadImage(), Usage when the layout does not fit, Cancelled.
Result<EnvironmentPicture> readEnvironmentPicture(WorkerClient& worker,
                                                  const std::filesystem::path& file,
                                                  EnvironmentLayout layout,
                                                  std::vector<Notice>& notices,
                                                  const JobContext& job = {});

// The picture as a lat-long, F32 RGB, w = 2h, at most so wide; one of proportions that no layout
// has is stretched. Meaningless after a cancel.
[[nodiscard]] Image latLongOf(const EnvironmentPicture& picture, int maxWidth,
                              const JobContext& job = {});

// The guess for one picture and its file's attributes; a lat-long when nothing fits.
struct LayoutGuess {
    EnvironmentLayout layout = EnvironmentLayout::LatLong;
    EnvironmentConvention convention = EnvironmentConvention::Common;
    bool fits = true; // false: its proportions are those of no layout
};
[[nodiscard]] LayoutGuess guessLayout(const Image& image,
                                      const std::map<std::string, std::string>& attributes);

// The six files of which `file` is one, in the order +X -X +Y -Y +Z -Z: "sky_px.hdr" …
// "sky_nz.hdr", "posx", "right", "+x" …, in any case. Empty when its name ends like none of them;
// the others need not exist.
[[nodiscard]] std::vector<std::filesystem::path> sixFaceFiles(const std::filesystem::path& file);
// "OUT.exr" to "OUT_px.exr" …
[[nodiscard]] std::array<std::filesystem::path, 6>
sixFaceOutputs(const std::filesystem::path& output);

// "Angular map", as in the parameter table.
[[nodiscard]] std::string_view layoutLabel(EnvironmentLayout layout);
// "angularMap" and "angular-map" alike; nothing for other names.
[[nodiscard]] std::optional<EnvironmentLayout> layoutNamed(std::string_view name);

} // namespace patina
