// Looks of other times put into a document, as a whole or value by value.
#pragma once

#include "core/document/Document.h"
#include "core/edit/LookDifference.h"

#include <span>
#include <string>
#include <vector>

namespace patina {

// Why a difference cannot be restored in the document to what `look` has, as the end of a sentence
// that begins with its element; empty when it can be. Materials and environments that came later
// are kept (nothing of the look shows them), and geometry that is gone is not brought back.
[[nodiscard]] std::string whyNotRestored(const Document& document, const Look& look,
                                         const LookDifference& difference);

// Gives the document what `look` has, of those differences that can be restored. What a value
// needs comes with it: an element that was removed since, the other environment of the mix where
// both would be the same one, an image's layout with the image. Names and camera stay. Generated
// images follow as after each edit (resolveCell(), the editor's resolver).
void restoreLook(Document& document, const Look& look, std::span<const LookDifference> differences);

// The document with the whole look. Bakes and geometry are the document's.
[[nodiscard]] Document withLook(Document document, const Look& look);

// "Snapshot 3": what no snapshot is called yet.
[[nodiscard]] std::string uniqueSnapshotName(const Document& document, std::string_view name);

} // namespace patina
