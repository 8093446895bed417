// Fits linearly transformed cosines to the GGX lobe with height-correlated Smith masking and writes
// the table that area lights are shaded with (core/light/LobeTable.inc). After Heitz, Dupuy, Hill &
// Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", section 3.3
// and appendix; written anew: the lobe is integrated on fixed nodes of two strategies instead of
// random ones, so that the same program gives the same table.
#include "core/base/AtomicFile.h"
#include "core/job/Parallel.h"
#include "core/light/LobeTable.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <numbers>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace patina {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr int kNodes = 24; // of each strategy, along both axes of the unit square
constexpr int kSteps = 400;

// --- The lobe: f cos / albedo, without Fresnel ---

struct Lobe {
    dvec3 v;
    double alpha;

    // f cos at l.
    [[nodiscard]] double operator()(const dvec3& l) const {
        if (l.z <= 0.0)
            return 0.0;
        const dvec3 h = glm::normalize(v + l);
        const double a2 = alpha * alpha, sin2 = h.x * h.x + h.y * h.y;
        const double b = alpha / (sin2 + a2 * h.z * h.z);
        const double D = b * b / std::numbers::pi;
        const double lambdaV = l.z * std::sqrt(v.z * v.z * (1.0 - a2) + a2);
        const double lambdaL = v.z * std::sqrt(l.z * l.z * (1.0 - a2) + a2);
        return 0.5 * D / (lambdaV + lambdaL) * l.z;
    }
    // Reflection at a visible normal, and its density (see shaders/shared/sampling.glsl).
    [[nodiscard]] dvec3 sample(double u, double w) const {
        const dvec3 stretched = glm::normalize(dvec3(v.x * alpha, 0.0, v.z));
        const double phi = 2.0 * std::numbers::pi * u,
                     z = (1.0 - w) * (1.0 + stretched.z) - stretched.z;
        const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
        const dvec3 m = dvec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
        const dvec3 h = glm::normalize(dvec3(m.x * alpha, m.y * alpha, m.z));
        return 2.0 * glm::dot(v, h) * h - v;
    }
    [[nodiscard]] double density(const dvec3& l) const {
        const dvec3 h = glm::normalize(v + l);
        if (h.z <= 0.0)
            return 0.0;
        const double a2 = alpha * alpha, sin2 = h.x * h.x + h.y * h.y;
        const double b = alpha / (sin2 + a2 * h.z * h.z);
        return b * b / std::numbers::pi / (2.0 * (v.z + std::sqrt(v.z * v.z * (1.0 - a2) + a2)));
    }
};

// --- The transformed cosine ---

// Widths and shear in a frame whose z leans by `angle` from the normal towards the mirror
// direction. The paper keeps z on the lobe's mean direction; left free, all that a matrix of this
// symmetry can do is used, which halves the error at grazing views.
struct Shape {
    double m11 = 1.0, m22 = 1.0, m13 = 0.0, angle = 0.0;
};

struct Cosine {
    dmat3 m, inverse;
    double determinant;

    explicit Cosine(const Shape& shape) {
        const double c = std::cos(shape.angle), s = std::sin(shape.angle);
        const dmat3 frame(dvec3(c, 0, s), dvec3(0, 1, 0), dvec3(-s, 0, c));
        m = frame * dmat3(dvec3(shape.m11, 0, 0), dvec3(0, shape.m22, 0), dvec3(shape.m13, 0, 1));
        inverse = glm::inverse(m);
        determinant = std::abs(glm::determinant(m));
    }
    // Density over directions, 1 in total; over the whole sphere (below the horizon, too).
    [[nodiscard]] double operator()(const dvec3& l) const {
        const dvec3 original = inverse * l;
        const double length = glm::length(original);
        return std::max(original.z, 0.0) / (std::numbers::pi * length) /
               (length * length * length * determinant);
    }
    [[nodiscard]] dvec3 sample(double u, double w) const {
        const double phi = 2.0 * std::numbers::pi * u, r = std::sqrt(w);
        return glm::normalize(
            m * dvec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(1.0 - w, 0.0))));
    }
};

double node(int i) {
    return (i + 0.5) / kNodes;
}

double albedo(const Lobe& lobe) {
    constexpr int kFine = 4 * kNodes;
    double sum = 0.0;
    for (int i = 0; i < kFine; ++i)
        for (int k = 0; k < kFine; ++k) {
            const dvec3 l = lobe.sample((i + 0.5) / kFine, (k + 0.5) / kFine);
            const double density = lobe.density(l);
            if (density > 0.0)
                sum += lobe(l) / density;
        }
    return sum / (kFine * kFine);
}

// The integral of |lobe - cosine|: half of it is the largest error that any light can see. Over
// nodes of both lobes with the balance heuristic (Veach & Guibas 1995).
double error(const Lobe& lobe, double lobeAlbedo, const Shape& shape) {
    const Cosine cosine(shape);
    double sum = 0.0;
    const auto add = [&](const dvec3& l) {
        const double pl = lobe.density(l), pc = cosine(l);
        if (pl + pc > 0.0)
            sum += std::abs(lobe(l) / lobeAlbedo - pc) / (pl + pc);
    };
    for (int i = 0; i < kNodes; ++i)
        for (int k = 0; k < kNodes; ++k) {
            add(lobe.sample(node(i), node(k)));
            add(cosine.sample(node(i), node(k)));
        }
    return sum / (kNodes * kNodes);
}

