// The paraboloid map: its texels, what is drawn onto it, and the form factors that come of it.
#include "core/radiosity/HemicubeFactors.h"
#include "core/radiosity/ParaboloidFactors.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

// Texels along the diameter, and the form factor through the largest of them, in the middle.
constexpr int kTexels = 512;
constexpr double kLargestDelta = 16.0 / (std::numbers::pi * kTexels * kTexels);
constexpr int kCells = 256; // of a hemicube; its largest cell counts as much

// 4 (1 - r²) / (π (1 + r²)³): the form factor through dA of the map.
double density(double x, double y) {
    const double r2 = x * x + y * y;
    return r2 < 1.0 ? 4.0 * (1.0 - r2) / (std::numbers::pi * std::pow(1.0 + r2, 3.0)) : 0.0;
}

TEST(ParaboloidMap, TexelsAreIntegratedExactlyAndSumUpToOne) {
    for (const int resolution : {2, 3, 16, 129, kTexels}) {
        const ParaboloidMap map(resolution);
        ASSERT_EQ(map.weights().size(), static_cast<std::size_t>(resolution) * resolution);
        double sum = 0.0;
        for (int row = 0; row < resolution; ++row)
            for (int column = 0; column < resolution; ++column) {
                const double weight =
                    map.weights()[static_cast<std::size_t>(row * resolution + column)];
                sum += weight;
                const bool inRun = column >= map.run(row).first && column < map.run(row).end;
                EXPECT_EQ(weight > 0.0, inRun) << column << " " << row << " of " << resolution;
                EXPECT_EQ(inRun, std::hypot(map.centre(column), map.centre(row)) < 1.0);
            }
        EXPECT_NEAR(sum, 1.0, 1e-12) << resolution;
    }
    // Against sums of the density: on the disc, and at its rim, which is where it is 0.
    struct Part {
        double x0, x1, y0, y1;
    };
    for (const Part& part : {Part{-0.1, 0.3, 0.2, 0.4}, Part{0.5, 0.8, -0.9, -0.4},
                             Part{-1.0, -0.7, 0.1, 1.0}, Part{-1.0, 1.0, -1.0, 0.25}}) {
        constexpr int kPoints = 1000;
        double sum = 0.0;
        for (int i = 0; i < kPoints; ++i)
            for (int k = 0; k < kPoints; ++k)
                sum += density(part.x0 + (i + 0.5) / kPoints * (part.x1 - part.x0),
                               part.y0 + (k + 0.5) / kPoints * (part.y1 - part.y0));
        sum *= (part.x1 - part.x0) * (part.y1 - part.y0) / (kPoints * kPoints);
        EXPECT_NEAR(ParaboloidMap::factor(part.x0, part.x1, part.y0, part.y1), sum, 2e-6);
    }
    EXPECT_NEAR(ParaboloidMap::factor(0.0, 1.0, 0.0, 1.0), 0.25, 1e-15);
    EXPECT_NEAR(ParaboloidMap::factor(0.8, 0.9, 0.8, 0.9), 0.0, 1e-15) << "off the disc";
    EXPECT_NEAR(ParaboloidMap::factor(-1.0 / kTexels, 1.0 / kTexels, -1.0 / kTexels, 1.0 / kTexels),
                kLargestDelta, 1e-4 * kLargestDelta);
}

TEST(ParaboloidMap, ADirectionIsWhereItIsProjectedTo) {
    for (const glm::dvec3& direction : {glm::dvec3(0, 0, 1), glm::dvec3(0.3, -0.2, 0.5),
                                        glm::dvec3(-4, 3, 0), glm::dvec3(2, 1, 0.01)}) {
        const glm::dvec2 at = ParaboloidMap::project(direction);
        EXPECT_LE(glm::length(at), 1.0 + 1e-12);
        EXPECT_NEAR(glm::length(glm::cross(glm::normalize(ParaboloidMap::direction(at)),
                                           glm::normalize(direction))),
                    0.0, 1e-12);
    }
}

