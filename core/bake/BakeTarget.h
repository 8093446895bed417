// Which mesh or material of a document a part of a bake file belongs to, and why it does not fit.
#pragma once

#include "core/bake/BakeHeader.h"
#include "core/document/Document.h"

#include <optional>
#include <string>
#include <vector>

namespace patina {

inline constexpr const char* kTargetAttribute = "patina:target";
inline constexpr const char* kVertexCountAttribute = "patina:vertexCount";

// Names of the parts: the elements', numbered where they repeat.
[[nodiscard]] std::vector<std::string> partNames(const std::vector<MeshInstance>& meshes);
[[nodiscard]] std::vector<std::string> partNames(const std::vector<Material>& materials);

// What a part says about its target.
void describeMesh(const MeshInstance& mesh, const std::string& name, std::size_t index,
                  BakeAttributes& attributes);
void describeMaterial(const std::string& name, std::size_t index, BakeAttributes& attributes);

// By name; by position when nothing has that name any more.
[[nodiscard]] std::optional<std::size_t> meshOfPart(const Document& document,
                                                    const BakeAttributes& attributes);
[[nodiscard]] std::optional<std::size_t> materialOfPart(const Document& document,
                                                        const BakeAttributes& attributes);

// What differs between the mesh that a part was made from and the document's, as the end of a
// sentence that starts with "the bake": "was made for …"; empty when nothing does.
[[nodiscard]] std::string meshMismatch(const Document& document, const BakeAttributes& attributes);
// Whether the mesh stands where it stood; true when the file does not say (version 1).
[[nodiscard]] bool sameTransform(const MeshInstance& mesh, const BakeAttributes& attributes);

} // namespace patina
