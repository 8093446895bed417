// `patina render --error-against`: how far a picture is from a reference of the same scene.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/trace/path/TraceHash.h"

#include <map>
#include <optional>
#include <string>

namespace patina::cli {

// What a picture is of: written into the header of an .exr, and held against that of a reference.
struct PictureSubject {
    TraceHash scene;
    std::string camera, background; // cameraText(), backgroundText()
};
[[nodiscard]] PictureSubject subjectOf(const Document& document, const Camera& camera);
// "patina:scene.geometry" …
[[nodiscard]] std::map<std::string, std::string> attributesOf(const PictureSubject& subject);

// Linear radiance, three channels. Errors, before anything is drawn: those of loadImage();
// InputBroken for a displayed picture, one of another size, and one whose header says that it is of
// another scene, camera or background: the message says which. A reference that says nothing is
// believed.
Result<Image> loadReference(Session& session, const std::string& file, int width, int height,
                            const PictureSubject& subject);

// Puts rmse, relmse, psnr, flip, bias and max into the report. `radiance`: linear, three channels
// or more, of the reference's size. Errors: InputBroken for numbers that are not finite; Cancelled.
Result<void> reportError(Session& session, const std::string& file, const Image& radiance,
                         const Image& reference);

} // namespace patina::cli
