#include "core/radiosity/document/SurfaceProfile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace patina {

using namespace radiosity;

namespace {

constexpr double kCrease = 0.5; // cosine of the most that the normal turns between neighbours

// What a plane cuts of an element.
struct Cut {
    std::array<glm::dvec3, 2> ends; // scene units
    std::uint32_t element = 0;
    bool taken = false;
};

glm::dvec3 directionOf(const glm::dvec3& normal, ProfileWay way) {
    constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);
    const bool level = std::abs(normal.y) > 0.999;
    const glm::dvec3 across =
        level ? glm::dvec3(1.0, 0.0, 0.0) : glm::normalize(glm::cross(kUp, normal));
    return way == ProfileWay::Across ? across
           : level                   ? glm::dvec3(0.0, 0.0, 1.0)
                                     : glm::cross(normal, across);
}

std::optional<Cut> cutOf(const ElementMesh& elements, std::uint32_t element,
                         const glm::dvec3& middle, const glm::dvec3& planeNormal, double smallest) {
    const Polygon polygon = elements.polygon(element);
    std::array<glm::dvec3, Polygon::kMax> met{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3 &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
        const double da = glm::dot(a - middle, planeNormal), db = glm::dot(b - middle, planeNormal);
        if ((da <= 0.0) != (db <= 0.0) && count < met.size())
            met[count++] = a + (b - a) * (da / (da - db));
    }
    // A convex polygon has two such edges, or none.
    if (count != 2 || glm::distance(met[0], met[1]) < smallest)
        return std::nullopt;
    return Cut{{met[0], met[1]}, element};
}

// The neighbour of a cut that has just ended at `end` after `begin`; null: none.
Cut* next(std::vector<Cut>& cuts, const ElementMesh& elements, std::uint32_t from,
          const glm::dvec3& begin, const glm::dvec3& end, double near) {
    for (Cut& cut : cuts) {
        if (cut.taken)
            continue;
        const bool first = glm::distance(cut.ends[0], end) < near;
        if (!first && glm::distance(cut.ends[1], end) >= near)
            continue;
        if (glm::distance(cut.ends[first ? 1 : 0], begin) < near ||
            glm::dot(elements.face(cut.element).normal, elements.face(from).normal) < kCrease)
            continue;
        if (!first)
            std::swap(cut.ends[0], cut.ends[1]);
        return &cut;
    }
    return nullptr;
}

} // namespace

SurfaceProfile profileOver(const LiveRadiosity& live, std::uint32_t element, ProfileWay way) {
    const ElementMesh& elements = live.elements();
    const Face& face = elements.face(element);
    const glm::dvec3 middle = elements.centre(element);
    const glm::dvec3 along = directionOf(face.normal, way);
    const glm::dvec3 planeNormal = glm::cross(face.normal, along);
    // Of the element's own size: neighbours end where it ends but for rounding.
    const double size = std::sqrt(elements.area(element)) / elements.metresPerUnit();
    const double near = 1e-4 * size;

    SurfaceProfile profile;
    profile.way = glm::vec3(along);
    std::vector<Cut> cuts;
    std::size_t start = 0;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const Face& other = elements.face(e);
        if (other.mesh != face.mesh || other.back != face.back)
            continue;
        if (const auto cut = cutOf(elements, e, middle, planeNormal, near)) {
            if (e == element)
                start = cuts.size();
            cuts.push_back(*cut);
        }
    }
    if (cuts.empty() || cuts[start].element != element)
        return profile;
    Cut& own = cuts[start];
    own.taken = true;
    if (glm::dot(own.ends[1] - own.ends[0], along) < 0.0)
        std::swap(own.ends[0], own.ends[1]);
    const double metres = elements.metresPerUnit();
    const double back = metres * glm::distance(own.ends[0], middle);
    const double forth = metres * glm::distance(own.ends[1], middle);
    profile.pieces.push_back({-back, forth, element});
    for (const bool forwards : {true, false}) {
        glm::dvec3 begin = own.ends[forwards ? 0 : 1], end = own.ends[forwards ? 1 : 0];
        double at = forwards ? forth : -back;
        for (std::uint32_t from = element;;) {
            Cut* cut = next(cuts, elements, from, begin, end, near);
            if (cut == nullptr)
                break;
            cut->taken = true;
            begin = cut->ends[0];
            end = cut->ends[1];
            from = cut->element;
            const double to = at + (forwards ? metres : -metres) * glm::distance(begin, end);
            profile.pieces.push_back({std::min(at, to), std::max(at, to), from});
            at = to;
        }
    }
    std::ranges::sort(profile.pieces, {}, &SurfaceProfile::Piece::from);
    return profile;
}

} // namespace patina
