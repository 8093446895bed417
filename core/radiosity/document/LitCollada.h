// A radiosity solution as a COLLADA document: the very document that the scene came from, with
// light put into it, or a new one.
#pragma once

#include "core/base/Result.h"
#include "core/export/collada/ColladaDocument.h"
#include "core/radiosity/document/LitDocument.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace patina {

struct LitCollada {
    ColladaDocument document;
    std::vector<std::string> notices; // what was left alone, and why
};

// For scenes from elsewhere. Materials are those of `lit`, textures by the names of their files.
// Errors: those of newColladaDocument().
Result<LitCollada> newLitCollada(const LitDocument& lit, const Camera& camera,
                                 std::chrono::sys_seconds modified,
                                 const std::filesystem::path& output);

// Puts the light into `collada`, which the meshes of `lit` were read from: surfaces are found again
// by where they are. Both sides of a surface become one mesh. A light map is of the files that
// `output` names (lightMapPath()), as of newLitCollada(). Errors: InputBroken where none is
// found; those of ColladaDocument::mesh() and light().
Result<LitCollada> lightCollada(ColladaDocument collada, const Document& source,
                                const LitDocument& lit, std::chrono::sys_seconds modified,
                                const std::filesystem::path& output);

} // namespace patina
