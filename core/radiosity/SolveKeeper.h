// A radiosity that is being solved as values, so that it may be kept, gone on with and found in
// parts: what there is between two steps is all that the next one depends on.
#pragma once

#include "core/base/Result.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/SceneProblem.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace patina {
class TraceScene;
}

namespace patina::radiosity {

// After some shots, or a sweep.
struct SolveStep {
    std::uint64_t iterations = 0; // shots or sweeps so far
    double residual = 0.0;
    friend bool operator==(const SolveStep&, const SolveStep&) = default;
};

// Where a solver is. Nothing of it but `steps` where no step was made.
struct SolverState {
    std::vector<glm::dvec3> radiosity;      // of each element: what it has shot, or its radiosity
    std::vector<glm::dvec3> irradiance;     // of each element
    glm::dvec3 unshotPower{0.0}, lost{0.0}; // of shooting: sums, W
    std::vector<SolveStep> steps;
    bool ended = false; // by itself; else it has to go on
    // Of shooting, where elements were divided after the last step: `radiosity` is what has been
    // shot, and it has still to be sent to the new elements. The irradiance counts not.
    bool shootAgain = false;
};
// The same, of a solver at work.
struct SolverView {
    std::span<const glm::dvec3> radiosity, irradiance;
    glm::dvec3 unshotPower{0.0}, lost{0.0};
    std::span<const SolveStep> steps;
    bool ended = false;
    bool shootAgain = false;
};
[[nodiscard]] inline SolverView viewOf(const SolverState& solver) {
    return {solver.radiosity, solver.irradiance, solver.unshotPower, solver.lost,
            solver.steps,     solver.ended,      solver.shootAgain};
}

struct SolveState {
    SolveState() = default;
    explicit SolveState(std::size_t elements)
        : SolveState(elements, elements) {}
    SolveState(std::size_t elements, std::size_t senders) // as ElementMesh has them
        : light(elements)
        , rows(senders) {}

    // Of a division where light changes: which elements each round has divided, and whether it was
    // the last.
    std::vector<std::vector<std::uint32_t>> divisions;
    bool divided = false;
    // Of the elements that are there now.
    DirectLight light;
    FactorMatrix rows; // as far as they were found and kept
    SolverState solver;
};

// Who keeps a solution while it is computed. What it gives back is worked on in place.
class SolveKeeper {
  public:
    virtual ~SolveKeeper() = default;

    // Before begin(): divides `elements` as they were when they were kept. Errors: InputBroken
    // where what was kept is of other elements.
    virtual Result<void> divide(ElementMesh& elements) = 0;
    // From here on state() is of these elements, with what was kept of them; of those that were
    // divided further since the first call nothing was. Its divisions stay. Errors: InputBroken, as
    // above.
    virtual Result<void> begin(const TraceScene& scene, const ElementMesh& elements) = 0;
    // From any thread, often; where there is a solver, between two of its steps.
    virtual void between(const SolverView& solver) = 0;

    // All that there is; its solver's part as it was when the solver last ended, by itself or not.
    [[nodiscard]] SolveState& state() { return m_state; }

  protected:
    // A state of these elements of which nothing is known but how they were divided.
    void forget(const ElementMesh& elements) {
        SolveState state(elements.size(), elements.senderCount());
        state.divisions = std::move(m_state.divisions);
        m_state = std::move(state);
    }

    SolveState m_state;
};

// Who keeps it in memory alone.
class MemoryKeeper : public SolveKeeper {
  public:
    MemoryKeeper() = default;
    explicit MemoryKeeper(const SolveState& state) { m_state = state; }
    Result<void> divide(ElementMesh&) override { return {}; }
    Result<void> begin(const TraceScene&, const ElementMesh& elements) override {
        forget(elements);
        return {};
    }
    void between(const SolverView&) override {}
};

} // namespace patina::radiosity
