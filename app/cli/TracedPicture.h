// Traced pictures as files: what paths brought, as `patina render` and `patina merge` write it.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "core/trace/file/FilmFile.h"
#include "core/trace/path/PathTracer.h"

#include <string>

namespace patina::cli {

// Parameters of the view that decide how light is displayed, by name.
[[nodiscard]] StateSettings displaySettings(const Document& document);
// "30,15,4 at 0,0,0, 35°": yaw, pitch, distance, target, field of view.
[[nodiscard]] std::string cameraText(const Camera& camera);
[[nodiscard]] std::string backgroundText(const View& view);

// Usage error where the picture could not be displayed as the view asks.
Result<void> checkDisplay(const View& view, ImageFileFormat format);

// Settings of FilmManifest: where the picture was taken, what is behind the scene, and what is
// written besides the picture (--aov).
inline constexpr const char* kCameraSetting = "camera";
inline constexpr const char* kBackgroundSetting = "background";
inline constexpr const char* kOutputsSetting = "aov";

// Writes film and outputs as the manifest says, linear or displayed as the format has it; a picture
// that cannot be written there is kept in the folder for temporary files, and the error says so.
// `more`: parts of the file besides. Errors: InputBroken for a manifest with a view that does not
// exist; those of writePictures().
Result<void> writeTracedPicture(Session& session, const FilmManifest& manifest, const Film& film,
                                const TraceOutputs& outputs, std::vector<ImagePart> more,
                                const std::string& output, ImageFileFormat format);

// `patina merge` of parts of traced pictures.
Result<void> mergeFilms(Session& session, const MergeOptions& options);
// What `patina info` says of a part or checkpoint.
Result<void> describeUnfinishedPicture(Report& report, const std::string& file);

} // namespace patina::cli
