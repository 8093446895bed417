// A running worker as its client holds it: process id and control socket.
//
// Owned and guarded by WorkerClient. The worker ends by itself when the control socket closes, so
// it never outlives a client that crashed. (PR_SET_PDEATHSIG would not do here: it fires when the
// *thread* that started the worker ends, and requests come from pool threads.)
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/base/Result.h"

#include <filesystem>
#include <sys/types.h>

namespace patina {

class WorkerProcess {
  public:
    WorkerProcess() = default;
    ~WorkerProcess() { kill(); }
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    // Starts `program` unless it runs already. Errors: Internal (missing, not executable).
    Result<void> ensureRunning(const std::filesystem::path& program);
    void kill();        // ends the worker and, through the kernel, its children; no zombie stays
    void reapIfEnded(); // notices that the worker is gone

    [[nodiscard]] int pid() const { return m_pid; } // -1: none runs
    [[nodiscard]] int control() const { return m_control.get(); }

  private:
    pid_t m_pid = -1;
    FileDescriptor m_control;
};

} // namespace patina
