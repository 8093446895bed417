// Bakes of more meshes or materials than an OpenEXR file has parts for: several of them in one
// part, and back (docs/prt-format.md, "Several meshes in a part").
#pragma once

#include "core/base/Result.h"
#include "core/io/ImageIO.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace patina {

// Files of more parts than this are packed; smaller ones stay as programs know them.
inline constexpr std::size_t kMaxPlainParts = 1024;
// What `patina:version` says in packed parts, whatever their members say: one more than plain parts
// of that time, so that readers which know nothing of packing refuse it instead of finding nothing.
inline constexpr int kPackedBakeVersion = 4;
inline constexpr int kFirstPackedBakeVersion = 3; // members of version 2
inline constexpr const char* kPackedAttribute = "patina:packed";

// The parts as they are where they are few; else parts that hold the pixels of several, those with
// the same channels, one after another in rows of kMaxBakeRow. What the members say alike the
// packed part says once, the rest is in its kPackedAttribute (JSON).
[[nodiscard]] std::vector<ImagePart> packParts(std::vector<ImagePart> parts,
                                               std::size_t maxPlain = kMaxPlainParts);

[[nodiscard]] bool isPacked(const ImagePart& part);
// The members of packed parts, bit for bit as they were; plain parts are handed through, and those
// of a newer version, too. Errors
// (InputBroken, naming `file`): the description of a packed part is damaged or does not fit it.
Result<std::vector<ImagePart>> unpackParts(std::vector<ImagePart> parts,
                                           const std::filesystem::path& file);

} // namespace patina
