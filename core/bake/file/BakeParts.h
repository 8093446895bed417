// Bakes as the parts of an OpenEXR file and back: the layout of docs/prt-format.md, without the
// file.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/bake/file/BakeChannels.h"
#include "core/bake/file/BakeHeader.h"
#include "core/base/Result.h"
#include "core/io/ImageIO.h"

#include <filesystem>
#include <vector>

namespace patina {

struct Document;

inline constexpr int kMaxBakeRow = 4096; // vertices per image row

// One part per mesh or material that the document still has with as many vertices; the others are
// left out. When none is left, one part of a single pixel keeps the attributes.
// Quantised storage is for transfer.
[[nodiscard]] std::vector<ImagePart> bakeToParts(const BakeArtifact& artifact,
                                                 const Document& document,
                                                 const BakeFileOptions& options = {});

// Reads this version and older ones. Errors (InputBroken, naming `file`): no bake, of a newer
// version, damaged, of other geometry (saying what differs).
Result<BakeArtifact> bakeFromParts(const std::vector<ImagePart>& parts, const Document& document,
                                   const std::filesystem::path& file);

// The numbers of one part, without the document. `header`: readBakeHeader() of its attributes.
// Errors (InputBroken, naming `file`): damaged.
Result<BakeElements> elementsFromPart(const ImagePart& part, const BakeHeader& header,
                                      const std::filesystem::path& file);

} // namespace patina
