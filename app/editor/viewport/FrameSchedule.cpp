#include "app/editor/viewport/FrameSchedule.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace patina::editor {
namespace {

// Between two frames of an animation, however short they are: what moves is seen to move.
constexpr int kMostPieces = 16;

} // namespace

// --- Task ----------------------------------------------------------------------------------------

FrameSchedule::Task::Task(FrameSchedule& schedule, std::function<void()> piece)
    : m_schedule(&schedule)
    , m_piece(std::move(piece)) {
    m_schedule->m_tasks.push_back(this);
}

FrameSchedule::Task::~Task() {
    if (m_schedule != nullptr)
        std::erase(m_schedule->m_tasks, this);
}

void FrameSchedule::Task::want(double afterMs) {
    if (m_schedule == nullptr)
        return;
    m_due = m_schedule->now() + afterMs;
    m_schedule->wake();
}

void FrameSchedule::Task::drop() {
    m_due.reset();
}

// --- Animation -----------------------------------------------------------------------------------

FrameSchedule::Animation::Animation(FrameSchedule& schedule, double paceMs,
                                    std::function<bool()> step)
    : m_schedule(&schedule)
    , m_paceMs(paceMs)
    , m_step(std::move(step)) {
    m_schedule->m_animations.push_back(this);
}

FrameSchedule::Animation::~Animation() {
    if (m_schedule != nullptr)
        std::erase(m_schedule->m_animations, this);
}

void FrameSchedule::Animation::start() {
    if (m_schedule == nullptr || m_due)
        return;
    m_due = m_schedule->now() + m_paceMs;
    m_schedule->wake();
}

void FrameSchedule::Animation::stop() {
    m_due.reset();
}

// --- Turns ---------------------------------------------------------------------------------------

FrameSchedule::~FrameSchedule() {
    const auto letGo = [](const auto& entries) {
        for (auto* entry : entries) {
            entry->m_schedule = nullptr;
            entry->m_due.reset();
        }
    };
    letGo(m_tasks);
    letGo(m_animations);
}

void FrameSchedule::setClock(Clock clock) {
    m_clock = std::move(clock);
    wake();
}

double FrameSchedule::now() const {
    if (m_clock)
        return m_clock();
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(since).count();
}

void FrameSchedule::setAlarm(std::function<void()> alarm) {
    m_alarm = std::move(alarm);
    wake();
}

void FrameSchedule::wake() {
    if (m_alarm)
        m_alarm();
}

bool FrameSchedule::isDue(const std::optional<double>& due) const {
    return due && *due <= now();
}

std::optional<double> FrameSchedule::untilTurn() const {
    std::optional<double> first;
    const auto consider = [&](const auto& entries) {
        for (const auto* entry : entries)
            if (entry->m_due && (!first || *entry->m_due < *first))
                first = entry->m_due;
    };
    consider(m_tasks);
    consider(m_animations);
    return first ? std::optional(std::max(0.0, *first - now())) : std::nullopt;
}

// Each in its turn: what is always due leaves the others theirs.
FrameSchedule::Task* FrameSchedule::nextTask() const {
    for (std::size_t i = 0; i < m_tasks.size(); ++i)
        if (Task* task = m_tasks[(m_turn + i) % m_tasks.size()]; isDue(task->m_due))
            return task;
    return nullptr;
}

void FrameSchedule::run(Task& task) {
    m_turn = static_cast<std::size_t>(std::ranges::find(m_tasks, &task) - m_tasks.begin()) + 1;
    task.m_due.reset();
    ++m_pieces;
    const double before = now();
    task.m_piece(); // which may end the task
    m_owedMs -= now() - before;
}

// False: nothing has moved.
bool FrameSchedule::stepAnimations() {
    bool moved = false;
    const std::vector<Animation*> all = m_animations; // a step may end others, but destroys none
    for (Animation* animation : all) {
        if (!isDue(animation->m_due))
            continue;
        animation->m_due = now() + animation->m_paceMs;
        if (!animation->m_step())
            continue;
        animation->m_due.reset();
        moved = true;
    }
    return moved;
}

void FrameSchedule::turn() {
    // What has come while the frame was painted; never twice, or frames that follow each other
    // would have all turns.
    m_letInput = std::exchange(m_inputFirst, false) && !m_letInput;
    if (m_letInput) {
        wake();
        return;
    }
    const bool workIsOwed = nextTask() != nullptr && m_owedMs > 0.0 && m_pieces < kMostPieces;
    if (workIsOwed || !stepAnimations())
        if (Task* task = nextTask()) // a step may have dropped the one before
            run(*task);
    wake();
}

void FrameSchedule::framePainted(double milliseconds) {
    m_owedMs = milliseconds;
    m_pieces = 0;
    m_inputFirst = true;
}

} // namespace patina::editor
