// A point that is stuck to a surface: it goes where the mesh goes, and is found again in each
// frame.
#pragma once

#include "core/document/Document.h"
#include "render/view/Inspection.h"

#include <QPointF>
#include <QSizeF>
#include <optional>

namespace patina::editor {

class SurfacePin {
  public:
    // At an inspected point of a surface.
    SurfacePin(const render::Inspection& at, const Document& document);

    [[nodiscard]] Id mesh() const { return m_mesh; }

    // Nothing when its mesh is gone.
    [[nodiscard]] std::optional<glm::vec3> position(const Document& document) const;

    // Where it is in a picture of `size`, from the top left; nothing when it is outside of it.
    [[nodiscard]] std::optional<QPointF> place(const Document& document, const QSizeF& size) const;

    // Whether the pixel that place() is in shows this very point, and nothing in front of it.
    [[nodiscard]] bool isSeen(const render::Inspection& there, const Document& document) const;

  private:
    Id m_mesh;
    glm::vec3 m_local; // in the mesh's space
};

} // namespace patina::editor
