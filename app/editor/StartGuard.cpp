#include "app/editor/StartGuard.h"

#include "core/base/AtomicFile.h"
#include "core/base/OwnFile.h"

#include <QCoreApplication>
#include <QFile>
#include <QStandardPaths>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace patina::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMarkBytes = 64;

// The process that is starting, and what it leaves out of the layout.
struct Mark {
    int process = 0, leavesOut = 0;
};

Mark readMark(const fs::path& file) {
    Mark mark;
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error)))
        return mark;
    const Result<std::string> text = readTextFile(file, kMostMarkBytes);
    if (text && std::sscanf(text->c_str(), "%d %d", &mark.process, &mark.leavesOut) < 1)
        mark = {};
    return mark;
}

} // namespace

fs::path startMark() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
    return fs::path(QFile::encodeName(folder).toStdString()) / "starting";
}

StartGuard::StartGuard(fs::path mark)
    : m_mark(std::move(mark)) {
    const Mark last = readMark(m_mark);
    const bool died = last.process > 0 && ::kill(last.process, 0) != 0;
    if (died)
        m_leaveOut = last.leavesOut > 0 ? LeaveOut::Layout : LeaveOut::OpenedDocks;
    note(); // before anything can go wrong
}

StartGuard::~StartGuard() {
    arrived();
}

void StartGuard::note() const {
    std::error_code error;
    fs::create_directories(m_mark.parent_path(), error);
    const std::string text = fmt::format("{} {}\n", ::getpid(), static_cast<int>(m_leaveOut));
    // Where nothing can be written a start that dies is not noticed, and that is all.
    static_cast<void>(
        writeOwnFile(m_mark, std::as_bytes(std::span(text.data(), text.size()))).ok());
}

void StartGuard::leaveOutLayout() {
    m_leaveOut = LeaveOut::Layout;
    note();
}

void StartGuard::arrived(const fs::path& mark) {
    std::error_code error;
    if (readMark(mark).process == ::getpid())
        fs::remove(mark, error);
}

QString StartGuard::text(const QStringList& docks) {
    if (docks.isEmpty())
        return QCoreApplication::translate(
            "StartGuard",
            "Patina ended while it was starting last time. All docks are where they were "
            "at first, in case one of them was the reason; the menu View opens the others.");
    return QCoreApplication::translate(
               "StartGuard", "Patina ended while it was starting last time. Docks that were open "
                             "are closed, in case one of them was the reason: %1. The menu View "
                             "opens them.")
        .arg(docks.join(QStringLiteral(", ")));
}

} // namespace patina::editor
