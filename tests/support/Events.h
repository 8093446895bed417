// Waiting without a clock.
#pragma once

#include <QCoreApplication>
#include <QEvent>

namespace patina::test {

// Everything that is queued has been handled, and what that queued in turn: layouts, rows that are
// made anew, widgets that are to be deleted, timers without a delay.
inline void handleEvents() {
    constexpr int kRounds = 5;
    for (int round = 0; round < kRounds; ++round) {
        QCoreApplication::processEvents();
        QCoreApplication::sendPostedEvents();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
}

} // namespace patina::test
