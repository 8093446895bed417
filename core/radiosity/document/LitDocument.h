// A document's scene solved for radiosity, and the solution as a document whose meshes have their
// light at the vertices: what files of it are written from.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/export/LitVertices.h"
#include "core/job/JobContext.h"
#include "core/radiosity/Hierarchical.h"
#include "core/radiosity/Reconstruction.h"
#include "core/radiosity/SceneProblem.h"
#include "core/radiosity/Solve.h"
#include "core/radiosity/Subdivision.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace patina {

struct RadiositySettings {
    double maxArea = 0.0; // m² of an element; 0: about kUsualElements of them, whatever the scene
    // Above 0: elements are divided in four, again and again, where divideBy finds more than this
    // share of the light that one has or that the scene has in the mean; maxArea is then that of
    // the first ones (0: about kFirstElements), and none becomes smaller than 1 / 512 of it.
    double adaptive = 0.0;
    radiosity::DivisionRule divideBy = radiosity::DivisionRule::Gradient;
    // That is looked for while light is shot, whenever half of what was unshot has been, instead of
    // in whole solutions one after another. Of solvers that shoot.
    bool dynamic = false;
    // m², not below maxArea: surfaces are divided into patches of this size, and these into
    // elements; patches shoot, elements receive (radiosity::Patches). Of solvers that shoot. 0: no
    // patches.
    double patchArea = 0.0;
    std::size_t maxElements = 1'000'000;
    radiosity::FactorSettings factors;
    radiosity::SolveSettings solve;
    radiosity::HierarchySettings hierarchy; // of Solver::Hierarchical, which needs no factors
    int lightSamples = 128;
    // Elements that glow shoot like all others, as in the textbooks, instead of being sent rays to.
    bool classic = false;
    friend bool operator==(const RadiositySettings&, const RadiositySettings&) = default;
    static constexpr double kUsualElements = 4000.0, kFirstElements = 1000.0;
    // Of the first elements' largest area: none becomes smaller where light changes.
    static constexpr double kLeastShare = 1.0 / 512.0;
};

// What a solution is of. All three belong to one scene, and outlive it.
struct SolvedSurfaces {
    const TraceScene& scene;
    const radiosity::ElementMesh& elements;
    const radiosity::SceneProblem& lit;
};

// A scene and its elements. Stays where it is: its parts refer to one another.
class RadiosityScene {
  public:
    // Errors: those of TraceScene::build(), ElementMesh::make() and SceneProblem::make(); with
    // settings.adaptive, which solves as it divides, those of solve(), too; Usage for patches or
    // settings.dynamic with a solver that does not shoot; those of `keeper`, who has the state of
    // what is computed, of solve(), too. Where settings.dynamic has come to while it divided
    // solve() goes on.
    static Result<std::unique_ptr<RadiosityScene>>
    make(const Document& document, const RadiositySettings& settings, const JobContext& job);
    static Result<std::unique_ptr<RadiosityScene>> make(const TraceInputs& inputs,
                                                        const RadiositySettings& settings,
                                                        const JobContext& job,
                                                        radiosity::SolveKeeper* keeper = nullptr);
    // Surfaces divided to begin with, and no light yet. Errors: those of TraceScene::build() and
    // ElementMesh::make().
    static Result<std::unique_ptr<RadiosityScene>>
    divide(const TraceInputs& inputs, const RadiositySettings& settings, const JobContext& job);
    // The same, and then as `keeper` has it; null: as it is. Errors: the keeper's, too.
    static Result<std::unique_ptr<RadiosityScene>> divideAsKept(const TraceInputs& inputs,
                                                                const RadiositySettings& settings,
                                                                const JobContext& job,
                                                                radiosity::SolveKeeper* keeper);

    // Finds the direct light and the form factors of a shard's elements in the keeper's state(),
    // and solves nothing. The division is even (settings.adaptive is 0). Errors: as make().
    static Result<void> findPart(const TraceInputs& inputs, const RadiositySettings& settings,
                                 const radiosity::ElementShard& shard, const JobContext& job,
                                 radiosity::SolveKeeper& keeper);

    // How long the form factors that solve() needs all of will take, s; 0 where it needs none, or
    // as many as it shoots. Errors: those of makeFormFactors().
    [[nodiscard]] Result<double> expectedFactorSeconds(const RadiositySettings& settings,
                                                       const JobContext& job) const;
    // `keeper`: the one that it was made with. Errors: those of radiosity::solve().
    [[nodiscard]] Result<radiosity::Solved> solve(const RadiositySettings& settings,
                                                  const JobContext& job,
                                                  const radiosity::SolveObserver& observer = {},
                                                  radiosity::SolveKeeper* keeper = nullptr) const;

