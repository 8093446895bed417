// Which mesh or material of a document a part of a bake file belongs to, and why it does not fit.
#pragma once

#include "core/bake/file/BakeHeader.h"
#include "core/document/Document.h"
#include "core/material/Material.h"

#include <map>
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

// Finds the targets of parts: by name; by position when nothing has that name any more. Refers to
// the document.
class BakeTargets {
  public:
    explicit BakeTargets(const Document& document);
    [[nodiscard]] std::optional<std::size_t> mesh(const BakeAttributes& attributes) const;
    [[nodiscard]] std::optional<std::size_t> material(const BakeAttributes& attributes) const;
    [[nodiscard]] const Document& document() const { return m_document; }

  private:
    const Document& m_document;
    std::map<std::string, std::size_t> m_meshes, m_materials; // by the name of their parts
};

// What differs between the mesh that a part was made from and the document's, as the end of a
// sentence that starts with "the bake": "was made for …"; empty when nothing does.
[[nodiscard]] std::string meshMismatch(const BakeTargets& targets,
                                       const BakeAttributes& attributes);
// Whether the mesh stands where it stood; true when the file does not say (version 1).
[[nodiscard]] bool sameTransform(const MeshInstance& mesh, const BakeAttributes& attributes);

} // namespace patina
