// The hemicube: what an element or patch sees through the cells of half a cube about it, each cell
// counting as much as the form factor through it. Cohen & Greenberg 1985, "The Hemi-Cube: A
// Radiosity Solution for Complex Environments". What is in a cell is found by a ray through its
// middle, or drawn there (FactorSettings::drawer).
#pragma once

#include "core/radiosity/FaceItems.h"
#include "core/radiosity/HemicubeDrawer.h"
#include "core/radiosity/PointFactors.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace patina::radiosity {

// The cells of half a cube of edge 2 about the origin, over the plane z = 0.
class HemicubeCells {
  public:
    struct Cell {
        glm::vec3 direction; // unit, of its middle
        double factor;       // through it, integrated exactly
    };
    enum class Face { Top, Right, Left, Back, Front }; // +z, +x, -x, +y, -y

    explicit HemicubeCells(int resolution); // along an edge of the top; even, at least 2

    [[nodiscard]] std::span<const Cell> cells() const { return m_cells; } // face after face
    [[nodiscard]] int resolution() const { return m_resolution; }
    // Cells of a face: resolution² of the top, half as many of a side.
    [[nodiscard]] std::span<const Cell> cells(Face face) const;

    // Form factor through a part of the top, and of a side whose height is z.
    [[nodiscard]] static double top(double x0, double x1, double y0, double y1);
    [[nodiscard]] static double side(double y0, double y1, double z0, double z1);

  private:
    int m_resolution;
    std::vector<Cell> m_cells;
};

class HemicubeFactors final : public PointFactors {
  public:
    // Errors: those of HemicubeDrawer::load().
    static Result<std::unique_ptr<FormFactors>>
    make(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings);
    // By rays, whatever the settings say.
    HemicubeFactors(const ElementMesh& elements, const RayScene& rays,
                    const FactorSettings& settings);

    [[nodiscard]] std::span<const double> weights() const override { return m_weights; }
    [[nodiscard]] const HemicubeCells& cells() const {
        return m_cells;
    } // in the order of weights()

  private:
    void look(std::uint32_t sender, const glm::vec3& from, const glm::mat3& frame,
              std::span<std::uint32_t> seen) const override;

    void cast(const glm::vec3& from, const glm::mat3& frame, std::span<std::uint32_t> seen) const;

    HemicubeCells m_cells;
    std::vector<double> m_weights;
    std::unique_ptr<const FaceItems> m_faces; // of what is drawn
    std::unique_ptr<const DrawnHemicubes> m_drawn;
};

} // namespace patina::radiosity