    [[nodiscard]] const radiosity::ElementMesh& elements() const { return m_elements; }
    [[nodiscard]] const radiosity::SceneProblem& lit() const { return m_lit; }
    [[nodiscard]] const TraceScene& scene() const { return m_scene; }
    [[nodiscard]] SolvedSurfaces surfaces() const { return {m_scene, m_elements, m_lit}; }

  private:
    RadiosityScene(TraceScene scene, radiosity::ElementMesh elements);
    Result<void> light(const RadiositySettings& settings, const JobContext& job,
                       radiosity::SolveKeeper* keeper);
    Result<void> divideWhereLightChanges(const RadiositySettings& settings, const JobContext& job,
                                         radiosity::SolveKeeper& keeper);
    Result<void> divideWhileShooting(const RadiositySettings& settings, const JobContext& job,
                                     radiosity::SolveKeeper& keeper);
    struct DivisionLook {
        // As DivisionSettings has them.
        glm::dvec3 ambient{0.0};
        std::vector<double> noise;
        bool first = false;
    };
    // The elements to divide; none where none is too coarse. Errors: Cancelled; Usage where there
    // would be too many.
    [[nodiscard]] Result<std::vector<std::uint32_t>> tooCoarse(const RadiositySettings& settings,
                                                               const radiosity::Solution& solution,
                                                               const DivisionLook& look,
                                                               const JobContext& job) const;
    // Divides them and finds the light of what is new; `keeper` begins anew.
    Result<void> divideFurther(std::vector<std::uint32_t> elements,
                               const RadiositySettings& settings, const JobContext& job,
                               radiosity::SolveKeeper& keeper);

    TraceScene m_scene;
    radiosity::ElementMesh m_elements;
    radiosity::SceneProblem m_lit;
    // What was found while it divided, without a keeper; null: nothing.
    struct Begun {
        RadiositySettings settings;
        radiosity::SolveState state;
    };
    std::unique_ptr<const Begun> m_begun;
};

// The part of a mesh of the document that is seen from one side, divided as it was solved.
struct LitPart {
    Id instance = 0; // MeshInstance::id
    bool back = false;
    MeshPtr mesh;                      // world
    std::vector<glm::vec3> irradiance; // of each vertex, W/m²
    std::vector<glm::vec3> radiosity;  // of each vertex, W/m²
};

[[nodiscard]] std::vector<LitPart> litParts(const SolvedSurfaces& surfaces,
                                            const radiosity::Solution& solution);

// 1 - e^(-kL): from light of any size to 0…1. `k` per unit of radiance.
[[nodiscard]] glm::vec3 exposed(const glm::vec3& radiance, double k);
// The k that shows the median, by area, of what is lit as middle grey, .18: what glows, and insides
// where no light comes, have no say.
[[nodiscard]] double automaticExposure(const Document& document, const std::vector<LitPart>& parts);

// What has less than this share of the mean light is an inside, or lies in the dark, and has no
// say.
inline constexpr double kDarkShare = 0.02;
struct LitArea {
    double area, radiance;
};
// The k that shows the median, by area, of these radiances as middle grey; 1 of none.
[[nodiscard]] double exposureOfMedian(std::vector<LitArea> pieces);

struct LitDocument {
    Document document; // meshes and materials are those that are lit; cameras and names stay
    std::shared_ptr<const LitMeshes> lit;
    std::map<Id, Id> instanceOf;    // of each lit mesh: the MeshInstance::id that it is a part of
    std::optional<double> exposure; // of its colours: k; nullopt: cut off at 1
    float backOffset = 0.0f;        // metres that backs are moved off the fronts that they are of
    std::shared_ptr<const LitTexels> lightMap; // of all meshes; null: light is at their vertices
};
// The document without its meshes, materials, lights and what is computed from them.
[[nodiscard]] LitDocument withoutLight(const Document& document, std::optional<double> exposure);
// Adds a side of an instance of the document it was made of: `mesh` is in world space. Backs are
// moved along their normals: two surfaces at one place flicker where a program draws both.
MeshInstance& addPart(LitDocument& lit, const MeshInstance& instance, bool back, MeshPtr mesh);
// `exposure`: k; nullopt: values as they are, cut off at 1.
[[nodiscard]] LitDocument litDocument(const Document& document, const std::vector<LitPart>& parts,
                                      std::optional<double> exposure);

} // namespace patina
