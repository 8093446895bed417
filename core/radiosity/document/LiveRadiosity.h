// The radiosity of a document that is edited: what an edit leaves as it was, elements, form
// factors, the light of each source, is kept from one solution to the next. Functions of values, on
// any thread.
//
// Light is solved source by source: light adds up, so that what the mixer does to a source (gain,
// tint, on, solo) scales its solution and solves nothing. What a SolutionCache has from an earlier
// session is not solved again.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/light/Light.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/RadiositySurfaces.h"
#include "core/radiosity/file/SolutionCache.h"
#include "core/trace/path/TraceInputs.h"

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

// What light comes from, and what it does alone. Vectors: one for each element.
struct RadiositySource {
    enum class Kind { Glow, Sky, Light, Lights };
    Kind kind = Kind::Light;
    Id id = 0;                 // Kind::Light: of the light
    glm::dvec3 power{1.0};     // that it is scaled by now
    std::vector<Light> lights; // at a power of 1; of Kind::Lights, which is many, as they are
    std::vector<TraceEnvironment> environments; // Kind::Sky: one at a scale of 1, or as they are
    std::vector<glm::dvec3> direct;             // irradiance at a power of 1, W/m²
    std::vector<glm::dvec3> bounced; // the same, by way of other elements; empty: not solved yet
    double residual = 1.0;           // of `bounced`, as SolveReport has it
    int sweeps = 0;                  // or shots
    // Solver::Hierarchical: what `bounced` was gathered over; null: not solved yet, or black.
    std::shared_ptr<const radiosity::HierarchyLinks> links{};
    bool found = false;        // in a cache, and not solved here
    bool withoutLinks = false; // Solver::Hierarchical: found so, and its links not yet
};

// An adaptive division, as a SolutionCache keeps it.
struct NamedDivision {
    Hash key; // divisionKey()
    radiosity::KeptDivision kept;
};

// What an edit of a colour or a light leaves alone: how surfaces are divided …
struct RadiosityShape {
    std::unique_ptr<const RadiosityScene> scene; // as it was when it was divided
    radiosity::LitMesh mesh;
    std::vector<RadiositySurface> surfaces; // of it, Corners::PerElement
    // Of an adaptive one that was made with a cache at hand, to the end.
    std::optional<NamedDivision> division;
};
// … and which share of the light that leaves a sender, an element or a patch, arrives at each
// element.
struct RadiosityFactors {
    radiosity::FactorMatrix matrix;
    radiosity::FactorQuality quality; // of patches: between them
};

// A solution, or one on its way.
struct LiveRadiosity {
    TraceInputs inputs; // that it is of
    RadiositySettings settings;
    std::shared_ptr<const TraceScene> scene; // its lights are those of `sources`
    std::shared_ptr<const RadiosityShape> shape;
    // Null: not computed yet, or not asked for. Solver::Hierarchical has none.
    std::shared_ptr<const RadiosityFactors> factors;
    std::vector<RadiositySource> sources;     // that are on, Kind::Lights last
    std::vector<RadiositySource> switchedOff; // kept for when they are on again
    // All sources together.
    radiosity::SceneProblem lit;
    radiosity::Solution solution;
    bool solved = false;   // to what the settings ask for
    double residual = 1.0; // the largest of the sources'
    int sweeps = 0;        // or shots: the most of the sources'

    [[nodiscard]] const radiosity::ElementMesh& elements() const {
        return shape->scene->elements();
    }
    // Form factors are there; with Solver::Hierarchical: the links of every source.
    [[nodiscard]] bool hasFactors() const;
    [[nodiscard]] std::size_t foundSources() const; // RadiositySource::found
};
using LiveRadiosityPtr = std::shared_ptr<const LiveRadiosity>;

// Told of what there is on the way: at once the light that comes straight, and then about ten
// times a second. From the thread that solves.
using LiveRadiosityObserver = std::function<void(const LiveRadiosityPtr&)>;

// What the view asks for.
[[nodiscard]] RadiositySettings radiositySettings(const View& view);

struct FollowOptions {
    // Where light is looked for that `before` has not solved; null: nowhere. Nothing is written:
    // keepRadiosity().
    const radiosity::SolutionCache* cache = nullptr;
    // LiveRadiosity::hasFactors() in the end, even where all light is there without: for steps, and
    // to see who lights whom. Form factors and links are not in the cache, being a hundred times as
    // large as the light.
    bool factors = true;
    // Told how long form factors will take, s, before they are begun; from the job's thread.
    std::function<void(double seconds)> expects = {};
};

// `before`: the solution before the edit; null: none. Of settings.solve the limit of iterations is
// not read. A scene without any light is solved, and black. Where all light is there and only
// form factors are computed, the observer is told once, of the solution. Errors: those of
// RadiosityScene::make(), FactorMatrix::compute() and, with Solver::Direct, directSolution().
Result<LiveRadiosityPtr> followRadiosity(const TraceInputs& inputs,
                                         const RadiositySettings& settings,
                                         const LiveRadiosityPtr& before, const JobContext& job,
                                         const LiveRadiosityObserver& observer = {},
                                         const FollowOptions& options = {});

// Light as it is drawn.
struct ShownRadiosity {
    std::shared_ptr<const RadiosityShape> shape;
    std::vector<glm::vec3> irradiance; // W/m², by RadiositySurface::lights
    struct Element {
        glm::vec3 radiosity{0.0f}; // of all that it sends, W/m²
        glm::vec3 unshot{0.0f};    // of it, what has not been sent on yet
        float area = 0.0f;         // m²
        float share = 0.0f; // of the light of a chosen element, or of its patch, that arrives, 0…1
    };
    std::vector<Element> elements;
    std::optional<std::uint32_t> chosen; // Element::share is of
};
using ShownRadiosityPtr = std::shared_ptr<const ShownRadiosity>;

// `solution` may be one on the way to that of `live`: then `unshot` says what of it is still to be
// sent, W/m². `chosen`: an element whose form factors are shown.
[[nodiscard]] ShownRadiosityPtr shownRadiosity(const LiveRadiosity& live,
                                               const radiosity::Solution& solution,
                                               const std::vector<glm::dvec3>& unshot = {},
                                               std::optional<std::uint32_t> chosen = std::nullopt);

} // namespace patina
