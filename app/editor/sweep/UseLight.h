// Lights the scene with a light that a sweep found.
#pragma once

namespace patina::editor {

class DocumentController;
struct SweptEnvironment;

// The environment lights the scene alone, rotated, as one undo step: at once where it is the
// document's, else when its file is read. A notice says why it could not be. False: it was the
// document's and is there no more.
bool useLight(DocumentController& controller, const SweptEnvironment& environment,
              double rotationDeg);

} // namespace patina::editor
