// Progressive radiosity: one element, or patch of several, after another sends the light that it
// has not sent yet to all elements. The picture is there from the first shot on, and only one row
// of form factors at a time. Cohen, Chen, Wallace & Greenberg 1988, "A Progressive Refinement
// Approach to Fast Radiosity Image Generation"; as a relaxation: Gortler, Cohen & Slusallek 1994,
// "Radiosity and Relaxation Methods".
#pragma once

#include "core/radiosity/FormFactors.h"
#include "core/radiosity/Problem.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina::radiosity {

// Which sender, an element or a patch, shoots next; of equals the one with the lowest index.
enum class ShootingRule {
    Power,    // the largest unshot power, A |ΔB|: progressive shooting
    Residual, // the largest unshot radiosity, |ΔB|: Southwell's relaxation
};

class Shooting {
  public:
    // `overshoot`: an element also sends what it will receive yet, as far as the mean of all unshot
    // light tells; what was too much is taken back with the opposite sign. Feda & Purgathofer 1992,
    // "Accelerating Radiosity by Overshooting".
    Shooting(const Problem& problem, ShootingRule rule, bool overshoot);
    // Where another one has been, of the same problem. Vectors: of each element.
    struct State {
        std::vector<glm::dvec3> shot, irradiance; // so far
        glm::dvec3 unshotPower{0.0};              // Σ A ΔB
        glm::dvec3 lost{0.0};
        std::uint64_t shots = 0;
    };
    Shooting(const Problem& problem, ShootingRule rule, bool overshoot, State state);
    [[nodiscard]] const State& state() const { return m_state; }

    // The senders that shoot next, the first one first, at most `count`; none where all is shot.
    // With overshooting, what they would send decides.
    [[nodiscard]] std::vector<std::uint32_t> next(std::size_t count) const;
    // Sends the unshot light of a sender, of a patch the mean over its elements, along its row of
    // form factors.
    void shoot(std::uint32_t sender, const FactorRow& row);
    // Sends `light` of each element instead: as much as another one, of coarser elements, has shot.
    void shootAgain(std::uint32_t sender, const FactorRow& row, std::span<const glm::dvec3> light);

    [[nodiscard]] glm::dvec3 radiosity(std::uint32_t element) const; // with what is unshot
    [[nodiscard]] glm::dvec3 unshot(std::uint32_t element) const;
    [[nodiscard]] Solution solution() const;
    // Unshot power, of patches what their elements have together, by emitted power: the residual of
    // what has been shot.
    [[nodiscard]] double residual() const;
    [[nodiscard]] std::uint64_t shots() const { return m_state.shots; }

    // Where the emitted power is now; they sum up to it.
    struct Energy {
        double emitted = 0.0, absorbed = 0.0, lost = 0.0, unshot = 0.0; // W, summed over colours
    };
    [[nodiscard]] Energy energy() const;
    // What an element would show if the light that is still unshot were spread evenly (1988,
    // section 5): an estimate for the eye, never part of the solution.
    [[nodiscard]] glm::dvec3 ambient() const;

  private:
    // Sends power, W, of a sender along its row.
    void send(std::uint32_t sender, const glm::dvec3& power, const FactorRow& row);
    // After a shot: what the senders that it met would shoot now. All of them where overshooting
    // looks ahead, which depends on everything.
    void renew() const;
    // That a sender would shoot now, W/m².
    [[nodiscard]] glm::dvec3 unshotMean(std::uint32_t sender, const glm::dvec3& ahead) const;

    const Problem& m_problem;
    ShootingRule m_rule;
    bool m_overshoot;
    State m_state;
    glm::dvec3 m_meanReflectance{0.0}; // by area
    std::vector<double> m_areas;       // of each sender
    double m_area = 0.0, m_emitted = 0.0;
    std::vector<std::uint32_t> m_senderOf; // of each element, where there are patches
    // |ΔB| of each sender, and those that are to be looked at again: thousands of shots would
    // otherwise add up all elements each.
    mutable std::vector<double> m_unshot;
    mutable std::vector<std::uint32_t> m_changed;
    mutable std::vector<bool> m_isChanged;
};

} // namespace patina::radiosity
