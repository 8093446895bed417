// Pictures that a model or a project names outside its own folder: private ones, perhaps, that a
// file from somebody else would show and an export take along. They are left out, and so neither
// shown nor exported, until the user agrees: once for each model file
// (WorkerClient::allowOutside()), and of a project for each picture that was not in it when the
// user saved it here (OutsideGrants.h).
#pragma once

#include "core/document/Document.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

// MapSlot::problem of a picture that was left out, and Environment::problem.
inline constexpr const char* kOutsideProblem =
    "it lies outside the model's folder and was not read";
inline constexpr const char* kOutsideProjectProblem =
    "it lies outside the project's folder and was not read";

struct OutsidePictures {
    std::vector<std::string> models;    // files of the meshes that show them, each once
    std::vector<std::string> files;     // the pictures (MapSlot::source), each once
    std::vector<std::string> ofProject; // those of them that the project itself names
    std::vector<std::string> ofMaps;    // those of them that maps show; others are environments
};

[[nodiscard]] OutsidePictures outsidePictures(const Document& document);
// The pictures that meshes of this file show.
[[nodiscard]] std::vector<std::string> outsidePicturesOf(const Document& document,
                                                         const std::string& model);

// The file that is read for a source: of an image inside a model, the model. Empty for
// builtin:NAME.
[[nodiscard]] std::string fileOfPicture(const std::string& source);
// The files outside the project's folder that its maps and environments show, snapshots included;
// none that were left out or could not be read.
[[nodiscard]] std::vector<std::string> shownFromOutside(const Document& document,
                                                        const std::filesystem::path& project);

// Puts `image` into every slot that `source` was left out of, where their colours are encoded as
// `encoding` says, in snapshots, too.
void fillOutsidePicture(Document& document, const std::string& source, ColorEncoding encoding,
                        const ImagePtr& image);
// The same for environments of that layout. The picture of the mix is to be made anew after that.
void fillOutsideEnvironment(Document& document, const std::string& source, EnvironmentLayout layout,
                            const ImagePtr& image);

} // namespace patina
