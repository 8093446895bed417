// A program that a test starts, reads from and ends, by its process id.
#pragma once

#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace patina::test {

class ChildProcess {
  public:
    // `environment`: on top of the test's own; an empty value removes the variable. Both outputs
    // go to `output`, a file.
    ChildProcess(const std::vector<std::string>& command,
                 const std::map<std::string, std::string>& environment, const std::string& output);
    ~ChildProcess(); // kills it where it still runs
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    [[nodiscard]] bool running();
    void signal(int number) const;
    // Its exit status; 128 + the signal that ended it; -1 when it has not ended after `seconds`.
    [[nodiscard]] int wait(double seconds);

  private:
    pid_t m_process = -1;
    int m_status = -1; // of waitpid(), once it has ended
    bool m_ended = false;
};

// An X server of the test's own.
class XServer {
  public:
    explicit XServer(const std::string& folder);
    [[nodiscard]] const std::string& display() const { return m_display; } // ":42"
    void kill();                                                           // and wait for its end

  private:
    std::string m_displayFile;
    ChildProcess m_process;
    std::string m_display;
};

} // namespace patina::test
