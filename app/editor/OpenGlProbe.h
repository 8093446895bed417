// Finds out whether the window's OpenGL works before there is a window, in a process of its own: a
// broken driver may end that one, and the editor says so instead of ending with it.
#pragma once

#include "core/base/FileDescriptor.h"

#include <QString>
#include <optional>
#include <sys/types.h>

namespace patina::editor {

inline constexpr int kNoOpenGlStatus = 69; // EX_UNAVAILABLE, as the command line's

class OpenGlProbe {
  public:
    OpenGlProbe(); // starts it
    ~OpenGlProbe();
    OpenGlProbe(const OpenGlProbe&) = delete;
    OpenGlProbe& operator=(const OpenGlProbe&) = delete;

    // Waits for its end. What is wrong, as it was found ("OpenGL 3.3 (llvmpipe …)"); nothing when
    // OpenGL works, or when there is no display to ask.
    [[nodiscard]] std::optional<QString> problem();

    // The started process: whether `argv` asks for it, and what it does. Returns its exit status.
    [[nodiscard]] static bool isWanted(int argc, char** argv);
    [[nodiscard]] static int run(int argc, char** argv);

  private:
    pid_t m_process = -1;
    FileDescriptor m_answer;
};

// What was found, what is needed and where to get it; several lines of plain text.
[[nodiscard]] QString noOpenGlText(const QString& found);

} // namespace patina::editor
