#include "core/bake/transfer/VertexFit.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/mesh/Weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr float kHiddenWeight = 1e-3f;
constexpr float kLeastWeight = 1e-30f;
// Against the noise of single points, and for vertices that hardly any point tells about. Larger
// rounds off the edges of shadows.
constexpr double kSmoothness = 0.002;
constexpr int kMaxIterations = 60;
constexpr double kTolerance = 1e-5; // of the residual's norm; noise is three orders above

// A third corner farther along the edge than this many lengths of it tells nothing about how the
// gradient changes over it.
constexpr double kMaxFoot = 4.0;

// Positions as they are, normals to a 256th: equal for the sides of a UV seam, not for a crease.
std::vector<std::uint32_t> weldedVertices(const BakeGeometryMesh& mesh) {
    std::vector<float> rows;
    rows.reserve(6 * mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (int i = 0; i < 6; ++i)
            rows.push_back(i < 3 ? mesh.positions[v][i]
                                 : std::round(256.0f * mesh.normals[v][i - 3]));
    return firstEqualRow(rows, 6);
}

// Of the edges of all triangles, by the lower of their two unknowns: large meshes have millions,
// and sorting them as a whole took as long as solving the system.
class HalfEdges {
  public:
    struct HalfEdge {
        std::uint32_t high;             // the other unknown
        std::uint32_t triangle, corner; // `corner` is opposite
        friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
    };

    // `visit(add)` calls add(low, half edge) for each, in the same order each time.
    template <class Visit>
    HalfEdges(std::size_t unknowns, const Visit& visit)
        : m_ends(unknowns + 1, 0) {
        visit([this](std::uint32_t low, const HalfEdge&) { ++m_ends[low + 1]; });
        for (std::size_t v = 0; v < unknowns; ++v)
            m_ends[v + 1] += m_ends[v];
        m_all.resize(m_ends[unknowns]);
        std::vector<std::uint32_t> next(m_ends.begin(), m_ends.end() - 1);
        visit([&](std::uint32_t low, const HalfEdge& edge) { m_all[next[low]++] = edge; });
        for (std::size_t v = 0; v < unknowns; ++v)
            std::sort(m_all.begin() + m_ends[v], m_all.begin() + m_ends[v + 1]);
    }

    [[nodiscard]] std::size_t size() const { return m_all.size(); }
    // Sorted.
    [[nodiscard]] std::span<const HalfEdge> from(std::size_t low) const {
        return std::span(m_all).subspan(m_ends[low], m_ends[low + 1] - m_ends[low]);
    }

  private:
    std::vector<std::uint32_t> m_ends; // of what begins with each unknown, from the second on
    std::vector<HalfEdge> m_all;
};

double areaOf(const BakeGeometryMesh& mesh, std::size_t triangle) {
    const std::uint32_t* index = mesh.mesh->indices.data() + 3 * triangle;
    const glm::dvec3 a(mesh.positions[index[0]]), b(mesh.positions[index[1]]),
        c(mesh.positions[index[2]]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

} // namespace

VertexFit::VertexFit(const BakeGeometryMesh& mesh, std::span<const TrianglePoint> points,
                     std::span<const std::uint8_t> hidden, const JobContext& job)
    : m_mesh(mesh)
    , m_points(points)
    , m_unknownOf(weldedVertices(mesh))
    , m_vertexWeight(mesh.positions.size(), 0.0f)
    , m_pointWeight(points.size()) {
    const std::size_t vertices = mesh.positions.size();
    CHECK_EQ(hidden.size(), vertices + points.size());
    for (std::size_t v = 0; v < vertices;
         ++v) // the first of equal vertices comes before the others
        m_unknownOf[v] = m_unknownOf[v] == v ? static_cast<std::uint32_t>(m_unknowns++)
                                             : m_unknownOf[m_unknownOf[v]];

    // What each sample counts: a triangle's area in equal shares for its points and, because six
    // triangles meet at a vertex, a sixth of a share for each corner.
    const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
    m_triangles.reserve(std::min(mesh.mesh->triangleCount(), points.size()));
    std::size_t p = 0;
    for (std::uint32_t t = 0; t < mesh.mesh->triangleCount(); ++t) {
        if (t % 65536 == 0 && job.cancelled())
            return;
        const std::size_t begin = p;
        while (p < points.size() && points[p].triangle == t)
            ++p;
        const std::uint32_t* index = indices.data() + std::size_t{3} * t;
        const double area = areaOf(mesh, t);
        if (!(area > 0.0))
            continue;
        const double share = area / (0.5 + static_cast<double>(p - begin));
        for (std::size_t i = 0; i < 3; ++i)
            m_vertexWeight[index[i]] += static_cast<float>(share / 6.0);
        if (begin == p)
            continue;
        Triangle triangle{{m_unknownOf[index[0]], m_unknownOf[index[1]], m_unknownOf[index[2]]},
                          {}};
        for (std::size_t i = begin; i < p; ++i) {
            const float weight =
                static_cast<float>(share) * (hidden[vertices + i] != 0 ? kHiddenWeight : 1.0f);
            const float phi[3] = {1.0f - points[i].b1 - points[i].b2, points[i].b1, points[i].b2};
            m_pointWeight[i] = weight;
            for (int k = 0; k < 3; ++k) {
                triangle.moment[k] += weight * phi[k] * phi[k];
                triangle.moment[3 + k] += weight * phi[k] * phi[(k + 1) % 3];
            }
        }
        m_triangles.push_back(triangle);
    }
    CHECK_EQ(p, points.size());

    // Vertices that no triangle with an area uses keep what they saw.
    m_ownWeight.assign(m_unknowns, 0.0f);
    for (std::size_t v = 0; v < vertices; ++v) {
        float& weight = m_vertexWeight[v];
        weight = weight > 0.0f ? weight * (hidden[v] != 0 ? kHiddenWeight : 1.0f) : kLeastWeight;
        m_ownWeight[m_unknownOf[v]] += weight;
    }

    addEdges(job);
    if (job.cancelled())
        return;

    m_diagonal = m_ownWeight;
    for (const Triangle& t : m_triangles)
        for (int k = 0; k < 3; ++k)
            m_diagonal[t.corner[k]] += t.moment[k];
    for (const Edge& e : m_edges)
        for (int k = 0; k < 4; ++k)
            m_diagonal[e.corner[k]] += e.weight[k] * e.weight[k];
}

// The gradient's jump over the edge a b with third corners c and d at heights h1 and h2 is
// (c - its foot) / h1 + (d - its foot) / h2, here times the harmonic mean of the heights.
void VertexFit::addEdges(const JobContext& job) {
    const std::vector<std::uint32_t>& indices = m_mesh.mesh->indices;
    const HalfEdges halfEdges(m_unknowns, [&](const auto& add) {
        for (std::uint32_t t = 0; t < m_mesh.mesh->triangleCount(); ++t) {
            if (!(areaOf(m_mesh, t) > 0.0))
                continue;
            const std::uint32_t* index = indices.data() + std::size_t{3} * t;
            for (std::uint32_t i = 0; i < 3; ++i) {
                const std::uint32_t from = m_unknownOf[index[i]],
                                    to = m_unknownOf[index[(i + 1) % 3]];
                add(std::min(from, to), {std::max(from, to), t, (i + 2) % 3});
            }
        }
    });
    m_edges.reserve(halfEdges.size() / 2);
    for (std::uint32_t low = 0; low < m_unknowns; ++low) {
        if (low % 65536 == 0 && job.cancelled())
            return;
        const auto from = halfEdges.from(low);
        for (std::size_t i = 0, end = 0; i < from.size(); i = end) {
            for (end = i + 1; end < from.size() && from[end].high == from[i].high;)
                ++end;
            if (end - i != 2 || low == from[i].high)
                continue;
            double height[2], foot[2], area = 0.0;
            Edge edge{{low, from[i].high, 0, 0}, {}};
            for (std::size_t s = 0; s < 2; ++s) {
                const auto& side = from[i + s];
                const std::uint32_t* index = indices.data() + std::size_t{3} * side.triangle;
                std::uint32_t a = index[(side.corner + 1) % 3], b = index[(side.corner + 2) % 3];
                if (m_unknownOf[a] != low)
                    std::swap(a, b);
                const glm::dvec3 origin(m_mesh.positions[a]),
                    along = glm::dvec3(m_mesh.positions[b]) - origin,
                    third = glm::dvec3(m_mesh.positions[index[side.corner]]) - origin;
                const double length = glm::length(along),
                             twice = glm::length(glm::cross(along, third));
                height[s] = twice / length;
                foot[s] = glm::dot(third, along) / (length * length);
                area += 0.5 * twice;
                edge.corner[2 + s] = m_unknownOf[index[side.corner]];
            }
            if (!(std::max(std::abs(foot[0] - 0.5), std::abs(foot[1] - 0.5)) < kMaxFoot))
                continue; // NaN too
            const double scale = std::sqrt(kSmoothness * area / 3.0);
            for (std::size_t s = 0; s < 2; ++s) {
                const double w = scale * 2.0 * height[1 - s] / (height[0] + height[1]);
                edge.weight[2 + s] = static_cast<float>(w);
                edge.weight[0] -= static_cast<float>(w * (1.0 - foot[s]));
                edge.weight[1] -= static_cast<float>(w * foot[s]);
            }
            m_edges.push_back(edge);
        }
    }
}

// y = matrix x, `kColumns` right-hand sides side by side.
template <int kColumns>
void VertexFit::apply(std::span<const float> x, std::span<float> y) const {
    for (std::size_t v = 0; v < m_unknowns; ++v)
        for (int c = 0; c < kColumns; ++c)
            y[v * kColumns + c] = m_ownWeight[v] * x[v * kColumns + c];
    for (const Triangle& t : m_triangles) {
        const float* in[3];
        float* out[3];
        for (int k = 0; k < 3; ++k) {
            in[k] = x.data() + std::size_t{t.corner[k]} * kColumns;
            out[k] = y.data() + std::size_t{t.corner[k]} * kColumns;
        }
        for (int c = 0; c < kColumns; ++c) {
            const float a = in[0][c], b = in[1][c], d = in[2][c];
            out[0][c] += t.moment[0] * a + t.moment[3] * b + t.moment[5] * d;
            out[1][c] += t.moment[3] * a + t.moment[1] * b + t.moment[4] * d;
            out[2][c] += t.moment[5] * a + t.moment[4] * b + t.moment[2] * d;
        }
    }
    for (const Edge& e : m_edges) {
        std::array<float, kColumns> jump{};
        for (int k = 0; k < 4; ++k)
            for (int c = 0; c < kColumns; ++c)
                jump[c] += e.weight[k] * x[std::size_t{e.corner[k]} * kColumns + c];
        for (int k = 0; k < 4; ++k)
            for (int c = 0; c < kColumns; ++c)
                y[std::size_t{e.corner[k]} * kColumns + c] += e.weight[k] * jump[c];
    }
}

// Conjugate gradients with the diagonal as preconditioner, from the values at the vertices.
template <int kColumns>
void VertexFit::solveColumns(std::size_t first, std::size_t count, std::size_t stride,
                             std::span<const float> values, std::span<float> result,
                             const JobContext& job) const {
    const std::size_t vertices = m_unknownOf.size(), size = m_unknowns * kColumns;
    using Numbers = std::array<double, kColumns>;
    const auto dot = [&](const std::vector<float>& a, const std::vector<float>& b) {
        Numbers sum{};
        for (std::size_t v = 0; v < m_unknowns; ++v)
            for (int c = 0; c < kColumns; ++c)
                sum[c] += double{a[v * kColumns + c]} * double{b[v * kColumns + c]};
        return sum;
    };

    // The right-hand side in r, the mean of each unknown's vertices in x.
    std::vector<float> x(size, 0.0f), r(size, 0.0f), z(size), p(size), q(size);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t c = 0; c < count; ++c) {
            const float weighted = m_vertexWeight[v] * values[v * stride + first + c];
            r[m_unknownOf[v] * kColumns + c] += weighted;
        }
    for (std::size_t v = 0; v < m_unknowns; ++v)
        for (int c = 0; c < kColumns; ++c)
            x[v * kColumns + c] = r[v * kColumns + c] / m_ownWeight[v];
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        const TrianglePoint& at = m_points[i];
        const float phi[3] = {1.0f - at.b1 - at.b2, at.b1, at.b2};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t row =
                m_unknownOf[m_mesh.mesh->indices[std::size_t{3} * at.triangle + k]];
            const float weight = m_pointWeight[i] * phi[k];
            for (std::size_t c = 0; c < count; ++c)
                r[row * kColumns + c] += weight * values[(vertices + i) * stride + first + c];
        }
    }

    const auto precondition = [&] {
        for (std::size_t v = 0; v < m_unknowns; ++v)
            for (int c = 0; c < kColumns; ++c)
                z[v * kColumns + c] = r[v * kColumns + c] / m_diagonal[v];
    };
    precondition();
    const Numbers norm = dot(r, z);
    apply<kColumns>(x, q);
    for (std::size_t i = 0; i < size; ++i)
        r[i] -= q[i];
    precondition();
    p = z;
    Numbers rho = dot(r, z);
    for (int iteration = 0; iteration < kMaxIterations && !job.cancelled(); ++iteration) {
        bool converged = true;
        for (int c = 0; c < kColumns; ++c)
            converged &= rho[c] <= kTolerance * kTolerance * norm[c];
        if (converged)
            break;
        apply<kColumns>(p, q);
        const Numbers curvature = dot(p, q);
        std::array<float, kColumns> alpha, beta;
        for (int c = 0; c < kColumns; ++c)
            alpha[c] = curvature[c] > 0.0 ? static_cast<float>(rho[c] / curvature[c]) : 0.0f;
        for (std::size_t v = 0; v < m_unknowns; ++v)
            for (int c = 0; c < kColumns; ++c) {
                x[v * kColumns + c] += alpha[c] * p[v * kColumns + c];
                r[v * kColumns + c] -= alpha[c] * q[v * kColumns + c];
            }
        precondition();
        const Numbers next = dot(r, z);
        for (int c = 0; c < kColumns; ++c) {
            beta[c] = rho[c] > 0.0 ? static_cast<float>(next[c] / rho[c]) : 0.0f;
            rho[c] = next[c];
        }
        for (std::size_t v = 0; v < m_unknowns; ++v)
            for (int c = 0; c < kColumns; ++c)
                p[v * kColumns + c] = z[v * kColumns + c] + beta[c] * p[v * kColumns + c];
    }
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t c = 0; c < count; ++c)
            result[v * stride + first + c] = x[m_unknownOf[v] * kColumns + c];
}

