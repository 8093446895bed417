#include "app/cli/EarlySignals.h"

#include <atomic>
#include <csignal>

namespace patina::cli {
namespace {

// The only thing that the handler may touch.
std::atomic<int> earlySignal = 0; // NOLINT: signal handlers have no other way to their object
static_assert(std::atomic<int>::is_always_lock_free);

void keepSignal(int signal) {
    earlySignal = signal;
}

} // namespace

EarlySignals::EarlySignals() {
    for (const int signal : {SIGINT, SIGTERM}) {
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue; // a shell starts what runs in the background without SIGINT
        struct sigaction action {};
        action.sa_handler = keepSignal;
        action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
}

int EarlySignals::take() {
    return earlySignal.exchange(0);
}

} // namespace patina::cli
