// A lobe drawn in space without OpenGL, on any thread: shaded, with rings at equal values, over the
// disc of the surface and with the light that makes it.
#pragma once

#include "core/light/LobeMesh.h"

#include <QColor>
#include <QImage>
#include <optional>

namespace patina::editor {

// Looks at the point from outside, in parallel. The light stands at -x.
struct LobeCamera {
    double yawDeg = 28.0;       // about the normal; 0 sees the plane of incidence face on
    double elevationDeg = 20.0; // above the surface
    friend bool operator==(const LobeCamera&, const LobeCamera&) = default;
};

// `ring`: of the disc's rim, so that a lobe is known by its colour. `ratio`: pixels of a stroke of
// width 1.
[[nodiscard]] QImage lobePicture(const LobeMesh& mesh, const LobeCamera& camera, float incidenceRad,
                                 QSize pixels, QColor ring, double ratio);

// Where a point of the lobe's space lies in a picture of `size`, and the nearest point of the lobe
// at a point of the picture; nothing beside it.
[[nodiscard]] QPointF lobePoint(const LobeCamera& camera, const QSizeF& size, const glm::vec3& p);
[[nodiscard]] std::optional<glm::vec3> lobeHit(const LobeMesh& mesh, const LobeCamera& camera,
                                               const QSizeF& size, const QPointF& point);

} // namespace patina::editor
