// A solution step by step, forth and back: shot by shot, as progressive refinement comes to it, or
// sweep by sweep, as gathering does.
#pragma once

#include "core/radiosity/Gathering.h"
#include "core/radiosity/Shooting.h"
#include "core/radiosity/document/LiveRadiosity.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace patina {

enum class RadiosityStep {
    Shot, // by the rule of the solver where it shoots, else by the largest unshot power
    // Every element gathers once: in order from the newest light where the solver is
    // Solver::GaussSeidel, else all from that of the sweep before, so that after n sweeps light has
    // been reflected n times. Not of patches, of which elements have no rows.
    Sweep
};

class RadiositySteps {
  public:
    // No step is done yet. `live` has its form factors.
    explicit RadiositySteps(LiveRadiosityPtr live, RadiosityStep unit = RadiosityStep::Shot);

    // As it is after so many steps, or after the last one that changes anything. Backwards it
    // begins anew, which takes as long as the steps did. Cancelled: after some of them.
    void goTo(std::uint64_t steps, const JobContext& job = {});
    [[nodiscard]] std::uint64_t done() const { return m_residuals.size() - 1; }
    [[nodiscard]] bool atEnd() const; // the residual is what the settings ask for, or all is shot
    // After which every sender, an element or a patch, has had its turn once.
    [[nodiscard]] std::uint64_t stepsPerRound() const;

    [[nodiscard]] radiosity::Solution solution() const;
    // Of each element, W/m²: what is still to be shot, or what the last sweep has added.
    [[nodiscard]] std::vector<glm::dvec3> unshot() const;
    // The sender that has shot, that will shoot.
    [[nodiscard]] std::optional<std::uint32_t> last() const { return m_last; }
    [[nodiscard]] std::optional<std::uint32_t> next() const;
    // Nothing where each element of a sweep gathers another state of the light.
    [[nodiscard]] std::optional<radiosity::Shooting::Energy> energy() const;
    // After each step, the first before any.
    [[nodiscard]] const std::vector<double>& residuals() const { return m_residuals; }
    [[nodiscard]] const LiveRadiosityPtr& live() const { return m_live; }
    [[nodiscard]] RadiosityStep unit() const { return m_unit; }

  private:
    void begin();
    void step(const JobContext& job);

    LiveRadiosityPtr m_live;
    RadiosityStep m_unit;
    // The one of the unit.
    std::optional<radiosity::Shooting> m_shooting;
    std::optional<radiosity::Gathering> m_gathering;
    std::vector<glm::dvec3> m_before; // radiosity, W/m², before the last sweep
    std::optional<std::uint32_t> m_last;
    std::vector<double> m_residuals;
};

} // namespace patina
