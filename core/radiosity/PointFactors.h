// Form factors by what single points of an element or patch see: a map of the hemisphere above
// each, of whose cells each counts as much as the form factor through it. One point, the centre,
// stands for it, or several where others are near. HemicubeFactors and ParaboloidFactors are the
// maps.
#pragma once

#include "core/math/Quadrature.h"
#include "core/radiosity/FormFactors.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::radiosity {

class PointFactors : public FormFactors {
  public:
    // What is seen through a cell where it is no element.
    static constexpr std::uint32_t kBack = kNone - 1, kOutside = kNone;

    void row(std::uint32_t sender, FactorRow& row) const final;

    // Form factor through each cell of the map, >= 0 and 1 in all; 0 of what is no cell.
    [[nodiscard]] virtual std::span<const double> weights() const = 0;
    // What the centre of a sender sees through each cell: an element, kBack (a side that only
    // absorbs) or kOutside. With FactorSettings::centreOnly the row is the sum of its cells.
    [[nodiscard]] std::vector<std::uint32_t> seenFromCentre(std::uint32_t sender) const;

  protected:
    PointFactors(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings)
        : m_elements(elements)
        , m_rays(rays)
        , m_settings(settings)
        , m_stands(settings.stands > 1 ? settings.stands : kUsualStands) {}

    // `seen`: as many as weights(), of each cell of the map above `from`, a point of the sender.
    // `frame`: the map's axes, z the sender's normal. Callable from any thread.
    virtual void look(std::uint32_t sender, const glm::vec3& from, const glm::mat3& frame,
                      std::span<std::uint32_t> seen) const = 0;

    const ElementMesh& m_elements;
    const RayScene& m_rays;

  private:
    // Rotated about the normal by an angle of the sender's own: edges of cells that line up with
    // those of elements would make the same error everywhere.
    [[nodiscard]] glm::mat3 frameOf(std::uint32_t sender) const;
    [[nodiscard]] bool isNear(std::uint32_t sender, const FactorRow& row) const;

    static constexpr int kUsualStands = 3; // where one is not enough

    FactorSettings m_settings;
    GaussLegendre m_stands;
};

} // namespace patina::radiosity
