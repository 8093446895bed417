// Form factors by a paraboloid map of what an element sees: an item buffer, into which the scene's
// faces are drawn with their depths. No rays are cast, except for whether a point is within
// something (ElementMesh::isBuried).
#pragma once

#include "core/radiosity/FaceItems.h"
#include "core/radiosity/ParaboloidMap.h"
#include "core/radiosity/PointFactors.h"

#include <cstdint>
#include <span>

namespace patina::radiosity {

class ParaboloidFactors final : public PointFactors {
  public:
    ParaboloidFactors(const ElementMesh& elements, const RayScene& rays,
                      const FactorSettings& settings)
        : PointFactors(elements, rays, settings)
        , m_map(settings.resolution)
        , m_faces(elements) {}

    [[nodiscard]] std::span<const double> weights() const override { return m_map.weights(); }
    [[nodiscard]] const ParaboloidMap& map() const { return m_map; }

  private:
    void look(std::uint32_t sender, const glm::vec3& from, const glm::mat3& frame,
              std::span<std::uint32_t> seen) const override;

    ParaboloidMap m_map;
    FaceItems m_faces;
};

} // namespace patina::radiosity