// Whether a direction meets the quad, by the planes of its edges.
bool meets(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& direction, bool front) {
    for (std::size_t k = 0; k < 4; ++k)
        if ((glm::dot(glm::cross(corners[k], corners[(k + 1) % 4]), direction) < 0.0) != front)
            return false;
    return true;
}

// Flat quads in all places, near and far, above, below and across the horizon: each texel whose
// direction meets one is covered, once, and no other.
TEST(ParaboloidFill, CoversTheTexelsThatSeeAQuad) {
    const int resolution = 96;
    const ParaboloidMap map(resolution);
    ParaboloidFill fill(map);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    int covered = 0, clipped = 0;
    for (int round = 0; round < 400; ++round) {
        const glm::dvec3 middle(even(random), even(random), even(random));
        const glm::dvec3 x = glm::dvec3(even(random), even(random), even(random)),
                         y = glm::dvec3(even(random), even(random), even(random));
        const std::array<glm::dvec3, 4> corners{middle - x - y, middle + x - 0.8 * y,
                                                middle + 0.7 * x + y, middle - x + y};
        const glm::dvec3 normal = glm::cross(x, y);
        const bool front = glm::dot(normal, middle) < 0.0;
        for (const glm::dvec3& corner : corners)
            clipped += corner.z < 0.0 ? 1 : 0;
        std::vector<int> count(map.weights().size(), 0);
        for (const ParaboloidFill::Span& span : fill.cover(corners, front))
            for (int column = span.first; column < span.end; ++column)
                ++count[static_cast<std::size_t>(span.row * resolution + column)];
        for (int row = 0; row < resolution; ++row)
            for (int column = map.run(row).first; column < map.run(row).end; ++column) {
                const glm::dvec3 direction =
                    ParaboloidMap::direction({map.centre(column), map.centre(row)});
                const int is = count[static_cast<std::size_t>(row * resolution + column)];
                ASSERT_EQ(is, meets(corners, direction, front) ? 1 : 0)
                    << column << " " << row << " of round " << round;
                covered += is;
            }
    }
    EXPECT_GT(covered, 100000);
    EXPECT_GT(clipped, 400);
}

// A wall beside the point, from the floor to far above and from far left to far right: its upper
// edge runs across the map. Between its ends it is a sixth of the map away from the straight line,
// which is what an edge that is not divided would be.
TEST(ParaboloidFill, AnEdgeAcrossTheMapBends) {
    const ParaboloidMap map(kTexels);
    ParaboloidFill fill(map);
    const double side = 20.0, height = 1.0, away = 1.0;
    const std::array<glm::dvec3, 4> corners{glm::dvec3(-side, away, -1), glm::dvec3(side, away, -1),
                                            glm::dvec3(side, away, height),
                                            glm::dvec3(-side, away, height)};
    const double middle = ParaboloidMap::project({0.0, away, height}).y;
    const glm::dvec2 end = ParaboloidMap::project({side, away, height});
    ASSERT_GT(middle - end.y, 0.3) << "texels would be 80 off";
    int lowest = kTexels, highest = 0;
    for (const ParaboloidFill::Span& span :
         fill.cover(corners, glm::cross(corners[1] - corners[0], corners[2] - corners[0]).y < 0.0))
        if (span.first <= kTexels / 2 && span.end > kTexels / 2) {
            lowest = std::min(lowest, span.row);
            highest = std::max(highest, span.row);
        }
    // The wall lies between its upper edge and the horizon.
    EXPECT_EQ(lowest, map.firstFrom(middle));
    EXPECT_EQ(highest, kTexels - 1);
    EXPECT_GT(std::abs(lowest - map.firstFrom(end.y)), 75);
}

