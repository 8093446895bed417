// Pictures that a model names outside its own folder: private ones, perhaps, that a model from
// somebody else would show and an export take along. They are left out, and so neither shown nor
// exported, until the user agrees (WorkerClient::allowOutside()), once for each model file.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <vector>

namespace patina {

// MapSlot::problem of a picture that was left out.
inline constexpr const char* kOutsideProblem =
    "it lies outside the model's folder and was not read";

struct OutsidePictures {
    std::vector<std::string> models; // files of the meshes that show them, each once
    std::vector<std::string> files;  // the pictures (MapSlot::source), each once
};

[[nodiscard]] OutsidePictures outsidePictures(const Document& document);
// The pictures that meshes of this file show.
[[nodiscard]] std::vector<std::string> outsidePicturesOf(const Document& document,
                                                         const std::string& model);

// Puts `image` into every slot that `source` was left out of, where their colours are encoded as
// `encoding` says.
void fillOutsidePicture(Document& document, const std::string& source, ColorEncoding encoding,
                        const ImagePtr& image);

} // namespace patina
