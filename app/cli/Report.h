// What a command tells: one JSON object on standard output with --json, tidy lines otherwise.
#pragma once

#include "core/base/Result.h"
#include "core/scene/Scene.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace patina::cli {

class Report {
  public:
    Report(std::string command, bool json, bool quiet);
    ~Report();

    // The JSON object; commands add their own keys.
    [[nodiscard]] nlohmann::ordered_json& json();

    // A line of the result, for people: standard output, nothing with --json.
    void line(const std::string& text);
    // Aligned "label  value" pairs under an optional title.
    void table(const std::string& title,
               const std::vector<std::pair<std::string, std::string>>& rows);

    void warn(const std::string& text); // standard error and JSON's "warnings"
    void add(const Notice& notice);
    void add(const OpenedScene& scene); // its notices and the files that are not in it
    void output(const std::filesystem::path& file, const std::string& what); // was written

    // The work is done, but its result is not what was asked for: succeed() returns 1.
    void failCheck(const std::string& text);

    // Prints the JSON object with "error", or the message. Returns the exit status.
    int fail(const Error& error, int status);
    int succeed();

    [[nodiscard]] bool wantsJson() const { return m_wantsJson; }

  private:
    int print(int status);

    std::unique_ptr<nlohmann::ordered_json> m_json;
    std::string m_command;
    bool m_wantsJson, m_quiet;
    int m_status = 0;
};

// The command line itself is wrong: `message` says what is expected.
[[nodiscard]] inline Error usageError(std::string message) {
    return {ErrorKind::Usage, std::move(message), {}, {}};
}

[[nodiscard]] inline Error cancelledError() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

// The exit status of COMMANDS: sysexits.h where it has a number for it.
[[nodiscard]] int exitStatus(ErrorKind kind);
// Interrupted for now: farms put the task back into the queue. Whenever a checkpoint is there or
// was asked for, from the first moment on.
inline constexpr int kStoppedForNow = 75;

// "12,345,678" and "1.2 MiB".
[[nodiscard]] std::string countText(std::size_t count);
[[nodiscard]] std::string bytesText(std::size_t bytes);

} // namespace patina::cli
