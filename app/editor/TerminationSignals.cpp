#include "app/editor/TerminationSignals.h"

#include "core/base/Check.h"

#include <QSocketNotifier>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>

namespace patina::editor {
namespace {

constexpr std::array<int, 3> kSignals{SIGTERM, SIGHUP, SIGINT};

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

TerminationSignals::TerminationSignals(QObject* parent)
    : QObject(parent) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
        return; // no descriptors left: the signals keep their meaning
    m_read = FileDescriptor(ends[0]);
    m_write = FileDescriptor(ends[1]);
    int unused = -1;
    CHECK(pipeToWrite.compare_exchange_strong(unused, m_write.get()));
    auto* notifier = new QSocketNotifier(m_read.get(), QSocketNotifier::Read, this);
    connect(notifier, &QSocketNotifier::activated, this, [this] {
        unsigned char byte = 0;
        if (::read(m_read.get(), &byte, 1) == 1)
            Q_EMIT received(byte);
    });
    for (const int signal : kSignals) {
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = pass;
        action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
}

TerminationSignals::~TerminationSignals() {
    if (!m_write.valid())
        return;
    for (const int signal : kSignals) {
        struct sigaction present {};
        if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == pass)
            ::signal(signal, SIG_DFL);
    }
    pipeToWrite = -1;
}

} // namespace patina::editor