// Seams that two faces share, and corners of one within an edge of another: the faces of a box
// about the point, each divided otherwise, cover each texel once.
TEST(ParaboloidFill, FacesThatShareEdgesCoverEachTexelOnce) {
    const ParaboloidMap map(kTexels);
    ParaboloidFill fill(map);
    const glm::dvec3 low(-0.731, -1.127, -0.6), high(0.911, 1.377, 0.83);
    std::vector<int> count(map.weights().size(), 0);
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        glm::dvec3 from = low, x(0.0), y(0.0);
        x[(axis + 1) % 3] = (high - low)[(axis + 1) % 3];
        y[(axis + 2) % 3] = (high - low)[(axis + 2) % 3];
        if (face % 2 == 1)
            from[axis] = high[axis];
        else
            std::swap(x, y); // fronts look inside
        std::swap(x, y);
        const int columns = 3 + 2 * face, rows = 11 - face;
        const auto at = [&](int column, int row) {
            return from + static_cast<double>(column) / columns * x +
                   static_cast<double>(row) / rows * y;
        };
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const std::array<glm::dvec3, 4> corners{at(column, row), at(column + 1, row),
                                                        at(column + 1, row + 1),
                                                        at(column, row + 1)};
                ASSERT_LT(glm::dot(glm::cross(x, y), corners[0]), 0.0);
                for (const ParaboloidFill::Span& span : fill.cover(corners, true))
                    for (int i = span.first; i < span.end; ++i)
                        ++count[static_cast<std::size_t>(span.row * kTexels + i)];
            }
    }
    for (std::size_t texel = 0; texel < count.size(); ++texel)
        ASSERT_EQ(count[texel], map.weights()[texel] > 0.0 ? 1 : 0) << texel;
}

// --- Known values: ground_truth.json, formfactor.*
// ------------------------------------------------

// Two-sided, so that it does not matter which way a polygon was written down.
Wall target(const std::array<glm::vec3, 4>& corners) {
    Wall wall{corners};
    wall.twoSided = true;
    return wall;
}

// A square of 2 mm about the origin that looks along z.
Wall smallSquare() {
    constexpr float kHalf = 1e-3f;
    return {{{{-kHalf, -kHalf, 0}, {kHalf, -kHalf, 0}, {kHalf, kHalf, 0}, {-kHalf, kHalf, 0}}}};
}

// A disc about a point, across z, as a polygon of the same area.
std::vector<Wall> disc(const glm::vec3& middle, float radius) {
    constexpr int kCorners = 96;
    constexpr double kStep = 2.0 * std::numbers::pi / kCorners;
    const double polygon = radius * std::sqrt(kStep / std::sin(kStep));
    std::vector<Wall> walls;
    const auto at = [&](int k) {
        return middle + glm::vec3(polygon * std::cos(k * kStep), polygon * std::sin(k * kStep), 0);
    };
    for (int k = 0; k < kCorners; ++k)
        walls.push_back(target({middle, at(k), at(k + 1), at(k + 1)}));
    return walls;
}

std::vector<Wall> with(const Wall& first, std::vector<Wall> others) {
    others.insert(others.begin(), first);
    return others;
}

// Mean factor of the front of mesh 0, weighted by area, to all other meshes.
double factorOfFirst(const TraceInputs& inputs, const ElementLimits& limits,
                     const FactorSettings& settings) {
    const auto scene = divided(inputs, limits);
    const auto factors = scene->factors(settings);
    FactorRow row;
    double sum = 0.0, area = 0.0;
    for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
        if (scene->elements.face(e).mesh != 0 || scene->elements.face(e).back)
            continue;
        factors->row(e, row);
        EXPECT_NEAR(row.sum() + row.escaped + row.absorbed, 1.0, 1e-6);
        sum += scene->elements.area(e) * row.sum();
        area += scene->elements.area(e);
    }
    return sum / area;
}

