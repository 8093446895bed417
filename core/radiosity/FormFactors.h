// Form factors between the elements of a scene: which share of the light that leaves one, or a
// patch of several, arrives at each other one, obstacles in between included. Several methods
// behind one interface.
#pragma once

#include "core/base/Result.h"
#include "core/radiosity/ElementMesh.h"

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace patina::radiosity {

class HemicubeDrawer;

// What becomes of the light that leaves an element or a patch: the mean over its area. All shares
// sum up to 1 (rays, hemicube, paraboloid) or to 1 but for the method's error (analytic).
struct FactorRow {
    struct Share {
        std::uint32_t element;
        float factor; // > 0
    };
    std::vector<Share> shares; // ascending by element, each once
    float absorbed = 0.0f;     // meets backs that only absorb
    float escaped = 0.0f;      // leaves the scene
    // Rays that count alike and whose mean the shares are; 0: they were computed otherwise.
    std::uint32_t rays = 0;

    void clear() {
        shares.clear();
        absorbed = escaped = 0.0f;
        rays = 0;
    }
    [[nodiscard]] double sum() const; // of shares
};

enum class FactorMethod {
    Rays,       // Malley's: cosine-weighted rays from points all over the element
    Hemicube,   // Cohen & Greenberg 1985
    Analytic,   // polygons in closed form, times a visibility by pairs of points
    Paraboloid, // an item buffer drawn on Heidrich & Seidel's map
};

// Whether FactorSettings::stands has a say.
[[nodiscard]] constexpr bool hasStands(FactorMethod method) {
    return method == FactorMethod::Hemicube || method == FactorMethod::Paraboloid;
}
[[nodiscard]] std::string_view name(FactorMethod method); // raycast, hemicube, analytic, paraboloid

struct FactorSettings {
    FactorMethod method = FactorMethod::Rays;
    // Rays: how many leave an element (a power of two is spread most evenly), and a patch for each
    // of its elements. Hemicube: cells along
    // an edge, even. Analytic: pairs of points that decide over the visibility of two elements.
    // Paraboloid: texels along the diameter.
    int resolution = 256;
    std::uint32_t seed = 0;
    // Hemicube, paraboloid: one at the element's centre, as in 1985, even where others are near, or
    // where a part of it is within something.
    bool centreOnly = false;
    // Hemicube: draws it; null: rays find what is in its cells.
    std::shared_ptr<HemicubeDrawer> drawer = nullptr;
    // Hemicube, paraboloid: how many stand along each direction of an element that others are near
    // to, after one at its centre; 1: that one alone, but of elements that are partly within
    // something, which it might be, too.
    int stands = 3;
    friend bool operator==(const FactorSettings&, const FactorSettings&) = default;
};

// The resolution that `method` has unless it is told otherwise, and its bounds.
struct ResolutionRange {
    int usual, lowest, highest;
};
[[nodiscard]] ResolutionRange resolutionRange(FactorMethod method);

class FormFactors {
  public:
    virtual ~FormFactors() = default;
    // Of ElementMesh::sender(). Callable from any thread. The same row whenever it is asked for.
    virtual void row(std::uint32_t sender, FactorRow& row) const = 0;
};

// How long all rows will take on all threads, s, by some of them that are computed for it.
[[nodiscard]] double expectedSeconds(const FormFactors& factors, std::size_t senders,
                                     const JobContext& job);

// `elements` and `rays`, both of one scene, must outlive the answer. Errors: those of
// HemicubeDrawer::load().
[[nodiscard]] Result<std::unique_ptr<FormFactors>>
makeFormFactors(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings);

} // namespace patina::radiosity
