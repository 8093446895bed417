#include "app/editor/TerminationWatch.h"

#include "core/base/FileNaming.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <utility>

namespace patina::editor {
namespace {

constexpr std::array<int, 3> kSignals{SIGTERM, SIGHUP, SIGINT};
constexpr std::chrono::milliseconds kNamingPatience{300};
constexpr unsigned char kEnd = 0; // through the pipe: nothing is watched any more

// A signal handler can reach nothing else.
std::atomic<int> pipeToWrite{-1};
static_assert(std::atomic<int>::is_always_lock_free);

void pass(int signal) {
    const int before = errno;
    const auto byte = static_cast<unsigned char>(signal);
    static_cast<void>(::write(pipeToWrite.load(), &byte, 1) == 1);
    errno = before;
}

} // namespace

TerminationWatch::TerminationWatch(std::chrono::milliseconds patience)
    : m_patience(patience) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return; // no descriptors left: the signals keep their meaning
    m_read = FileDescriptor(ends[0]);
    m_write = FileDescriptor(ends[1]);
    pipeToWrite = m_write.get();
    for (const int signal : kSignals) {
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = pass;
        action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
    m_thread = std::thread([this] { watch(); });
}

TerminationWatch::~TerminationWatch() {
    if (!m_write.valid())
        return;
    for (const int signal : kSignals) {
        struct sigaction present {};
        if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == pass)
            ::signal(signal, SIG_DFL);
    }
    static_cast<void>(::write(m_write.get(), &kEnd, 1) == 1);
    m_thread.join();
    pipeToWrite = -1;
}

void TerminationWatch::atSignal(std::function<void()> hook) {
    const std::lock_guard lock(m_mutex);
    m_atSignal = std::move(hook);
}

void TerminationWatch::endInOrder(std::function<void(int)> hook) {
    const std::lock_guard lock(m_mutex);
    m_endInOrder = std::move(hook);
    m_hadOwner = true;
}

void TerminationWatch::atLast(std::function<void()> hook) {
    const std::lock_guard lock(m_mutex);
    m_atLast = std::move(hook);
}

void TerminationWatch::release() {
    const std::lock_guard lock(m_mutex);
    m_endInOrder = nullptr;
    m_atLast = nullptr;
}

int TerminationWatch::nextByte(int timeoutMs) const {
    pollfd ready{m_read.get(), POLLIN, 0};
    unsigned char byte = 0;
    while (true) {
        const int count = ::poll(&ready, 1, timeoutMs);
        if (count > 0 && ::read(m_read.get(), &byte, 1) == 1)
            return byte;
        if (count == 0)
            return -1;
    }
}

void TerminationWatch::watch() {
    const int signal = nextByte(-1);
    if (signal == kEnd)
        return;
    bool hadOwner = false;
    {
        const std::lock_guard lock(m_mutex);
        hadOwner = m_hadOwner;
        if (hadOwner && m_atSignal)
            m_atSignal();
        if (m_endInOrder)
            m_endInOrder(signal);
    }
    if (hadOwner && nextByte(static_cast<int>(m_patience.count())) == kEnd)
        return;
    const std::lock_guard lock(m_mutex);
    if (m_atLast)
        m_atLast();
    static_cast<void>(stopFileNaming(kNamingPatience));
    if (!hadOwner && m_atSignal)
        m_atSignal(); // now that the start writes nothing any more
    std::_Exit(kStatus + signal);
}

} // namespace patina::editor
