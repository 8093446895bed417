// Unsaved work as a value and as a file: the document's values as project JSON, and what the work
// is, so that it can be offered without opening it. The file ends with a hash of its content: one
// that is damaged is an error, never a document with other values.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace patina {

// A bake that was attached to the document.
struct RecoveryBake {
    BakeKind kind = BakeKind::AoTexel;
    Hash content;        // names the copy in the session's folder; zero: the saved project has it
    Hash inputs;         // BakeArtifact::inputs, to know the saved project's by
    int samplesDone = 0; // the same
    friend bool operator==(const RecoveryBake&, const RecoveryBake&) = default;
};

struct RecoveryRecord {
    std::string name;              // UTF-8, as the window's title says: "helmet.patina", "Untitled"
    std::filesystem::path file;    // absolute; of the saved project, empty: it was never saved
    Hash savedContent;             // hashFile(file) when it was opened or saved last; zero: unknown
    std::int64_t writtenAt = 0;    // seconds since 1970, UTC
    std::int64_t unsavedSince = 0; // the same, of the first unsaved change
    int steps = 0;                 // undo steps since the last save; 0: unknown
    std::string lastStep;          // UTF-8: "Change Roughness of Gold"
    int meshes = 0, materials = 0, lights = 0;
    std::vector<RecoveryBake> bakes;
    std::vector<std::string> leftOut; // sentences for the user: what is not kept, and why
    std::vector<std::string> outside; // pictures that the project may not show (OutsidePictures.h)
    std::string project;              // documentToJson() for projectFile()
    friend bool operator==(const RecoveryRecord&, const RecoveryRecord&) = default;

    // What the paths in `project` are relative to: `file`, or a name in the root folder.
    [[nodiscard]] std::filesystem::path projectFile() const;
};

// Errors: CannotCreate, Io; what the file held before is then still there.
Result<void> writeRecoveryRecord(const std::filesystem::path& file, const RecoveryRecord& record);
// Errors: InputMissing, InputBroken (cut short, altered, of a newer version).
Result<RecoveryRecord> readRecoveryRecord(const std::filesystem::path& file);

// Of the bytes of a project file; zero when it cannot be read.
[[nodiscard]] Hash hashFile(const std::filesystem::path& file);

} // namespace patina
