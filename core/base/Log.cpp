#include "core/base/Log.h"

#include "core/base/PrintableText.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace patina {
namespace {

struct LogState {
    std::mutex mutex;
    std::function<void(LogLevel, const std::string&)> listener;
    std::atomic<LogLevel> level = LogLevel::Warning;
    std::shared_ptr<spdlog::logger> logger;

    LogState() {
        logger = std::make_shared<spdlog::logger>(
            "patina", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        logger->set_pattern("%H:%M:%S.%e %^%l%$ %v");
        logger->set_level(spdlog::level::trace);
    }
};

// The process has one log, as it has one standard error.
LogState& logState() {
    static LogState state;
    return state;
}

spdlog::level::level_enum spdlogLevel(LogLevel level) {
    switch (level) {
    case LogLevel::Debug:
        return spdlog::level::debug;
    case LogLevel::Info:
        return spdlog::level::info;
    case LogLevel::Warning:
        return spdlog::level::warn;
    case LogLevel::Error:
        break;
    }
    return spdlog::level::err;
}

} // namespace

void logMessage(LogLevel level, std::string_view message) {
    LogState& state = logState();
    if (level < state.level.load(std::memory_order_relaxed))
        return;
    const std::string text = printableText(message);
    state.logger->log(spdlogLevel(level), text);
    std::function<void(LogLevel, const std::string&)> listener;
    {
        const std::lock_guard lock(state.mutex);
        listener = state.listener;
    }
    if (listener)
        listener(level, text);
}

void setLogLevel(LogLevel level) {
    logState().level.store(level, std::memory_order_relaxed);
}

void setLogListener(std::function<void(LogLevel, const std::string&)> listener) {
    LogState& state = logState();
    const std::lock_guard lock(state.mutex);
    state.listener = std::move(listener);
}

} // namespace patina
