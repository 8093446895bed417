// Whether the last start of the editor came to its end. One that died (of a file that a dock reads
// as soon as it is shown, of a driver) would die again, and with it the only way to close that
// dock.
#pragma once

#include <QString>

namespace patina::editor {

class StartGuard {
  public:
    // Notes in the settings that this process is starting.
    StartGuard();
    ~StartGuard(); // ended in order
    StartGuard(const StartGuard&) = delete;
    StartGuard& operator=(const StartGuard&) = delete;

    // The process that started before did not arrive, and runs no more.
    [[nodiscard]] bool lastStartDied() const { return m_lastDied; }
    // What is said to the user then.
    [[nodiscard]] static QString text();

    // This one has: whatever ends it from now on is not the start.
    void arrived();

  private:
    bool m_lastDied = false;
};

} // namespace patina::editor