// Above 0.01 within 1 %, below it within the largest factors of two texels (or cells).
void expectFactor(double factor, double truth, const std::string& name) {
    EXPECT_NEAR(factor, truth, truth > 0.01 ? 0.01 * truth : 2.0 * kLargestDelta) << name;
}

class MapOfAPoint : public ::testing::TestWithParam<FactorMethod> {
  protected:
    [[nodiscard]] FactorSettings settings() const {
        return {GetParam(), GetParam() == FactorMethod::Hemicube ? kCells : kTexels, 3, true};
    }
    void expect(const std::vector<Wall>& others, double truth, const std::string& name) const {
        expectFactor(factorOfFirst(sceneOf(with(smallSquare(), others)), {}, settings()), truth,
                     name);
    }
};

TEST_P(MapOfAPoint, FindsFactorsToRectangles) {
    struct Case {
        float a, b, c;
        double parallel, perpendicular; // element_to_rectangle: Howell B-3, B-4
    };
    for (const Case& k : {Case{1, 1, 1, 0.138531605995, 0.0557341970026},
                          Case{2, 1, 1, 0.167375009914, 0.0950679411924},
                          Case{0.5f, 0.5f, 1, 0.0598641176152, 0.01392769121},
                          Case{1, 1, 2, 0.0598641176152, 0.01392769121}}) {
        const auto [a, b, c, parallel, perpendicular] = k;
        const std::string name = std::to_string(a) + " " + std::to_string(b);
        expect({target({{{0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}}})}, parallel, "B-3 " + name);
        expect({target({{{c, 0, 0}, {c, b, 0}, {c, b, a}, {c, 0, a}}})}, perpendicular,
               "B-4 " + name);
    }
}

TEST_P(MapOfAPoint, FindsFactorsToPolygonsCutOffAtTheHorizon) {
    // polygon_lambert; not cut off, the second would be .0692.
    expect({target({{{1, 0, 1}, {0, 1.5f, 2}, {-0.5f, -0.5f, 1.2f}, {-0.5f, -0.5f, 1.2f}}})},
           0.173508388477, "triangle");
    expect({target({{{1, -1, -0.5f}, {1, 1, -0.5f}, {1, 1, 1}, {1, -1, 1}}})}, 0.111468394005,
           "quad");
}

TEST_P(MapOfAPoint, FindsFactorsToDiscs) {
    struct Case {
        float a, r, h;
        double truth; // element_to_disc: Howell B-13
    };
    for (const Case& k : {Case{0, 1, 1, 0.5}, Case{0, 1, 2, 0.2}, Case{1, 1, 1, 0.27639320225},
                          Case{2, 1, 1, 0.0527864045}, Case{0.5f, 0.25f, 1, 0.039182312431}})
        expect(disc({k.a, 0, k.h}, k.r), k.truth,
               std::to_string(k.a) + " " + std::to_string(k.r) + " " + std::to_string(k.h));
}

TEST_P(MapOfAPoint, FindsFactorsToSpheresOverTheHorizon) {
    struct Case {
        float r, d;
        double beta, truth; // element_to_sphere: Howell B-43 to B-45
    };
    for (const Case& k : {Case{1, 2, 0.0, 0.25}, Case{1, 2, 0.5, 0.219395640473},
                          Case{1, 2, std::numbers::pi / 2.0, 0.0288344428112},
                          Case{1, 2, 1.2, 0.0921456385604}, Case{1, 2, 1.9, 0.00279031116174},
                          Case{1, 1.5f, 1.3, 0.14499050018}, Case{0.5f, 3, 1.0, 0.0150083973852}}) {
        TraceInputs inputs = sceneOf({smallSquare()});
        TraceMesh sphere = facetedBall(48, k.r, false, 1);
        sphere.transform[3] = glm::vec4(k.d * std::sin(k.beta), 0, k.d * std::cos(k.beta), 1);
        inputs.meshes.push_back(sphere);
        inputs.materials.push_back(inputs.materials[0]);
        expectFactor(factorOfFirst(inputs, {}, settings()), k.truth, std::to_string(k.beta));
    }
}

