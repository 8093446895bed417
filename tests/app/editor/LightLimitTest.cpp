// What the window says of more lights than the picture can show.
#include "app/editor/Session.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "tests/support/Events.h"

#include <QTest>
#include <algorithm>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

TEST(LightLimits, AreToldOnceEachTimeTheyArePassed) {
    Session session;
    DocumentController& controller = session.controller;
    std::vector<UserNotice> notices;
    QObject::connect(&controller, &DocumentController::noticed,
                     [&](const UserNotice& notice) { notices.push_back(notice); });
    controller.openScene(QStringLiteral("builtin:cornell-box"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.tasks().busy(); }, 60'000));
    test::handleEvents();
    notices.clear();
    const auto add = [&] {
        controller.addLight(LightType::Spot);
        test::handleEvents();
    };
    while (std::ranges::count(controller.document().lights, true, &Light::castsShadow) < 4)
        add();
    EXPECT_TRUE(notices.empty());
    add();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Warning);
    EXPECT_TRUE(notices[0].text.contains(QStringLiteral("lights with shadows")));
    add();
    EXPECT_EQ(notices.size(), 1u);
    // Kept to, and passed again.
    controller.undoStack().undo();
    controller.undoStack().undo();
    test::handleEvents();
    EXPECT_EQ(notices.size(), 1u);
    add();
    EXPECT_EQ(notices.size(), 2u);
}

} // namespace
} // namespace patina::editor
