#include "tests/app/editor/EditorFixture.h"

namespace patina::editor {

std::unique_ptr<Session> EditorTest::session;
std::unique_ptr<MainWindow> EditorTest::window;

void EditorTest::SetUpTestSuite() {
    session = std::make_unique<Session>();
    window = std::make_unique<MainWindow>(*session);
    // Some thirty programs of shaders that hardly a test looks at.
    window->viewport().setCompilesAhead(false);
    window->resize(1040, 860);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get(), 60'000));
}

void EditorTest::TearDownTestSuite() {
    window.reset();
    session.reset();
}

} // namespace patina::editor
