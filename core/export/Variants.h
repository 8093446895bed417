// The snapshots of a document as variants of its materials (KHR_materials_variants): what a
// program that opens the file can switch between.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <vector>

namespace patina {

// Whether a snapshot shows a mesh of the document in another material than the document does, or in
// the same one with other values. Names are no difference.
[[nodiscard]] bool hasMaterialVariants(const Document& document);

// The material of a mesh in each of Document::snapshots, in their order. Null: as in the document,
// also for meshes that came later. Of a mesh that has no material there the default one. Points
// into the looks and stays valid as long as they are there.
[[nodiscard]] std::vector<const Material*> variantsOf(const Document& document,
                                                      const MeshInstance& mesh);

} // namespace patina
