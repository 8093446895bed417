// A solution step by step, as progressive refinement comes to it: shot by shot, forth and back. By
// the rule of the solver where it shoots, else by the largest unshot power.
#pragma once

#include "core/radiosity/Shooting.h"
#include "core/radiosity/document/LiveRadiosity.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace patina {

class RadiositySteps {
  public:
    // Nothing is shot yet. `live` has its form factors.
    explicit RadiositySteps(LiveRadiosityPtr live);

    // As it is after so many shots, or after the last one that has anything to send. Backwards it
    // begins anew, which takes as long as the shots did.
    void goTo(std::uint64_t shots);
    [[nodiscard]] std::uint64_t shots() const { return m_shooting->shots(); }
    [[nodiscard]] bool atEnd() const; // the residual is what the settings ask for, or all is shot
    // One that every sender, an element or a patch, would shoot in, once.
    [[nodiscard]] std::uint64_t shotsPerRound() const { return m_live->elements().senderCount(); }

    [[nodiscard]] radiosity::Solution solution() const { return m_shooting->solution(); }
    [[nodiscard]] std::vector<glm::dvec3> unshot() const; // of each element, W/m²
    // The sender that has shot, that will shoot.
    [[nodiscard]] std::optional<std::uint32_t> last() const { return m_last; }
    [[nodiscard]] std::optional<std::uint32_t> next() const;
    [[nodiscard]] radiosity::Shooting::Energy energy() const { return m_shooting->energy(); }
    // Residual after each shot, the first before any.
    [[nodiscard]] const std::vector<double>& residuals() const { return m_residuals; }
    [[nodiscard]] const LiveRadiosityPtr& live() const { return m_live; }

  private:
    [[nodiscard]] radiosity::Shooting begun() const;

    LiveRadiosityPtr m_live;
    std::optional<radiosity::Shooting> m_shooting; // always there
    std::optional<std::uint32_t> m_last;
    std::vector<double> m_residuals;
};

} // namespace patina