INSTANTIATE_TEST_SUITE_P(Radiosity, MapOfAPoint,
                         ::testing::Values(FactorMethod::Hemicube, FactorMethod::Paraboloid),
                         [](const auto& test) { return std::string(name(test.param)); });

// Of extended surfaces, over whose elements the rows are averaged: several points on each of those
// that others are near to.
TEST(ParaboloidFactors, FindTheFactorsOfRectangles) {
    const FactorSettings settings{FactorMethod::Paraboloid, kTexels, 3};
    struct Parallel {
        float a, b, c;
        double truth; // Howell C-11
    };
    for (const Parallel& k :
         {Parallel{1, 1, 1, 0.199824895698}, Parallel{1, 2, 1, 0.285875384851},
          Parallel{2, 2, 1, 0.415253283577}, Parallel{10, 10, 1, 0.826994522397},
          Parallel{1, 1.5f, 0.5f, 0.475576436533}, Parallel{0.1f, 0.1f, 0.05f, 0.415253283577},
          Parallel{1, 1, 10, 0.00316205683875}}) {
        const Wall first{{{{0, 0, 0}, {k.a, 0, 0}, {k.a, k.b, 0}, {0, k.b, 0}}}};
        expectFactor(
            factorOfFirst(
                sceneOf({first,
                         target({{{0, 0, k.c}, {k.a, 0, k.c}, {k.a, k.b, k.c}, {0, k.b, k.c}}})}),
                {k.a / 4.0}, settings),
            k.truth, std::to_string(k.a) + " " + std::to_string(k.b) + " " + std::to_string(k.c));
    }
    struct Perpendicular {
        float h, l, w;
        double truth; // Howell C-14
    };
    for (const Perpendicular& k :
         {Perpendicular{1, 1, 1, 0.200043776075}, Perpendicular{2, 1, 1, 0.232852602795},
          Perpendicular{1, 1, 2, 0.116426301398}, Perpendicular{1, 2, 1, 0.240636006177},
          Perpendicular{0.5f, 1, 1, 0.146186679106}}) {
        const Wall first{{{{0, 0, 0}, {k.w, 0, 0}, {k.w, k.l, 0}, {0, k.l, 0}}}};
        expectFactor(
            factorOfFirst(
                sceneOf({first, target({{{0, 0, 0}, {0, k.l, 0}, {0, k.l, k.h}, {0, 0, k.h}}})}),
                {0.25}, settings),
            k.truth, std::to_string(k.h) + " " + std::to_string(k.l) + " " + std::to_string(k.w));
    }
}

TEST(ParaboloidFactors, FindTheFactorsOfDiscsAndOfASphere) {
    const FactorSettings settings{FactorMethod::Paraboloid, kTexels, 3};
    struct Case {
        float r1, r2, h;
        double truth; // coaxial_discs: Howell C-41
    };
    for (const Case& k : {Case{1, 1, 1, 0.38196601125}, Case{1, 2, 1, 0.7639320225},
                          Case{2, 1, 1, 0.190983005625}, Case{0.5f, 1, 2, 0.192235935956},
                          Case{1, 1, 0.1f, 0.904875078027}, Case{1, 1, 10, 0.00980486407215}}) {
        // A sector of the first sees all of the second: one for all.
        const float angle = 0.2f;
        Wall sector{{{{0, 0, 0},
                      {k.r1, 0, 0},
                      {k.r1 * std::cos(angle), k.r1 * std::sin(angle), 0},
                      {k.r1 * std::cos(angle), k.r1 * std::sin(angle), 0}}}};
        expectFactor(
            factorOfFirst(sceneOf(with(sector, disc({0, 0, k.h}, k.r2))), {k.r1 / 6.0}, settings),
            k.truth, std::to_string(k.r1) + " " + std::to_string(k.r2) + " " + std::to_string(k.h));
    }
    // Means over many small elements: fewer texels are enough.
    const FactorSettings ofBall{FactorMethod::Paraboloid, kTexels / 2, 3};
    for (const auto& [r, h, truth] : // sphere_to_coaxial_disc, whatever its radius
         {std::tuple(1.0f, 1.0f, 0.146446609407), std::tuple(1.0f, 2.0f, 0.0527864045),
          std::tuple(3.0f, 1.0f, 0.341886116992)}) {
        TraceInputs inputs = sceneOf(with(smallSquare(), disc({0, 0, h}, r)));
        const Id id = inputs.meshes[0].id;
        inputs.meshes[0] = facetedBall(12, 0.5f, false, 0);
        inputs.meshes[0].id = id;
        expectFactor(factorOfFirst(inputs, {}, ofBall), truth, std::to_string(r));
    }
}

