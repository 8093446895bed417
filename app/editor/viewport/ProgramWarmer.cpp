#include "app/editor/viewport/ProgramWarmer.h"

#include "core/base/Log.h"

#include <algorithm>
#include <ctime>

namespace patina::editor {
namespace {

using render::FrameKind;
using render::SurfaceOutput;

// Of the calling thread, where drivers compile: other programs do not disturb the measurement.
double compilerMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Nothing but compiling makes a small sheet this slow: on llvmpipe it takes some 100 ms of the
// thread when all is found on disk, 3,000 to 10,000 ms when it is not.
constexpr double kCompilingMs = 600.0;

// Milliseconds of drawing such frames in a context of its own, which is gone afterwards: only then
// everything lies in the cache.
Result<double> warmUp(const Document& document, const FrameKind& frame, const std::string& renderer,
                      const JobContext& job) {
    auto context = gl::Context::createHeadless(renderer);
    if (!context)
        return context.error();
    auto made = render::WarmUp::create(**context, document);
    if (!made)
        return made.error();
    const double start = compilerMs();
    if (auto done = made->draw(frame, job); !done)
        return done.error();
    return compilerMs() - start;
}

} // namespace

ProgramWarmer::ProgramWarmer(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {}

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
    Programs all;
    std::deque<std::pair<FrameKind, Programs>> wanted;
    for (const FrameKind& frame : frames)
        if (Programs programs = missing(document, frame); !programs.empty()) {
            all.insert(programs.begin(), programs.end());
            wanted.emplace_back(frame, std::move(programs));
        }
    const bool coming = m_running && m_urgency >= urgency &&
                        std::includes(m_underWay.begin(), m_underWay.end(), all.begin(), all.end());
    if (all.empty() || coming)
        return;
    m_tasks.cancelAll();
    m_running = true;
    m_urgency = urgency;
    m_underWay = std::move(all);
    m_document = std::make_shared<const Document>(document);
    m_frames = std::move(wanted);
    m_slowestMs = 0.0;
    compileNext();
}

// What was cancelled ends with the program it compiles; the next of this urgency waits for it.
void ProgramWarmer::compile(const FrameKind& frame, std::function<void(double)> then) {
    const bool idle = m_urgency == Urgency::Idle;
    m_tasks.run(
        {.tag = idle ? "compiling shaders ahead" : "compiling shaders",
         .policy = TaskPolicy::Follow,
         .priority = idle ? TaskPriority::Low : TaskPriority::High},
        [document = m_document, frame, renderer = m_renderer](const JobContext& job) {
            return warmUp(*document, frame, renderer, job);
        },
        [this, then = std::move(then)](const Result<double>& milliseconds) {
            if (milliseconds)
                then(*milliseconds);
            else
                end(milliseconds.error());
        });
}

void ProgramWarmer::compileNext() {
    if (m_frames.empty()) {
        verify();
        return;
    }
    const auto [frame, programs] = std::move(m_frames.front());
    m_frames.pop_front();
    compile(frame, [this, frame = frame, programs = programs](double milliseconds) {
        compiled(frame, programs, milliseconds);
    });
}

void ProgramWarmer::compiled(const FrameKind& frame, const Programs& programs,
                             double milliseconds) {
    if (frame.output == SurfaceOutput::EightViews && milliseconds > m_slowestMs) {
        m_slowest = frame;
        m_slowestMs = milliseconds;
    }
    m_known.insert(programs.begin(), programs.end());
    compileNext(); // before others are told, who may ask for something else
    Q_EMIT progressed();
}

void ProgramWarmer::verify() {
    if (m_verified || m_slowestMs < kCompilingMs) {
        end(std::nullopt);
        return;
    }
    // What was compiled just now should be found by whoever comes next.
    compile(m_slowest, [this](double milliseconds) {
        if (milliseconds > std::max(0.5 * m_slowestMs, kCompilingMs)) {
            end(Error{ErrorKind::CannotCreate,
                      "the graphics driver keeps no compiled shaders on disk, so that the first "
                      "frame of a new view, light or model takes a moment. For Mesa, see "
                      "MESA_SHADER_CACHE_DIR and MESA_SHADER_CACHE_DISABLE.",
                      {},
                      {}});
            return;
        }
        m_verified = true;
        end(std::nullopt);
    });
}

void ProgramWarmer::end(const std::optional<Error>& error) {
    m_frames.clear();
    m_document.reset();
    if (error && error->kind != ErrorKind::Cancelled) {
        logWarning("Shaders cannot be compiled in the background: {}", error->text());
        m_useless = true;
        Q_EMIT progressed();
    }
    m_running = false;
    Q_EMIT finished();
}

} // namespace patina::editor
