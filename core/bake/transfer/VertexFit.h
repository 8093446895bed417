// Values at vertices that, interpolated over the triangles, come closest to what many points of the
// surface saw: least squares instead of the values at the vertices themselves, which miss what
// happens between them and smear it where they hit it.
//
// Kavan, Bargteil & Sloan 2011, "Least Squares Vertex Baking", EGSR: the minimum over vertex values
// c of  Σ_p w_p (Σ_v φ_v(p) c_v - f_p)²  +  λ Σ_edges (jump of the gradient over the edge)².
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/VertexSamples.h"
#include "core/bake/transfer/Passes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// The system of one mesh. Vertices of one position and normal share their values, so that a seam
// of the UVs is no seam of the light.
class VertexFit {
  public:
    // `hidden`, one per vertex, then per point of `points`: nothing reaches this point; it lies
    // within another object, and counts a thousandth of the others.
    // After a cancel the system is not complete, and nothing but destruction makes sense.
    VertexFit(const BakeGeometryMesh& mesh, std::span<const TrianglePoint> points,
              std::span<const std::uint8_t> hidden, const JobContext& job = {});

    // `values`: `stride` floats per vertex, then per point of `points`; the result: `stride` per
    // vertex. Does not depend on the number of threads. After a cancel it is not converged.
    [[nodiscard]] std::vector<float> solve(int stride, std::span<const float> values,
                                           const JobContext& job) const;

    // Per vertex the RMS difference, over the points around it and the stride, between `values`
    // and what `fitted` interpolates to there.
    [[nodiscard]] std::vector<float> residual(int stride, std::span<const float> values,
                                              std::span<const float> fitted) const;

  private:
    struct Triangle { // corners by unknown, and Σ_p w_p φ_i φ_j: 00 11 22 01 12 20
        std::uint32_t corner[3];
        float moment[6];
    };
    struct Edge { // Σ_i weight_i c_i = 0 where the gradient is the same on both sides
        std::uint32_t corner[4];
        float weight[4];
    };
    void addEdges(const JobContext& job);
    template <int kColumns>
    void apply(std::span<const float> x, std::span<float> y) const;
    template <int kColumns>
    void solveColumns(std::size_t first, std::size_t count, std::size_t stride,
                      std::span<const float> values, std::span<float> result,
                      const JobContext& job) const;

    const BakeGeometryMesh& m_mesh;
    std::span<const TrianglePoint> m_points;
    std::vector<std::uint32_t> m_unknownOf; // per vertex
    std::size_t m_unknowns = 0;
    std::vector<float> m_vertexWeight; // per vertex
    std::vector<float> m_pointWeight;  // per point
    std::vector<Triangle> m_triangles; // those that hold points
    std::vector<Edge> m_edges;
    std::vector<float> m_ownWeight; // per unknown: of its vertices
    std::vector<float> m_diagonal;  // of the whole matrix
};

// The transfer of every mesh from what the samples saw: fitted where `samples` has points on the
// triangles, else that of the vertices themselves. Takes the values out of `state`. Errors:
// Cancelled.
Result<std::vector<VertexBake>> finishVertexTransfer(const BakeGeometry& geometry,
                                                     const VertexSamples& samples,
                                                     const PassSettings& settings, PassState& state,
                                                     const JobContext& job);

} // namespace patina
