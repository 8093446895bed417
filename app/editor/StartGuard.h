// Whether the last start of the editor came to its end. One that died (of a file that a dock reads
// as soon as it is shown, of a driver) would die again, and with it the only way to close that
// dock: so the next start leaves out the docks that were opened, and the one after that, should
// it die as well, the whole layout.
#pragma once

#include <QString>
#include <QStringList>
#include <filesystem>

namespace patina::editor {

// Beside the recovery folder: ~/.local/share/Patina/Patina/starting.
[[nodiscard]] std::filesystem::path startMark();

class StartGuard {
  public:
    enum class LeaveOut { Nothing, OpenedDocks, Layout };

    // Notes in the file `mark` that this process is starting.
    explicit StartGuard(std::filesystem::path mark);
    ~StartGuard(); // ended in order
    StartGuard(const StartGuard&) = delete;
    StartGuard& operator=(const StartGuard&) = delete;

    // Nothing, unless the process that started before did not arrive, and runs no more.
    [[nodiscard]] LeaveOut leaveOut() const { return m_leaveOut; }
    // This start leaves out more than it was asked to: there was no dock to close.
    void leaveOutLayout();
    // What is said to the user: `docks` were closed, or none.
    [[nodiscard]] static QString text(const QStringList& docks);

    // This one has: whatever ends it from now on is not the start.
    void arrived() const { arrived(m_mark); }
    static void arrived(const std::filesystem::path& mark); // from any thread

  private:
    void note() const;

    const std::filesystem::path m_mark;
    LeaveOut m_leaveOut = LeaveOut::Nothing;
};

} // namespace patina::editor
