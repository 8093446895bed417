#include "tests/app/editor/EditorFixture.h"

#include "core/material/MaterialInputs.h"

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

void EditorTest::SetUp() {
    if (!session->controller.isPristine() || document().meshes.empty())
        session->controller.newDocument();
    ASSERT_TRUE(settled(*session));
    ASSERT_FALSE(session->controller.document().materials.empty());
    ASSERT_EQ(undoCount(), 0);
}

const Material& EditorTest::selectedMaterial() {
    return *document().material(session->selection.material());
}

void EditorTest::selectMaterialWithoutMaps() {
    for (const Material& material : document().materials) {
        bool hasMap = false;
        forEachMap(material, [&](const MapSlot& map) { hasMap |= map.assigned(); });
        if (!hasMap) {
            session->selection.selectMaterial(material.id);
            return;
        }
    }
    FAIL() << "every material has maps";
}

} // namespace patina::editor