std::vector<float> VertexFit::solve(int stride, std::span<const float> values,
                                    const JobContext& job) const {
    constexpr std::size_t kColumns = 8;
    const auto columns = static_cast<std::size_t>(stride);
    CHECK_EQ(values.size(), (m_unknownOf.size() + m_points.size()) * columns);
    std::vector<float> result(m_unknownOf.size() * columns);
    parallelFor(job, (columns + kColumns - 1) / kColumns, 1,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t block = begin; block < end; ++block) {
                        const std::size_t first = block * kColumns;
                        const std::size_t count = std::min(kColumns, columns - first);
                        if (count == 1) // often: 9 and 25 coefficients, and the sky's share
                            solveColumns<1>(first, count, columns, values, result, job);
                        else
                            solveColumns<kColumns>(first, count, columns, values, result, job);
                    }
                });
    return result;
}

std::vector<float> VertexFit::residual(int stride, std::span<const float> values,
                                       std::span<const float> fitted) const {
    const auto columns = static_cast<std::size_t>(stride);
    const std::size_t vertices = m_unknownOf.size();
    std::vector<double> squares(m_unknowns, 0.0), weights(m_unknowns, 0.0);
    const auto add = [&](std::size_t unknown, double weight, double square) {
        squares[unknown] += weight * square / static_cast<double>(columns);
        weights[unknown] += weight;
    };
    for (std::size_t v = 0; v < vertices; ++v) {
        double square = 0.0;
        for (std::size_t c = 0; c < columns; ++c) {
            const double d = double{values[v * columns + c]} - double{fitted[v * columns + c]};
            square += d * d;
        }
        add(m_unknownOf[v], m_vertexWeight[v], square);
    }
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        const TrianglePoint& at = m_points[i];
        const std::uint32_t* index = m_mesh.mesh->indices.data() + std::size_t{3} * at.triangle;
        const float phi[3] = {1.0f - at.b1 - at.b2, at.b1, at.b2};
        double square = 0.0;
        for (std::size_t c = 0; c < columns; ++c) {
            double d = values[(vertices + i) * columns + c];
            for (std::size_t k = 0; k < 3; ++k)
                d -= double{phi[k]} * double{fitted[index[k] * columns + c]};
            square += d * d;
        }
        for (std::size_t k = 0; k < 3; ++k)
            add(m_unknownOf[index[k]], double{m_pointWeight[i]} * double{phi[k]}, square);
    }
    std::vector<float> result(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const std::uint32_t unknown = m_unknownOf[v];
        result[v] = static_cast<float>(std::sqrt(squares[unknown] / weights[unknown]));
    }
    return result;
}

} // namespace patina