// --- Scenes --------------------------------------------------------------------------------------

// Elements of four sizes side by side, in a room with a block: nothing gets out at the seams.
TEST(ParaboloidFactors, LoseNothingInAClosedRoom) {
    std::vector<Wall> walls = unitCube(0.5f);
    walls.push_back(
        {{{{0.4f, 0.3f, 0.5f}, {0.7f, 0.3f, 0.5f}, {0.7f, 0.6f, 0.5f}, {0.4f, 0.6f, 0.5f}}}});
    walls.back().twoSided = true;
    auto scene = divided(sceneOf(walls), {0.27});
    for (int round = 0; round < 2; ++round) {
        std::vector<std::uint32_t> some;
        for (std::uint32_t e = 0; e < scene->elements.size(); e += 5)
            some.push_back(e);
        scene->elements.divide(some);
    }
    const auto factors = scene->factors({FactorMethod::Paraboloid, 128, 1});
    FactorRow row;
    for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
        factors->row(e, row);
        EXPECT_NEAR(row.sum(), 1.0, 1e-6) << e;
        EXPECT_EQ(row.escaped, 0.0f) << e;
        EXPECT_EQ(row.absorbed, 0.0f) << e;
        const ElementMesh& elements = scene->elements;
        for (const FactorRow::Share& share : row.shares)
            EXPECT_NE(elements.node(share.element).face, elements.node(e).face)
                << "its own plane, from " << e;
    }
}

// The light that leaves the elements of the box arrives at each of its parts as rays say.
TEST(ParaboloidFactors, AgreeWithRaysInTheCornellBox) {
    const auto scene = divided(cornellBox(kCornellWalls[0], true), {0.08}, {1, 0, false});
    const ElementMesh& elements = scene->elements;
    constexpr int kRays = 1 << 14;
    const auto paraboloid = scene->factors({FactorMethod::Paraboloid, kTexels, 1}),
               rays = scene->factors({FactorMethod::Rays, kRays, 1});
    std::size_t faces = 0, shares = 0;
    const auto sums = [&](const FormFactors& factors, std::uint32_t element) {
        FactorRow row;
        factors.row(element, row);
        EXPECT_NEAR(row.sum() + row.escaped + row.absorbed, 1.0, 1e-6);
        std::vector<double> result(elements.faces().size() + 2, 0.0);
        for (const FactorRow::Share& share : row.shares)
            result[elements.node(share.element).face] += share.factor;
        result[elements.faces().size()] = row.absorbed;
        result[elements.faces().size() + 1] = row.escaped;
        shares += row.shares.size();
        return result;
    };
    for (std::uint32_t e = 0; e < elements.size(); e += 10) {
        if (elements.exposed(e) < 1.0f)
            continue; // rays leave from other points
        const std::vector<double> drawn = sums(*paraboloid, e), cast = sums(*rays, e);
        for (std::size_t face = 0; face < drawn.size(); ++face) {
            // Four standard errors of independent rays, and a texel's width about the face.
            const double noise = 4.0 * std::sqrt(cast[face] * (1.0 - cast[face]) / kRays);
            EXPECT_NEAR(drawn[face], cast[face], noise + 4.0 * kTexels * 0.1 * kLargestDelta)
                << e << " to face " << face;
            ++faces;
        }
    }
    EXPECT_GT(faces, 1000u);
    EXPECT_GT(shares, 5000u);
}

