#include "core/radiosity/document/SourceSolver.h"

#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/Gathering.h"
#include "core/radiosity/Shooting.h"

#include <algorithm>
#include <utility>

namespace patina {

using namespace radiosity;

namespace {

class SweepingSolver final : public SourceSolver {
  public:
    SweepingSolver(const Problem& problem, const FactorMatrix& factors, Sweep sweep)
        : m_gathering(problem, factors, sweep) {}
    Result<void> step(const JobContext& job) override {
        m_gathering.sweep(job);
        ++m_sweeps;
        return {};
    }
    [[nodiscard]] double residual(const JobContext& job) const override {
        return m_gathering.residual(job);
    }
    [[nodiscard]] std::vector<glm::dvec3> irradiance() const override {
        return m_gathering.solution().irradiance;
    }
    [[nodiscard]] std::uint64_t iterations() const override { return m_sweeps; }

  private:
    Gathering m_gathering;
    std::uint64_t m_sweeps = 0;
};

class ShootingSolver final : public SourceSolver {
  public:
    ShootingSolver(const Problem& problem, const FactorMatrix& factors,
                   const SolveSettings& settings)
        : m_factors(factors)
        , m_perStep(std::max<std::size_t>(settings.shotsPerStep, 1))
        , m_shooting(problem, shootingRule(settings.solver),
                     settings.solver == Solver::Overshooting) {}
    // About a sixteenth of the senders.
    Result<void> step(const JobContext& job) override {
        constexpr std::size_t kSteps = 16;
        for (std::size_t shots = 0; shots < m_factors.size() / kSteps + 1 && !job.cancelled();) {
            const std::vector<std::uint32_t> next = m_shooting.next(m_perStep);
            if (next.empty())
                break;
            for (const std::uint32_t sender : next)
                m_shooting.shoot(sender, m_factors.whole(sender));
            shots += next.size();
        }
        return {};
    }
    [[nodiscard]] double residual(const JobContext&) const override {
        return m_shooting.residual();
    }
    [[nodiscard]] std::vector<glm::dvec3> irradiance() const override {
        return m_shooting.state().irradiance;
    }
    [[nodiscard]] std::uint64_t iterations() const override { return m_shooting.shots(); }

  private:
    const FactorMatrix& m_factors;
    std::size_t m_perStep;
    Shooting m_shooting;
};

class DirectSolver final : public SourceSolver {
  public:
    DirectSolver(const Problem& problem, const FactorMatrix& factors)
        : m_problem(problem)
        , m_factors(factors) {}
    Result<void> step(const JobContext& job) override {
        auto solution = directSolution(m_problem, m_factors, job);
        if (!solution)
            return solution.error();
        m_irradiance = std::move(solution->irradiance);
        return {};
    }
    [[nodiscard]] double residual(const JobContext&) const override { return 0.0; }
    [[nodiscard]] std::vector<glm::dvec3> irradiance() const override { return m_irradiance; }
    [[nodiscard]] std::uint64_t iterations() const override { return 1; }

  private:
    const Problem& m_problem;
    const FactorMatrix& m_factors;
    std::vector<glm::dvec3> m_irradiance;
};

} // namespace

std::unique_ptr<SourceSolver> makeSourceSolver(const SolveSettings& settings,
                                               const Problem& problem,
                                               const FactorMatrix& factors) {
    if (shoots(settings.solver))
        return std::make_unique<ShootingSolver>(problem, factors, settings);
    if (settings.solver == Solver::Direct)
        return std::make_unique<DirectSolver>(problem, factors);
    return std::make_unique<SweepingSolver>(
        problem, factors, settings.solver == Solver::Jacobi ? Sweep::Jacobi : Sweep::GaussSeidel);
}

} // namespace patina
