#include "app/editor/radiosity/RadiosityUpdater.h"

#include "app/editor/document/DocumentController.h"
#include "core/base/Log.h"
#include "core/edit/Change.h"
#include "core/radiosity/document/KeptRadiosity.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <QFile>
#include <QMetaObject>
#include <QStandardPaths>
#include <chrono>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kGeometryPauseMs = 150;     // without an edit until elements are worth their time
constexpr int kRadiosityPatienceMs = 300; // what is done sooner is not worth a word
// Without another solution until one is written to disk: one that a slider passes by is not.
constexpr int kRadiosityKeepMs = 1000;

struct Solving {
    LiveRadiosityPtr live;
    ShownRadiosityPtr shown;
    double seconds = 0.0;
};

} // namespace

std::filesystem::path radiosityCacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "radiosity";
}

RadiosityUpdater::RadiosityUpdater(DocumentController& controller,
                                   std::filesystem::path cacheFolder, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_cache(std::move(cacheFolder))
    , m_tasks(controller.runner()) {
    m_pause.setSingleShot(true);
    m_pause.setInterval(kGeometryPauseMs);
    connect(&m_pause, &QTimer::timeout, this, &RadiosityUpdater::run);
    m_patience.setSingleShot(true);
    m_patience.setInterval(kRadiosityPatienceMs);
    connect(&m_patience, &QTimer::timeout, this, &RadiosityUpdater::activityChanged);
    m_keepPause.setSingleShot(true);
    m_keepPause.setInterval(kRadiosityKeepMs);
    connect(&m_keepPause, &QTimer::timeout, this, &RadiosityUpdater::keep);
    connect(&controller, &DocumentController::changed, this, &RadiosityUpdater::follow);
}

void RadiosityUpdater::shutDown() {
    if (m_keepPause.isActive())
        keep();
}

QString RadiosityUpdater::activity() const {
    if (m_patience.isActive())
        return {};
    return solving()          ? tr("Solving radiosity")
           : findingFactors() ? tr("Computing form factors")
                              : QString();
}

bool RadiosityUpdater::upToDate() const {
    return !m_outdated && !m_pause.isActive() && !m_tasks.busy() &&
           (!m_failure.isEmpty() || (m_live && m_live->solved));
}

bool RadiosityUpdater::isOnItsWay() const {
    return solving() || m_pause.isActive() || m_tasks.busy(kStepTag) || m_tasks.busy(kShowTag);
}

void RadiosityUpdater::setWanted(bool wanted) {
    if (wanted == m_wanted)
        return;
    m_wanted = wanted;
    if (m_wanted && m_outdated)
        update();
    Q_EMIT changed();
}

void RadiosityUpdater::follow(const Change& change) {
    if (change.affects == Affects::Nothing)
        return;
    if (change.isAnotherDocument())
        forget();
    m_outdated = true;
    if (m_wanted)
        update();
}

void RadiosityUpdater::forget() {
    if (m_keepPause.isActive())
        keep();
    m_tasks.cancelAll();
    m_pause.stop();
    m_patience.stop();
    m_known = m_stopped = false;
    m_live = nullptr;
    m_leaks = nullptr;
    m_convergence = nullptr;
    m_failure.clear();
    m_factorsFailure.clear();
    m_steps = nullptr;
    m_step = nullptr;
    m_stepGoal.reset();
    m_chosen.reset();
    m_inputs = {};
    if (m_shown) {
        m_shown = nullptr;
        Q_EMIT shownChanged();
    }
    Q_EMIT activityChanged();
    Q_EMIT changed();
}

void RadiosityUpdater::update() {
    m_outdated = false;
    const Document& document = m_controller.document();
    TraceInputs inputs = traceInputs(document);
    RadiositySettings settings = radiositySettings(document.view);
    settings.maxElements = kMaxElements;
    if (m_known && inputs == m_inputs && settings == m_settings)
        return; // of what it rests on nothing was edited
    const bool otherShape = m_known && (inputs.meshes != m_inputs.meshes);
    m_inputs = std::move(inputs);
    m_settings = settings;
    m_known = true;
    endSteps();
    if (m_stopped) {
        Q_EMIT changed();
        return;
    }
    // Elements of geometry that is being moved are in vain.
    if (otherShape && m_live) {
        m_tasks.cancel(kSolveTag);
        m_pause.start();
    } else if (!m_pause.isActive()) {
        run();
    }
}

void RadiosityUpdater::solve() {
    m_stopped = false;
    m_known = false;
    m_outdated = true;
    if (m_wanted)
        update();
    Q_EMIT changed();
}

void RadiosityUpdater::stop() {
    m_stopped = true;
    m_pause.stop();
    m_tasks.cancel(kSolveTag);
    m_tasks.cancel(kFactorsTag);
    m_patience.stop();
    Q_EMIT activityChanged();
    Q_EMIT changed();
}

void RadiosityUpdater::run() {
    m_pause.stop();
    m_tasks.cancel(kFactorsTag); // the edit goes first, and needs them or begins them again
    if (!solving())
        m_patience.start();
    m_tasks.run(
        {.tag = kSolveTag, .policy = TaskPolicy::Follow, .priority = TaskPriority::Low},
        [this, inputs = m_inputs, settings = m_settings, before = m_live, cache = m_cache,
         expects = whoExpects()](const JobContext& job) -> Result<Solving> {
            const auto begin = std::chrono::steady_clock::now();
            // The group ends before this object does, and calls that are posted end with it.
            const auto tell = [this, &job](const LiveRadiosityPtr& live) {
                const ShownRadiosityPtr shown = shownRadiosity(*live, live->solution);
                if (!job.cancelled())
                    QMetaObject::invokeMethod(
                        this,
                        [this, live, shown] {
                            if (solving() && m_live != live)
                                take(live, shown);
                        },
                        Qt::QueuedConnection);
            };
            Result<LiveRadiosityPtr> live =
                followRadiosity(inputs, settings, before, job, tell,
                                {.cache = &cache, .factors = false, .expects = expects});
            if (!live)
                return live.error();
            Solving solved{*live, shownRadiosity(**live, (*live)->solution), 0.0};
            solved.seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            return solved;
        },
        [this](const Result<Solving>& solved) {
            if (solved) {
                m_seconds = solved->seconds;
                m_failure.clear();
                take(solved->live, solved->shown);
                if (m_chosen)
                    show(); // with the form factors of the chosen element
                m_factorsFailure.clear();
                if (m_live->solved)
                    m_keepPause.start(); // anew
                if (!solving() && !m_stopped)
                    findFactors();
            } else if (solved.error().kind != ErrorKind::Cancelled) {
                refuse(solved.error());
            }
            if (!solving() && !findingFactors())
                m_patience.stop();
            Q_EMIT activityChanged();
            Q_EMIT changed();
        });
    Q_EMIT changed();
}

// The group ends before this object does, and calls that are posted end with it.
std::function<void(double)> RadiosityUpdater::whoExpects() {
    m_expectedSeconds = 0.0;
    return [this](double seconds) {
        QMetaObject::invokeMethod(
            this,
            [this, seconds] {
                m_expectedSeconds = seconds;
                Q_EMIT changed();
            },
            Qt::QueuedConnection);
    };
}

// What was found in the cache has none. In a task of its own, so that no edit waits for it.
void RadiosityUpdater::findFactors() {
    if (!m_live->solved || m_live->hasFactors())
        return;
    m_patience.start();
    m_tasks.run(
        {.tag = kFactorsTag, .policy = TaskPolicy::Newest, .priority = TaskPriority::Low},
        [live = m_live, expects = whoExpects()](const JobContext& job) {
            return followRadiosity(live->inputs, live->settings, live, job, {},
                                   {.expects = expects});
        },
        [this, before = m_live](const Result<LiveRadiosityPtr>& live) {
            if (m_live != before)
                return;
            if (live) {
                m_live = *live; // the same light: what is known of it stays
                if (findingLeaks())
                    findLeaks();
                if (m_chosen || m_tasks.busy(kShowTag))
                    show();
            } else if (live.error().kind != ErrorKind::Cancelled) {
                m_factorsFailure = QString::fromStdString(live.error().message);
            }
            m_patience.stop();
            Q_EMIT activityChanged();
            Q_EMIT changed();
        });
}

// Where no newer solution has come for a while. A solution that is replaced sooner is not kept, nor
// is one that was stopped; the end of the document or of the session does not wait.
void RadiosityUpdater::keep() {
    m_keepPause.stop();
    if (!m_live || !m_live->solved)
        return;
    m_tasks.run(
        {.tag = kKeepTag, .policy = TaskPolicy::Exclusive, .priority = TaskPriority::Low},
        [live = m_live, cache = m_cache](const JobContext&) { return keepRadiosity(*live, cache); },
        [this](const Result<void>& kept) {
            if (!kept && !m_keepWarned)
                logWarning("Solved radiosity is not kept for the next time: {}",
                           kept.error().text());
            m_keepWarned = m_keepWarned || !kept;
        });
}

void RadiosityUpdater::take(const LiveRadiosityPtr& live, const ShownRadiosityPtr& shown) {
    if (m_chosen && (!m_live || m_live->shape != live->shape))
        m_chosen.reset(); // another element has its number
    if (m_live != live) {
        m_tasks.cancel(kLeaksTag);
        m_leaks = nullptr;
        m_convergence = nullptr;
    }
    m_live = live;
    m_shown = shown;
    Q_EMIT shownChanged();
    Q_EMIT changed();
}

void RadiosityUpdater::refuse(const Error& error) {
    m_failure = QString::fromStdString(error.message);
    m_live = nullptr;
    m_leaks = nullptr;
    m_convergence = nullptr;
    m_chosen.reset();
    m_shown = nullptr;
    Q_EMIT shownChanged();
    UserNotice notice = UserNotice::fromError(error);
    notice.kind = NoticeKind::Warning;
    notice.text = tr("Radiosity was not solved: %1").arg(notice.text);
    Q_EMIT m_controller.noticed(notice);
}

// --- Step by step --------------------------------------------------------------------------------

void RadiosityUpdater::goTo(std::uint64_t steps) {
    if (!canStep())
        return;
    m_stepGoal = steps;
    struct Stepped {
        std::shared_ptr<RadiositySteps> steps;
        std::shared_ptr<const Step> step;
        ShownRadiosityPtr shown;
    };
    m_tasks.run(
        {.tag = kStepTag, .policy = TaskPolicy::Follow, .priority = TaskPriority::High},
        [live = m_live, known = m_steps, unit = stepUnit(), steps,
         chosen = m_chosen](const JobContext& job) {
            Stepped result;
            result.steps = known ? known : std::make_shared<RadiositySteps>(live, unit);
            result.steps->goTo(steps, job);
            auto step = std::make_shared<Step>();
            step->unit = result.steps->unit();
            step->done = result.steps->done();
            step->perRound = result.steps->stepsPerRound();
            step->atEnd = result.steps->atEnd();
            step->last = result.steps->last();
            step->next = result.steps->next();
            step->energy = result.steps->energy();
            step->residuals = result.steps->residuals();
            step->solution = result.steps->solution();
            result.shown = shownRadiosity(*live, step->solution, result.steps->unshot(), chosen);
            result.step = std::move(step);
            return result;
        },
        [this, steps](const Result<Stepped>& stepped) {
            if (m_stepGoal == steps)
                m_stepGoal.reset();
            if (!stepped || stepped->steps->live() != m_live ||
                stepped->steps->unit() != stepUnit())
                return;
            m_steps = stepped->steps;
            m_step = stepped->step;
            m_shown = stepped->shown;
            Q_EMIT shownChanged();
            Q_EMIT changed();
        });
}

std::uint64_t RadiosityUpdater::stepGoal() const {
    return m_stepGoal ? *m_stepGoal : m_step ? m_step->done : 0;
}

void RadiosityUpdater::endSteps() {
    m_tasks.cancel(kStepTag);
    m_stepGoal.reset();
    if (!m_step)
        return;
    m_steps = nullptr;
    m_step = nullptr;
    show();
    Q_EMIT changed();
}

RadiosityStep RadiosityUpdater::stepUnit() const {
    const bool patches = m_live && !m_live->elements().patches().empty();
    return patches ? RadiosityStep::Shot : m_stepUnit;
}

void RadiosityUpdater::setStepUnit(RadiosityStep unit) {
    if (unit == m_stepUnit)
        return;
    m_stepUnit = unit;
    endSteps();
    m_steps = nullptr;
    Q_EMIT changed();
}

void RadiosityUpdater::findConvergence() {
    if (!canStep() || m_convergence || m_tasks.busy(kConvergenceTag))
        return;
    m_tasks.run(
        {.tag = kConvergenceTag, .policy = TaskPolicy::Newest, .priority = TaskPriority::Low},
        [live = m_live](const JobContext& job) { return patina::convergence(*live, job); },
        [this, live = m_live](const Result<Convergence>& found) {
            if (!found || live != m_live)
                return;
            m_convergence = std::make_shared<const Convergence>(*found);
            Q_EMIT changed();
        });
}

// --- A chosen element ----------------------------------------------------------------------------

const radiosity::Solution* RadiosityUpdater::solution() const {
    return m_step ? &m_step->solution : m_live ? &m_live->solution : nullptr;
}

void RadiosityUpdater::choose(std::optional<std::uint32_t> element) {
    if (!m_live || element == m_chosen)
        return;
    m_chosen = element;
    show();
    Q_EMIT changed();
}

void RadiosityUpdater::lookAtFactors() {
    if (m_chosen || !m_live || !m_live->solved)
        return;
    std::uint32_t most = 0;
    double power = -1.0;
    for (std::uint32_t e = 0; e < m_live->elements().size(); ++e) {
        const glm::dvec3 sent =
            m_live->elements().area(e) * m_live->lit.radiosity(m_live->solution, e);
        if (const double sum = sent.x + sent.y + sent.z; sum > power) {
            power = sum;
            most = e;
        }
    }
    choose(most);
}

void RadiosityUpdater::findLeaks() {
    if (!m_live || !m_live->solved)
        return;
    m_tasks.run(
        {.tag = kLeaksTag, .policy = TaskPolicy::Newest, .priority = TaskPriority::Low},
        [live = m_live](const JobContext& job) { return findLeaksAndSeams(*live, job); },
        [this, live = m_live](const Result<LeaksAndSeams>& found) {
            if (found && live == m_live)
                m_leaks = std::make_shared<const LeaksAndSeams>(*found);
            else if (!found && found.error().kind != ErrorKind::Cancelled)
                Q_EMIT m_controller.noticed(UserNotice::fromError(found.error()));
            Q_EMIT changed();
        });
    Q_EMIT changed();
}

// What there is once more, from the chosen element.
void RadiosityUpdater::show() {
    if (!m_live)
        return;
    if (m_step) {
        goTo(stepGoal()); // which clicks may be ahead of
        return;
    }
    m_tasks.run(
        {.tag = kShowTag, .policy = TaskPolicy::Newest, .priority = TaskPriority::High},
        [live = m_live, chosen = m_chosen](const JobContext&) {
            return shownRadiosity(*live, live->solution, {}, chosen);
        },
        [this, live = m_live](const Result<ShownRadiosityPtr>& shown) {
            if (!shown || live != m_live || m_step)
                return;
            m_shown = *shown;
            Q_EMIT shownChanged();
        });
}

} // namespace patina::editor
