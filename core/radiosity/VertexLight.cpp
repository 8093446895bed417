#include "core/radiosity/Reconstruction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace patina::radiosity {
namespace {

// How much a bend of the light over an edge counts, beside one element's mean. Kills the patterns
// that no mean sees; light that changes evenly is left as it is, up to the rim.
constexpr double kSmooth = 0.02;
// Two ends of an edge to one another: so little that it decides only where nothing else does.
constexpr double kTie = 1e-7;

// Rows of a sparse matrix.
struct Rows {
    std::vector<std::size_t> first{0};
    std::vector<std::pair<std::uint32_t, double>> entries;
    std::vector<double> weights; // of each row's square

    void add(std::span<const std::pair<std::uint32_t, double>> row, double weight) {
        entries.insert(entries.end(), row.begin(), row.end());
        first.push_back(entries.size());
        weights.push_back(weight);
    }
    [[nodiscard]] std::span<const std::pair<std::uint32_t, double>> row(std::size_t i) const {
        return {entries.data() + first[i], first[i + 1] - first[i]};
    }
};

using Values = std::vector<glm::dvec3>;

// Rᵀ W R x.
void apply(const Rows& rows, const Values& x, Values& result) {
    std::fill(result.begin(), result.end(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < rows.weights.size(); ++i) {
        glm::dvec3 sum(0.0);
        for (const auto& [v, c] : rows.row(i))
            sum += c * x[v];
        sum *= rows.weights[i];
        for (const auto& [v, c] : rows.row(i))
            result[v] += c * sum;
    }
}

glm::dvec3 dot(const Values& a, const Values& b) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

// An edge between two lights, and the triangles on its two sides.
struct Crossing {
    int triangles = 0;
    std::array<const LitMesh::Triangle*, 2> sides{};
};
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, Crossing>;

// Light about an edge as a row that is 0 where the light on one side is the other's, continued:
// values at the corner opposite of the edge, less what the edge has at its foot, over the distance.
// False: too flat a triangle.
bool addBend(const LitMesh& mesh, std::pair<std::uint32_t, std::uint32_t> ends,
             const Crossing& edge, std::vector<std::pair<std::uint32_t, double>>& row) {
    row.assign({{ends.first, 0.0}, {ends.second, 0.0}});
    double heights = 0.0;
    for (const LitMesh::Triangle* triangle : edge.sides) {
        std::array<glm::dvec3, 3> p{}; // first end, second end, the corner opposite
        std::uint32_t opposite = 0;
        for (const std::uint32_t v : triangle->vertices) {
            const LitMesh::Vertex& vertex = mesh.vertices[v];
            const std::size_t place =
                vertex.light == ends.first ? 0 : (vertex.light == ends.second ? 1 : 2);
            p[place] = vertex.position;
            if (place == 2)
                opposite = vertex.light;
        }
        const glm::dvec3 along = p[1] - p[0], to = p[2] - p[0];
        const double length2 = glm::dot(along, along);
        const double foot = length2 > 0.0 ? glm::dot(to, along) / length2 : 0.0;
        const double height = glm::length(to - foot * along);
        if (!(height > 1e-4 * std::sqrt(length2)))
            return false;
        row.emplace_back(opposite, 1.0 / height);
        row[0].second -= (1.0 - foot) / height;
        row[1].second -= foot / height;
        heights += 0.5 * height;
    }
    for (auto& entry : row)
        entry.second *= heights;
    return true;
}

// What the vertices should fulfil. The first rows are the elements' means.
Rows rowsOf(const LitMesh& mesh, const ElementMesh& elementMesh) {
    const std::size_t elements = elementMesh.size();
    std::vector<std::vector<std::pair<std::uint32_t, double>>> means(elements);
    std::vector<double> areas(elements, 0.0);
    Edges edges;
    double total = 0.0;
    for (const LitMesh::Triangle& triangle : mesh.triangles) {
        const double area = mesh.area(triangle);
        areas[triangle.element] += area;
        total += area;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.vertices[triangle.vertices[k]].light,
                                b = mesh.vertices[triangle.vertices[(k + 1) % 3]].light;
            means[triangle.element].emplace_back(a, area / 3.0);
            if (a == b)
                continue; // a triangle of no area
            Crossing& edge = edges[{std::min(a, b), std::max(a, b)}];
            if (edge.triangles < 2)
                edge.sides[static_cast<std::size_t>(edge.triangles)] = &triangle;
            ++edge.triangles;
        }
    }
    Rows rows;
    const double mean = elements > 0 && total > 0.0 ? total / static_cast<double>(elements) : 1.0;
    for (std::size_t e = 0; e < elements; ++e) {
        for (auto& entry : means[e])
            entry.second /= areas[e] > 0.0 ? areas[e] : 1.0;
        const double exposed = elementMesh.exposed(static_cast<std::uint32_t>(e));
        rows.add(means[e], areas[e] / mean * exposed * exposed);
    }
    std::vector<std::pair<std::uint32_t, double>> row;
    for (const auto& [ends, edge] : edges) {
        const std::array<std::pair<std::uint32_t, double>, 2> tie{
            {{ends.first, 1.0}, {ends.second, -1.0}}};
        rows.add(tie, kTie);
        if (edge.triangles == 2 && addBend(mesh, ends, edge, row))
            rows.add(row, kSmooth);
    }
    return rows;
}

} // namespace