TEST(ParaboloidFactors, AreSeenThroughWhatIsCutOut) {
    // A wall before another one: cut out, half blended, and solid.
    for (const auto& [mode, opacity, share] :
         {std::tuple(AlphaMode::Mask, 0.4f, 0.0), std::tuple(AlphaMode::Mask, 0.6f, 1.0),
          std::tuple(AlphaMode::Blend, 0.25f, 0.25)}) {
        TraceInputs inputs =
            sceneOf({smallSquare(), target({{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}}),
                     target({{{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}}})});
        inputs.materials[1].alphaMode = mode;
        inputs.materials[1].opacity = opacity;
        const auto scene = divided(inputs, {});
        FactorRow row;
        scene->factors({FactorMethod::Paraboloid, 256, 1, true})->row(0, row);
        double near = 0.0;
        for (const FactorRow::Share& s : row.shares)
            if (scene->elements.face(s.element).mesh == 1)
                near += s.factor;
        // The top of a hemicube, of which both cover all.
        EXPECT_NEAR(row.sum(), 0.55412642398, 0.002);
        EXPECT_NEAR(near, share * 0.55412642398, share == 0.25 ? 0.01 : 0.002);
    }
}

// The picture that is shown: as with the hemicube, its texels add up to the row.
TEST(ParaboloidFactors, TheTexelsThatAreShownAddUpToTheRow) {
    std::vector<Wall> walls = unitCube(0.5f);
    walls[0].corners = {{{0, 0, 1}, {0, 1, 1}, {0.6f, 1, 1}, {0.6f, 0, 1}}};
    walls.push_back(
        {{{{0.4f, 0.3f, 0.5f}, {0.7f, 0.3f, 0.5f}, {0.7f, 0.6f, 0.5f}, {0.4f, 0.6f, 0.5f}}}});
    const auto scene = divided(sceneOf(walls), {0.2});
    const ParaboloidFactors factors(scene->elements, *scene->scene.rays(),
                                    {FactorMethod::Paraboloid, 64, 5, true});
    bool outside = false, backs = false;
    for (std::uint32_t e = 0; e < scene->elements.size(); e += 7) {
        FactorRow row;
        factors.row(e, row);
        const std::vector<std::uint32_t> seen = factors.seenFromCentre(e);
        ASSERT_EQ(seen.size(), factors.weights().size());
        std::vector<double> sums(scene->elements.size(), 0.0);
        double escaped = 0.0, absorbed = 0.0;
        for (std::size_t c = 0; c < seen.size(); ++c)
            (seen[c] == PointFactors::kOutside ? escaped
             : seen[c] == PointFactors::kBack  ? absorbed
                                               : sums[seen[c]]) += factors.weights()[c];
        for (const FactorRow::Share& share : row.shares) {
            EXPECT_NEAR(share.factor, sums[share.element], 1e-7) << e;
            sums[share.element] = 0.0;
        }
        EXPECT_EQ(std::count(sums.begin(), sums.end(), 0.0),
                  static_cast<std::ptrdiff_t>(sums.size()));
        EXPECT_NEAR(row.escaped, escaped, 1e-7);
        EXPECT_NEAR(row.absorbed, absorbed, 1e-7);
        outside = outside || escaped > 0.0;
        backs = backs || absorbed > 0.0;
    }
    EXPECT_TRUE(outside);
    EXPECT_TRUE(backs);
}

} // namespace
} // namespace patina::test
