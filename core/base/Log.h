// The log: one line per event, to standard error and to whoever listens (the editor's log panel).
// Callable from any thread.
#pragma once

#include <fmt/core.h>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace patina {

enum class LogLevel { Debug, Info, Warning, Error };

void logMessage(LogLevel level, std::string_view text);

// Messages below `level` are dropped. The default is Warning (the command line stays quiet).
void setLogLevel(LogLevel level);

// Called for every message that is not dropped, on the thread that logs; an empty function
// removes the listener.
void setLogListener(std::function<void(LogLevel, const std::string&)> listener);

template <class... Args>
void logDebug(fmt::format_string<Args...> format, Args&&... args) {
    logMessage(LogLevel::Debug, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void logInfo(fmt::format_string<Args...> format, Args&&... args) {
    logMessage(LogLevel::Info, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void logWarning(fmt::format_string<Args...> format, Args&&... args) {
    logMessage(LogLevel::Warning, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void logError(fmt::format_string<Args...> format, Args&&... args) {
    logMessage(LogLevel::Error, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace patina