std::vector<glm::dvec3> vertexLight(const LitMesh& mesh, const ElementMesh& elementMesh,
                                    std::span<const glm::dvec3> elements) {
    const Rows rows = rowsOf(mesh, elementMesh);
    const std::size_t n = mesh.lights;
    // To start with: the mean of the elements about each vertex.
    Values x(n, glm::dvec3(0.0)), right(n, glm::dvec3(0.0)), product(n);
    std::vector<double> counts(n, 0.0), diagonal(n, 0.0);
    for (std::size_t e = 0; e < elements.size(); ++e)
        for (const auto& [v, c] : rows.row(e)) {
            x[v] += c * rows.weights[e] * elements[e];
            counts[v] += c * rows.weights[e];
            right[v] += c * rows.weights[e] * elements[e];
        }
    for (std::size_t v = 0; v < n; ++v)
        if (counts[v] > 0.0)
            x[v] /= counts[v];
    for (std::size_t i = 0; i < rows.weights.size(); ++i)
        for (const auto& [v, c] : rows.row(i))
            diagonal[v] += c * c * rows.weights[i];
    // Conjugate gradients, each colour with its own steps (Hestenes & Stiefel 1952), preconditioned
    // by the diagonal.
    Values residual(n), search(n), scaled(n);
    apply(rows, x, product);
    for (std::size_t v = 0; v < n; ++v)
        residual[v] = right[v] - product[v];
    const auto precondition = [&] {
        for (std::size_t v = 0; v < n; ++v)
            scaled[v] = residual[v] / (diagonal[v] > 0.0 ? diagonal[v] : 1.0);
    };
    precondition();
    search = scaled;
    glm::dvec3 product2 = dot(residual, scaled);
    const glm::dvec3 enough = 1e-14 * glm::max(dot(right, right), glm::dvec3(1e-300));
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 left = dot(residual, residual);
        if (left.x <= enough.x && left.y <= enough.y && left.z <= enough.z)
            break;
        apply(rows, search, product);
        const glm::dvec3 curvature = dot(search, product);
        glm::dvec3 step(0.0);
        for (int c = 0; c < 3; ++c)
            step[c] = curvature[c] > 0.0 && left[c] > enough[c] ? product2[c] / curvature[c] : 0.0;
        for (std::size_t v = 0; v < n; ++v) {
            x[v] += step * search[v];
            residual[v] -= step * product[v];
        }
        precondition();
        const glm::dvec3 next = dot(residual, scaled);
        glm::dvec3 beta(0.0);
        for (int c = 0; c < 3; ++c)
            beta[c] = product2[c] > 0.0 ? next[c] / product2[c] : 0.0;
        product2 = next;
        for (std::size_t v = 0; v < n; ++v)
            search[v] = scaled[v] + beta * search[v];
    }
    const bool negative = std::any_of(elements.begin(), elements.end(), [](const glm::dvec3& e) {
        return e.x < 0.0 || e.y < 0.0 || e.z < 0.0;
    });
    if (!negative)
        for (glm::dvec3& value : x)
            value = glm::max(value, glm::dvec3(0.0));
    return x;
}

} // namespace patina::radiosity
