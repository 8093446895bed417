// Copies of bakes that exist nowhere but in memory, beside the record of unsaved work, named by
// their content: a bake is written once, however often the record is.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace patina {

struct Document;

[[nodiscard]] Hash hashBake(const BakeArtifact& artifact); // reads every value

// `document`: the one it is attached to. Errors: CannotCreate, Io; Usage when it holds values of
// meshes or materials that the document has no more.
Result<void> keepBake(const std::filesystem::path& folder, const Hash& content,
                      const BakeArtifact& artifact, const Document& document);
// Nothing when it is missing or damaged, or of another document.
[[nodiscard]] std::optional<BakeArtifact> keptBake(const std::filesystem::path& folder,
                                                   const Hash& content, const Document& document);
// Removes all others.
void removeBakesExcept(const std::filesystem::path& folder, std::span<const Hash> kept);

} // namespace patina
