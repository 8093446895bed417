// Runs the built `patina` as a user would and keeps what it said.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina::test {

struct Outcome {
    int status = -1; // exit status; 128 + signal when it was killed
    std::string out, err;
    double seconds = 0;
    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

struct RunOptions {
    // On top of the test's own; null: without that variable
    std::map<std::string, std::optional<std::string>> environment;
    std::string program;        // empty: the one in $PATINA_BIN_DIR
    int signal = 0;             // sent when `signalWhen` appears on stderr
    std::string signalWhen;     // a regular expression
    std::function<void()> when; // called at that moment instead of sending a signal
};

Outcome runPatina(const std::vector<std::string>& arguments, const RunOptions& options = {});

// A folder that disappears with the object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }
    [[nodiscard]] std::string operator/(const std::string& name) const {
        return (m_path / name).string();
    }
    [[nodiscard]] std::vector<std::string> files() const; // names, sorted

  private:
    std::filesystem::path m_path;
};

std::string readBytes(const std::filesystem::path& file);
void writeBytes(const std::filesystem::path& file, const std::string& data);

} // namespace patina::test
