// What `patina sheet` compares, as a wall of cells.
#pragma once

#include "app/cli/Session.h"
#include "core/cells/Wall.h"

#include <map>
#include <string>

namespace patina::cli {

struct SheetWall {
    Wall wall;
    // Environments of cells whose files have yet to be read, each with its error once that failed.
    struct File {
        std::string source;
        std::string problem;
    };
    std::map<Id, File> files;
};

// Adds to the document what the axes name: environments without their pictures, built-in materials.
// Usage errors say what exists. InputMissing for files that are not there, unless they are skipped.
Result<SheetWall> makeSheetWall(Session& session, const SheetOptions& options, Document& document);

// What stands above the cells: the scene's name.
[[nodiscard]] std::string sceneTitle(const std::string& scene);

} // namespace patina::cli
