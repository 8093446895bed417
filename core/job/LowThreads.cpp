#include "core/job/LowThreads.h"

#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace patina {

LowThreads::~LowThreads() {
    {
        const std::lock_guard lock(m_mutex);
        m_closing = true;
    }
    m_begun.notify_all();
    for (std::thread& thread : m_threads)
        thread.join();
}

void LowThreads::run(int others, const std::function<void()>& work) {
    Loop loop{&work, others, 0, nullptr};
    std::unique_lock lock(m_mutex);
    m_loops.push_back(&loop);
    const int most = std::max(threadCount() - 1, others);
    for (int missing = others - m_idle; missing > 0 && static_cast<int>(m_threads.size()) < most;
         --missing) {
        try {
            m_threads.emplace_back([this] { serve(); });
        } catch (const std::system_error& error) {
            logWarning("no thread could be started: {}", error.what());
            break; // those that are there do it
        }
    }
    lock.unlock();
    m_begun.notify_all();

    std::exception_ptr error;
    try {
        work();
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    m_loops.remove(&loop);
    m_ended.wait(lock, [&] { return loop.inside == 0; });
    if (!error)
        error = loop.error;
    lock.unlock();
    if (error)
        std::rethrow_exception(error);
}

LowThreads::Loop* LowThreads::next() {
    const auto free =
        std::ranges::find_if(m_loops, [](const Loop* loop) { return loop->places > 0; });
    return free == m_loops.end() ? nullptr : *free;
}

void LowThreads::serve() {
    lowerThreadPriority();
    std::unique_lock lock(m_mutex);
    while (true) {
        ++m_idle;
        m_begun.wait(lock, [this] { return m_closing || next() != nullptr; });
        --m_idle;
        if (m_closing)
            return;
        Loop& loop = *next();
        --loop.places;
        ++loop.inside;
        lock.unlock();
        std::exception_ptr error;
        try {
            (*loop.work)();
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        loop.places = 0; // nothing is left to do
        if (error)
            loop.error = std::move(error);
        --loop.inside;
        m_ended.notify_all();
    }
}

} // namespace patina
