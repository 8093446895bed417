// What the project's writer and reader agree on.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/edit/Parameters.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace patina::project {

// Ids stay below, so that they also fit a signed number.
inline constexpr Id kMaxId = 2'000'000'000;

inline constexpr std::array<std::string_view, 4> kMapChannels{"r", "g", "b", "a"};
inline constexpr std::string_view kRgbChannel = "rgb";

inline constexpr std::array<std::pair<BakeKind, std::string_view>, 5> kBakeKinds{{
    {BakeKind::AoTexel, "aoTexel"},
    {BakeKind::AoVertex, "aoVertex"},
    {BakeKind::PrtVertex, "prtVertex"},
    {BakeKind::PrtTexel, "prtTexel"},
    {BakeKind::LightMap, "lightMap"},
}};

// "metallic" of "material.metallic": parameters are keys without their scope.
[[nodiscard]] inline std::string keyOf(const ParameterInfo& info) {
    return std::string(info.id.substr(info.id.find('.') + 1));
}

// "chair.bakes/aoTexel.exr" beside "chair.patina": what a bake is called where its content does not
// matter, and what it was called by earlier versions. Saving names it by its content
// (ProjectBakes.h).
[[nodiscard]] std::filesystem::path bakeFile(const std::filesystem::path& projectFile,
                                             BakeKind kind);

// What a camera may be; the parameter table only knows its field of view.
[[nodiscard]] Camera sanitizeCamera(Camera camera);

struct BakeReference {
    BakeKind kind = BakeKind::AoTexel;
    std::string file; // absolute
};
struct ParsedProject {
    Document document;                // every payload null
    std::vector<std::string> leftOut; // snapshots that cannot be read: why
    std::vector<BakeReference> bakes;
    std::vector<std::string>
        unknown; // keys that are kept, by their place: "materials[3].clearcoat"
};
// The project's text with these files for its bakes.
[[nodiscard]] std::string projectText(const Document& document,
                                      const std::filesystem::path& projectFile,
                                      const std::map<BakeKind, std::string>& bakes);
[[nodiscard]] Result<ParsedProject> parseProject(const std::string& json,
                                                 const std::filesystem::path& projectFile);

} // namespace patina::project
