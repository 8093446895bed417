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

// Processes events until `condition` holds; false after two minutes (a busy machine needs time).
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

    void SetUp() override;

    static DocumentController& controller() { return session->controller; }
    static const Document& document() { return session->controller.document(); }
    static int undoCount() { return session->controller.undoStack().count(); }
    static const Material& selectedMaterial();
    static void selectMaterialWithoutMaps();

    static std::unique_ptr<Session> session;
    static std::unique_ptr<MainWindow> window;
    QTemporaryDir folder;
};

} // namespace patina::editor
