// A session with its window, on the start scene, small enough that software OpenGL keeps up.
#pragma once

#include "app/editor/Actions.h"
#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/Session.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>
#include <gmock/gmock.h>
#include <memory>

namespace patina::editor {

// Processes events until `condition` holds; false after a minute (a busy machine needs time).
template <class Condition>
[[nodiscard]] bool eventually(Condition condition) {
    return QTest::qWaitFor(condition, 120'000);
}

inline bool settled(Session& session) {
    return eventually([&] { return !session.controller.tasks().busy(); });
}

// A widget of a class by its accessible name, e.g. find<NumberField>(window, "Roughness").
template <class Widget>
[[nodiscard]] Widget* find(const QWidget& parent, const QString& accessibleName) {
    for (Widget* widget : parent.findChildren<Widget*>())
        if (widget->accessibleName() == accessibleName)
            return widget;
    return nullptr;
}

class EditorTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();

    void SetUp() override {
        if (!session->controller.isPristine() || document().meshes.empty())
            session->controller.newDocument();
        ASSERT_TRUE(settled(*session));
        ASSERT_FALSE(session->controller.document().materials.empty());
        ASSERT_EQ(undoCount(), 0);
    }

    static DocumentController& controller() { return session->controller; }
    static const Document& document() { return session->controller.document(); }
    static int undoCount() { return session->controller.undoStack().count(); }
    static const Material& selectedMaterial() {
        return *document().material(session->selection.material());
    }
    static void selectMaterialWithoutMaps() {
        for (const Material& material : document().materials)
            if (!material.baseColorMap.assigned() && !material.metallicMap.assigned() &&
                !material.perceptualRoughnessMap.assigned() && !material.normalMap.assigned() &&
                !material.occlusionMap.assigned() && !material.emissiveMap.assigned()) {
                session->selection.selectMaterial(material.id);
                return;
            }
        FAIL() << "every material has maps";
    }

    static std::unique_ptr<Session> session;
    static std::unique_ptr<MainWindow> window;
    QTemporaryDir folder;
};

} // namespace patina::editor
