// From a radiosity per element to light that runs smoothly over a surface: a mesh of triangles
// without gaps, and the values at its vertices whose means over the elements are the solution.
// Averages of neighbours would shrink every gradient and be half an element off at each edge;
// least squares are not: Kavan, Bargteil & Sloan 2011, "Least Squares Vertex Baking".
#pragma once

#include "core/job/JobContext.h"
#include "core/radiosity/ElementMesh.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::radiosity {

// The elements as triangles. Where an element's edge meets corners of smaller ones they are its
// corners, too, so that nothing gapes.
struct LitMesh {
    struct Vertex {
        glm::vec3 position{0.0f}; // metres, world
        glm::vec3 normal{0.0f};   // unit, world: the scene's own, interpolated
        glm::vec2 uv{0.0f};
        std::uint32_t light = 0; // which number it shares with the vertices that it runs on to
    };
    struct Triangle {
        std::array<std::uint32_t, 3> vertices{};
        std::uint32_t element = 0;
    };
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles; // by mesh of the scene, and by side
    std::size_t lights = 0;          // numbers of vertices that are smooth among themselves

    [[nodiscard]] double area(const Triangle& triangle) const; // m²
};

// Light runs on over an edge where the scene's vertex normals do: not over creases, from mesh to
// mesh or from side to side, and not below what stands on the edge of elements that end there
// (Face::fenced). `elements` as made of `geometry`, `rays` of the same scene.
[[nodiscard]] LitMesh litMesh(const ElementMesh& elements, const BakeGeometry& geometry,
                              const RayScene& rays);

// A value per `light` of the mesh, from one per element of what it was made of. Elements count as
// far as they are exposed; light runs on below what buries them. Never below 0 where no value is.
[[nodiscard]] std::vector<glm::dvec3> vertexLight(const LitMesh& mesh, const ElementMesh& elements,
                                                  std::span<const glm::dvec3> values);

} // namespace patina::radiosity
