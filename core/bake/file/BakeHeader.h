// The text attributes of a bake file that all of its parts share (docs/prt-format.md).
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/base/Result.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace patina {

inline constexpr int kBakeFormatVersion = 3;

using BakeAttributes = std::map<std::string, std::string>;

struct BakeHeader {
    int version = kBakeFormatVersion;
    BakeArtifact artifact; // without elements
    BakeFileOptions options;
};

[[nodiscard]] BakeAttributes headerAttributes(const BakeArtifact& artifact,
                                              const BakeFileOptions& options);
// Errors (InputBroken, naming `file`): no bake, of a newer version, damaged.
Result<BakeHeader> readBakeHeader(const BakeAttributes& attributes,
                                  const std::filesystem::path& file);
// Whether both parts say the same about the bake as a whole.
[[nodiscard]] bool sameHeader(const BakeAttributes& a, const BakeAttributes& b);
// Whether the image with these attributes calls itself a bake.
[[nodiscard]] bool isBakeFile(const BakeAttributes& attributes);

// Looking at attributes. number(): whole, within low…high, or nothing.
[[nodiscard]] const std::string* findAttribute(const BakeAttributes& attributes,
                                               const std::string& key);
[[nodiscard]] std::optional<long long> numberAttribute(const BakeAttributes& attributes,
                                                       const std::string& key, long long low,
                                                       long long high);
// Numbers separated by spaces, all finite; nothing when there are not exactly `count`.
[[nodiscard]] std::optional<std::vector<float>>
floatsAttribute(const BakeAttributes& attributes, const std::string& key, std::size_t count);
[[nodiscard]] std::string floatsText(std::span<const float> values); // exact

[[nodiscard]] Error damagedBake(const std::filesystem::path& file, const std::string& what);

} // namespace patina
