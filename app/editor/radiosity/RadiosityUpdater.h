// Keeps the radiosity of the document solved while somebody looks at it: in the background, the
// newest edit first, with pictures on the way. What was solved in an earlier session, or before an
// undo, is found in a cache; the form factors follow after it is shown. And the ways to look into
// it: step by step, and from a chosen element.
#pragma once

#include "core/job/TaskRunner.h"
#include "core/radiosity/document/Convergence.h"
#include "core/radiosity/document/EnergyFlow.h"
#include "core/radiosity/document/LeaksAndSeams.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/radiosity/document/RadiositySteps.h"
#include "core/radiosity/file/SolutionCache.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;

// Solutions outlive the session; the system may empty this folder at any time.
[[nodiscard]] std::filesystem::path radiosityCacheFolder();

class RadiosityUpdater : public QObject {
    Q_OBJECT
  public:
    // Elements that a scene may have here; more take the command line.
    static constexpr std::size_t kMaxElements = 262'144;

    RadiosityUpdater(DocumentController& controller, std::filesystem::path cacheFolder,
                     QObject* parent = nullptr);
    // Keeps what was solved and is not kept yet. Before the end of the runner.
    void shutDown();

    // Whether a picture is lit by it: else nothing is solved.
    void setWanted(bool wanted);
    [[nodiscard]] bool isWanted() const { return m_wanted; }
    // What is to be drawn; null: nothing is solved yet.
    [[nodiscard]] const ShownRadiosityPtr& shown() const { return m_shown; }
    // The newest solution, which may be on its way; null: none.
    [[nodiscard]] const LiveRadiosityPtr& live() const { return m_live; }
    [[nodiscard]] bool solving() const { return m_tasks.busy(kSolveTag); }
    // Form factors of a solution that was found, or the links of its clusters, are being computed.
    [[nodiscard]] bool findingFactors() const { return m_tasks.busy(kFactorsTag); }
    // How long those that are being computed will take, s; 0: nothing is known of it.
    [[nodiscard]] double expectedSeconds() const { return m_expectedSeconds; }
    // Why there are none; or empty.
    [[nodiscard]] QString factorsFailure() const { return m_factorsFailure; }
    // A solution is on its way into the cache, or will be once edits pause.
    [[nodiscard]] bool keeping() const { return m_keepPause.isActive() || m_tasks.busy(kKeepTag); }
    // The document's solution is shown, with its form factors, or there is none to be had.
    [[nodiscard]] bool upToDate() const;
    // Something is under way after which shown() is another.
    [[nodiscard]] bool isOnItsWay() const;
    [[nodiscard]] QString activity() const; // for the status bar; empty unless it takes a while
    [[nodiscard]] QString failure() const { return m_failure; } // why there is none; or empty
    [[nodiscard]] double seconds() const { return m_seconds; }  // that the last one took

    // What has been solved stays, and edits wait until solve().
    void stop();
    [[nodiscard]] bool stopped() const { return m_stopped; }
    void solve();

    // --- Step by step ----------------------------------------------------------------------------
    // Where shooting or gathering is after some steps, in place of the solution, until endSteps()
    // or an edit.
    struct Step {
        RadiosityStep unit = RadiosityStep::Shot;
        std::uint64_t done = 0, perRound = 0;
        bool atEnd = false;
        std::optional<std::uint32_t> last, next; // senders: elements or patches
        std::optional<radiosity::Shooting::Energy> energy;
        std::vector<double> residuals; // after each step
        radiosity::Solution solution;
    };
    [[nodiscard]] bool canStep() const { return m_live && m_live->solved && m_live->factors; }
    [[nodiscard]] const std::shared_ptr<const Step>& step() const { return m_step; } // or null
    void goTo(std::uint64_t steps);
    // Where goTo() is on its way to, else where it is: clicks count, however fast they come.
    [[nodiscard]] std::uint64_t stepGoal() const;
    void endSteps();
    // Of the steps from now on; those that are shown end.
    void setStepUnit(RadiosityStep unit);
    // Of patches always shots.
    [[nodiscard]] RadiosityStep stepUnit() const;

    // How fast the solvers come to the newest solution, found in the background; null: not looked
    // for yet, or nothing to step through. It goes with the solution.
    void findConvergence();
    using Convergence = std::vector<ConvergenceCurve>;
    [[nodiscard]] const std::shared_ptr<const Convergence>& convergence() const {
        return m_convergence;
    }

    // --- A chosen element ------------------------------------------------------------------------
    void choose(std::optional<std::uint32_t> element);
    [[nodiscard]] std::optional<std::uint32_t> chosen() const { return m_chosen; }
    // Form factors are looked at: those of an element. Where none is chosen it is the one that
    // sends most.
    void lookAtFactors();
    // Leaks and seams of the newest solution, found in the background; null: not looked for yet.
    // They go with the solution.
    void findLeaks();
    [[nodiscard]] const std::shared_ptr<const LeaksAndSeams>& leaks() const { return m_leaks; }
    [[nodiscard]] bool findingLeaks() const { return m_tasks.busy(kLeaksTag); }
    // Of what is shown: the solution, or the step.
    [[nodiscard]] const radiosity::Solution* solution() const;

  Q_SIGNALS:
    void shownChanged();    // shown() is another
    void changed();         // anything else
    void activityChanged(); // activity() may be another

  private:
    static constexpr const char* kSolveTag = "radiosity";
    static constexpr const char* kFactorsTag = "radiosity form factors";
    static constexpr const char* kKeepTag = "keeping radiosity";
    static constexpr const char* kStepTag = "radiosity steps";
    static constexpr const char* kShowTag = "radiosity shown";
    static constexpr const char* kLeaksTag = "radiosity leaks";
    static constexpr const char* kConvergenceTag = "radiosity convergence";
    void follow(const Change& change);
    void update();
    void run();
    void take(const LiveRadiosityPtr& live, const ShownRadiosityPtr& shown);
    void refuse(const Error& error);
    void findFactors();
    void keep();
    void show();
    void forget();
    // Of followRadiosity(), on its thread.
    [[nodiscard]] std::function<void(double)> whoExpects();

    DocumentController& m_controller;
    const radiosity::SolutionCache m_cache;
    QTimer m_pause;     // of edits to geometry, before elements are made anew
    QTimer m_patience;  // until the status bar says what goes on
    QTimer m_keepPause; // active: the solution is still to be kept
    bool m_keepWarned = false;
    bool m_wanted = false, m_stopped = false, m_outdated = true;
    TraceInputs m_inputs; // of what is solved, or was refused …
    RadiositySettings m_settings;
    bool m_known = false; // … whether there is such a thing
    LiveRadiosityPtr m_live;
    ShownRadiosityPtr m_shown;
    QString m_failure, m_factorsFailure;
    double m_seconds = 0.0, m_expectedSeconds = 0.0;
    std::shared_ptr<RadiositySteps> m_steps; // of the steps' task alone
    std::shared_ptr<const Step> m_step;
    std::optional<std::uint64_t> m_stepGoal; // while goTo() is on its way
    std::optional<std::uint32_t> m_chosen;
    RadiosityStep m_stepUnit = RadiosityStep::Shot;
    std::shared_ptr<const LeaksAndSeams> m_leaks;     // of m_live
    std::shared_ptr<const Convergence> m_convergence; // of m_live
    TaskGroup m_tasks;                                // last: it ends first
};

} // namespace patina::editor
