#include "app/editor/viewport/ProgramWarmer.h"

#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <QMetaObject>
#include <algorithm>
#include <ctime>

namespace patina::editor {
namespace {

using render::FrameKind;
using render::SurfaceOutput;

// Of the calling thread, where drivers compile: other programs do not disturb the measurement.
double threadMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Nothing but compiling makes a small sheet this slow: on llvmpipe it takes some 100 ms of the
// thread when all is found on disk, 3,000 to 10,000 ms when it is not.
constexpr double kCompilingMs = 600.0;

// Milliseconds of drawing such frames in a context of its own, which is gone afterwards: only then
// everything lies in the cache.
Result<double> warmUp(const Document& document, const FrameKind& frame, const JobContext& job) {
    auto context = gl::Context::createHeadless();
    if (!context)
        return context.error();
    auto made = render::WarmUp::create(**context, document);
    if (!made)
        return made.error();
    const double start = threadMs();
    if (auto done = made->draw(frame, job); !done)
        return done.error();
    return threadMs() - start;
}

} // namespace

ProgramWarmer::ProgramWarmer(QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(1); // a cancelled task ends with the program it compiles
    m_idlePool.setMaxThreadCount(1);
}

ProgramWarmer::~ProgramWarmer() {
    m_control.cancel();
    m_pool.waitForDone();
    m_idlePool.waitForDone();
}

ProgramWarmer::Programs ProgramWarmer::missing(const Document& document,
                                               const FrameKind& frame) const {
    Programs programs;
    if (!m_useless)
        for (const auto& [program, mesh] : render::surfacePrograms(document, frame))
            if (!m_known.contains(program))
                programs.insert(program);
    return programs;
}

bool ProgramWarmer::knows(const Document& document, const FrameKind& frame) const {
    return missing(document, frame).empty();
}

void ProgramWarmer::learn(const Document& document, const FrameKind& frame) {
    m_known.merge(missing(document, frame));
}

void ProgramWarmer::request(const Document& document, const std::vector<FrameKind>& frames,
                            Urgency urgency) {
    Task task{document, {}, !m_verified};
    Programs all;
    for (const FrameKind& frame : frames)
        if (Programs programs = missing(document, frame); !programs.empty()) {
            all.insert(programs.begin(), programs.end());
            task.frames.emplace_back(frame, std::move(programs));
        }
    const bool coming = m_running && m_urgency >= urgency &&
                        std::includes(m_underWay.begin(), m_underWay.end(), all.begin(), all.end());
    if (all.empty() || coming)
        return;
    m_control.cancel();
    m_control = JobControl();
    m_running = true;
    m_urgency = urgency;
    m_underWay = std::move(all);
    const quint64 id = ++m_id;
    const bool idle = urgency == Urgency::Idle;
    (idle ? m_idlePool : m_pool)
        .start([this, id, idle, task = std::move(task), job = m_control.context()] {
            if (idle)
                lowerThreadPriority();
            work(id, task, job);
        });
}

template <class Apply>
void ProgramWarmer::post(quint64 id, Apply apply) {
    // The destructor waits for the pools, so `this` is alive.
    QMetaObject::invokeMethod(
        this,
        [this, id, apply = std::move(apply)]() mutable {
            if (id == m_id)
                apply();
        },
        Qt::QueuedConnection);
}

void ProgramWarmer::work(quint64 id, const Task& task, const JobContext& job) {
    if (job.cancelled())
        return;
    const Result<void> done = warm(id, task, job);
    post(id, [this, done] {
        if (!done && done.error().kind != ErrorKind::Cancelled) {
            logWarning("Shaders cannot be compiled in the background: {}", done.error().text());
            m_useless = true;
            Q_EMIT progressed();
        }
        m_running = false;
        Q_EMIT finished();
    });
}

Result<void> ProgramWarmer::warm(quint64 id, const Task& task, const JobContext& job) {
    double sheetMs = 0.0;
    FrameKind sheet;
    for (const auto& [frame, programs] : task.frames) {
        const auto ms = warmUp(task.document, frame, job);
        if (!ms)
            return ms.error();
        // The one that took longest: lighting modes share programs, and one that finds most of its
        // own compiled would tell nothing.
        if (frame.output == SurfaceOutput::EightViews && *ms > sheetMs) {
            sheet = frame;
            sheetMs = *ms;
        }
        post(id, [this, known = programs] {
            m_known.insert(known.begin(), known.end());
            Q_EMIT progressed();
        });
    }
    if (!task.verify || sheetMs < kCompilingMs)
        return {};
    // What was compiled just now should be found by whoever comes next.
    const auto ms = warmUp(task.document, sheet, job);
    if (!ms)
        return ms.error();
    if (*ms > std::max(0.5 * sheetMs, kCompilingMs))
        return Error{ErrorKind::CannotCreate,
                     "the graphics driver keeps no compiled shaders on disk, so that the first "
                     "frame of a new view, light or model takes a moment. For Mesa, see "
                     "MESA_SHADER_CACHE_DIR and MESA_SHADER_CACHE_DISABLE.",
                     {},
                     {}};
    post(id, [this] { m_verified = true; });
    return {};
}

} // namespace patina::editor
