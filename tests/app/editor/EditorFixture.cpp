#include "tests/app/editor/EditorFixture.h"

namespace patina::editor {
std::unique_ptr<Session> EditorTest::session;
std::unique_ptr<MainWindow> EditorTest::window;
} // namespace patina::editor
