// What Qt says while the application object is made. Qt ends the process with a core dump when it
// finds no display it can use; this ends it with a message and a status instead.
#pragma once

namespace patina::editor {

class StartupMessages {
  public:
    StartupMessages();  // at most one at a time
    ~StartupMessages(); // Qt's messages go their usual way again, those held back first
    StartupMessages(const StartupMessages&) = delete;
    StartupMessages& operator=(const StartupMessages&) = delete;
};

} // namespace patina::editor