// --- Nelder & Mead 1965, "A Simplex Method for Function Minimization" ---

template <int N, class F>
std::array<double, N> minimize(const F& f, const std::array<double, N>& start, double size) {
    using Point = std::array<double, N>;
    std::array<std::pair<double, Point>, N + 1> simplex;
    for (int i = 0; i <= N; ++i) {
        Point p = start;
        if (i > 0)
            p[static_cast<std::size_t>(i - 1)] += size;
        simplex[static_cast<std::size_t>(i)] = {f(p), p};
    }
    const auto along = [](const Point& from, const Point& to, double t) {
        Point p;
        for (std::size_t i = 0; i < N; ++i)
            p[i] = from[i] + t * (to[i] - from[i]);
        return p;
    };
    for (int step = 0; step < kSteps; ++step) {
        std::sort(simplex.begin(), simplex.end());
        auto& worst = simplex[N];
        if (worst.first - simplex[0].first <= 1e-9 * std::abs(simplex[0].first))
            break;
        Point center{};
        for (std::size_t k = 0; k < N; ++k)
            for (std::size_t i = 0; i < N; ++i)
                center[i] += simplex[k].second[i] / N;
        const Point reflected = along(center, worst.second, -1.0);
        const double fr = f(reflected);
        if (fr < simplex[0].first) {
            const Point further = along(center, worst.second, -2.0);
            const double ff = f(further);
            worst = ff < fr ? std::pair(ff, further) : std::pair(fr, reflected);
        } else if (fr < simplex[N - 1].first) {
            worst = {fr, reflected};
        } else {
            const Point nearer = along(center, worst.second, fr < worst.first ? -0.5 : 0.5);
            const double fn = f(nearer);
            if (fn < std::min(fr, worst.first)) {
                worst = {fn, nearer};
            } else {
                for (std::size_t k = 1; k <= N; ++k) {
                    simplex[k].second = along(simplex[0].second, simplex[k].second, 0.5);
                    simplex[k].first = f(simplex[k].second);
                }
            }
        }
    }
    return std::min_element(simplex.begin(), simplex.end())->second;
}

// Logarithms keep the widths positive and one step of the same size for wide and narrow lobes. The
// shear is in units of m11.
Shape shapeOf(const std::array<double, 4>& p) {
    return {std::exp(p[0]), std::exp(p[1]), std::exp(p[0]) * p[2], p[3]};
}

// One row of the table: the angles of one roughness, from N·V = 1 on, each starting from the one
// before.
std::vector<glm::vec4> fitRow(double perceptualRoughness) {
    // Analytic lights have this smallest roughness (shaders/shared/constants.glsl).
    const double r =
        std::max(perceptualRoughness, static_cast<double>(shading::kMinPerceptualRoughness));
    const double alpha = r * r;
    std::vector<glm::vec4> row;
    std::array<double, 4> p{std::log(alpha), std::log(alpha), 0.0, 0.0};
    for (int i = 0; i < kLobeTableSize; ++i) {
        const double angle = static_cast<double>(i) / (kLobeTableSize - 1); // sqrt(1 - N·V)
        const double NoV = std::max(1.0 - angle * angle, 1e-3); // at 0 the lobe has no limit
        const Lobe lobe{dvec3(std::sqrt(1.0 - NoV * NoV), 0.0, NoV), alpha};
        const double of = albedo(lobe);
        if (i == 0) { // round: two widths that are one
            const auto best = minimize<1>(
                [&](const std::array<double, 1>& q) {
                    return error(lobe, of, shapeOf({q[0], q[0], 0.0, 0.0}));
                },
                {p[0]}, 0.05);
            p = {best[0], best[0], 0.0, 0.0};
        } else {
            // A fresh simplex leaves a place where the one before got stuck.
            for (const double size : {0.1, 0.05, 0.02})
                p = minimize<4>(
                    [&](const std::array<double, 4>& q) { return error(lobe, of, shapeOf(q)); }, p,
                    size);
        }
        const dmat3 inverse = Cosine(shapeOf(p)).inverse;
        const dmat3 m = inverse / inverse[1][1];
        row.emplace_back(m[0][0], m[2][0], m[0][2], m[2][2]);
    }
    return row;
}

int run(const char* file) {
    std::vector<std::vector<glm::vec4>> rows(kLobeTableSize);
    parallelFor(JobContext(), kLobeTableSize, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            rows[i] = fitRow(static_cast<double>(i) / (kLobeTableSize - 1));
            std::fputc('.', stderr);
        }
    });
    std::string text =
        "// Made by tools/FitLobes.cpp: ninja fit-lobes. Rows: perceptualRoughness 0…1; "
        "columns: sqrt(1 - N·V) 0…1.\n// clang-format off\n";
    for (const auto& row : rows)
        for (const glm::vec4& fit : row)
            text += fmt::format("{:.7f},{:.7f},{:.7f},{:.7f},\n", fit.x, fit.y, fit.z, fit.w);
    std::fputc('\n', stderr);
    const auto written = writeFileAtomically(file, text);
    if (!written) {
        std::fprintf(stderr, "%s\n", written.error().text().c_str());
        return 1;
    }
    return 0;
}

} // namespace
} // namespace patina

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: patina-fit-lobes FILE\n");
        return 2;
    }
    return patina::run(argv[1]);
}
