// A solution as files that other programs show: the plan of them, which an export runs.
#pragma once

#include "core/base/Result.h"
#include "core/export/Export.h"
#include "core/math/Camera.h"
#include "core/radiosity/document/LitDocument.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

// With the dot: COLLADA, glTF in one file or several, PLY.
inline constexpr std::array<std::string_view, 4> kLitFileExtensions{".dae", ".glb", ".gltf",
                                                                    ".ply"};

struct LitFilesSettings {
    std::filesystem::path output; // of one of the extensions
    // Of a .dae: the COLLADA document that the scene was read from, which the light is put into;
    // empty: a new one, seen by `camera`.
    std::filesystem::path document;
    std::string visualScene; // of `document`; empty: the one that it names
    Camera camera;
};

// `source`: that `lit` was made of. The plan holds all that it needs; its warnings tell what was
// left alone. Errors: Usage for other extensions, and for a light map in a .ply; those of
// ColladaDocument::read(), takeScene(), lightCollada(), newLitCollada() and planExport().
Result<ExportPlan> planLitFiles(const LitDocument& lit, const Document& source,
                                const LitFilesSettings& settings);

} // namespace patina
