// The Snapshots dock by real events: looks are kept, compared with the scene and with each other,
// and restored value by value.
#include "app/editor/panel/SnapshotsPanel.h"
#include "app/editor/panel/LookPictures.h"
#include "app/editor/panel/SnapshotComparison.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTreeWidget>
#include <fmt/format.h>

namespace patina::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SnapshotsPanelTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(200, 160);
        window->viewport().setAddsSlowFrames(true);
        if (!window->actions().snapshotsDock->isChecked())
            window->actions().snapshotsDock->trigger();
        ASSERT_TRUE(eventually([] { return list().isVisible(); }));
        selectMaterialWithoutMaps();
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        ASSERT_TRUE(rests());
        steps = undoCount();
    }
    static SnapshotsPanel& panel() { return *window->findChild<SnapshotsPanel*>(); }
    static QListWidget& list() { return panel().list(); }
    static SnapshotComparison& comparison() { return panel().comparison(); }
    static QTreeWidget& table() { return comparison().table(); }
    static bool rests() {
        return eventually([] { return window->viewport().isSettled(); });
    }
    static void set(const char* id, const ParameterValue& value) {
        controller().setParameter(
            parameter(id), {Scope::Material, EditorTest::session->selection.material()}, value);
    }
    static void keep() { // where the keys go nowhere else
        window->viewport().setFocus();
        QTest::keyClick(&window->viewport(), Qt::Key_K, Qt::ControlModifier);
    }
    static void click(int row, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::mouseClick(list().viewport(), Qt::LeftButton, modifiers,
                          list().visualItemRect(list().item(row)).center());
    }
    static void doubleClick(QAbstractItemView& view, const QRect& place) {
        QTest::mouseClick(view.viewport(), Qt::LeftButton, {}, place.center());
        QTest::mouseDClick(view.viewport(), Qt::LeftButton, {}, place.center());
    }
    static std::vector<std::string> values() { // "Metallic: 0 | 1"
        std::vector<std::string> result;
        for (int i = 0; i < table().topLevelItemCount(); ++i)
            for (int k = 0; k < table().topLevelItem(i)->childCount(); ++k) {
                const QTreeWidgetItem& row = *table().topLevelItem(i)->child(k);
                result.push_back(
                    (row.text(0) + ": " + row.text(1) + " | " + row.text(2)).toStdString());
            }
        return result;
    }
    static bool lists(std::size_t count) {
        return eventually([=] { return values().size() == count; });
    }
    static QPushButton* button(const QString& text) {
        for (QPushButton* one : comparison().findChildren<QPushButton*>())
            if (one->isVisible() && one->text() == text)
                return one;
        return nullptr;
    }
    int steps = 0;
};

TEST_F(SnapshotsPanelTest, KeepsComparesAndRestoresOneValue) {
    keep();
    ASSERT_TRUE(eventually([] { return list().count() == 1; }));
    EXPECT_EQ(undoCount(), steps + 1) << "one step";
    const Snapshot& kept = document().snapshots.front();
    EXPECT_EQ(kept.name, "Snapshot 1");
    EXPECT_TRUE(eventually([&] { return document().snapshots.front().picture != nullptr; }));
    EXPECT_EQ(std::max(kept.picture->width(), kept.picture->height()), 160);
    EXPECT_TRUE(list().item(0)->isSelected());
    EXPECT_TRUE(lists(0));

    const float before = selectedMaterial().metallic, other = before == 1.0f ? 0.0f : 1.0f;
    set("material.metallic", other);
    set("material.baseColor", glm::vec3(1.0f, 0.0f, 0.0f));
    controller().setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 1.5f);
    ASSERT_TRUE(lists(3));
    EXPECT_THAT(values()[1], HasSubstr(fmt::format("Metallic: {} | {}", before, other)));
    EXPECT_EQ(values()[2], "Exposure (EV): 0 | 1.5");
    EXPECT_TRUE(eventually([] {
        return !comparison().pictures().isMeasuring() && comparison().pictures().meanFlip() > 0.01;
    })) << comparison().pictures().meanFlip();
    EXPECT_EQ(comparison().pictures().difference().width(), kept.picture->width());

    const int now = undoCount();
    QTreeWidgetItem* metallic = table().topLevelItem(0)->child(1);
    table().scrollToItem(metallic);
    test::handleEvents();
    doubleClick(table(), table().visualItemRect(metallic));
    EXPECT_EQ(selectedMaterial().metallic, before);
    EXPECT_EQ(undoCount(), now + 1);
    EXPECT_THAT(controller().session().undoText(), HasSubstr("Restore Metallic of Snapshot 1"));
    ASSERT_TRUE(lists(2));
    EXPECT_EQ(document().view.exposureEv, 1.5f);

    ASSERT_NE(button("Restore All of Snapshot 1"), nullptr);
    QTest::mouseClick(button("Restore All of Snapshot 1"), Qt::LeftButton);
    EXPECT_EQ(undoCount(), now + 2);
    EXPECT_EQ(document().view.exposureEv, 0.0f);
    EXPECT_TRUE(lists(0));
    EXPECT_FALSE(button("Restore All of Snapshot 1")->isEnabled());
}

TEST_F(SnapshotsPanelTest, TwoAreComparedWithEachOtherAndEitherIsRestored) {
    keep();
    set("material.perceptualRoughness", 0.125f);
    set("material.metallic", 0.25f);
    keep();
    ASSERT_TRUE(eventually([] { return list().count() == 2; }));
    set("material.perceptualRoughness", 0.875f);
    click(0);
    click(1, Qt::ControlModifier);
    ASSERT_TRUE(lists(2)) << "the scene's own value is not among them";
    EXPECT_THAT(values()[1], HasSubstr("| 0.125"));
    EXPECT_EQ(table().headerItem()->text(2), "Snapshot 2");

    // Of the second, what is selected.
    QTreeWidgetItem* roughness = table().topLevelItem(0)->child(1);
    QTest::mouseClick(table().viewport(), Qt::LeftButton, {},
                      table().visualItemRect(roughness).center());
    ASSERT_NE(button("Restore 1 of Snapshot 2"), nullptr);
    QTest::mouseClick(button("Restore 1 of Snapshot 2"), Qt::LeftButton);
    EXPECT_EQ(selectedMaterial().perceptualRoughness, 0.125f);
    controller().session().undo();

    doubleClick(list(), list().visualItemRect(list().item(1)));
    EXPECT_EQ(selectedMaterial().perceptualRoughness, 0.125f) << "all of it, as one step";
    EXPECT_EQ(controller().session().undoText(), "Restore Snapshot 2");
    const Document restored = document();
    click(0);
    ASSERT_TRUE(lists(2));
    EXPECT_EQ(document(), restored) << "looking changes nothing";
}

TEST_F(SnapshotsPanelTest, IsRenamedInPlaceAndRemovedByKeys) {
    keep();
    keep();
    ASSERT_TRUE(eventually([] { return list().count() == 2; }));
    click(1);
    list().setFocus();
    QTest::keyClick(&list(), Qt::Key_F2);
    auto* editor = list().findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    editor->setText("Evening");
    QTest::keyClick(editor, Qt::Key_Return);
    EXPECT_TRUE(eventually([] { return document().snapshots[1].name == "Evening"; }));
    EXPECT_EQ(controller().session().undoText(), "Rename Snapshot 2");
    click(0);
    click(1, Qt::ShiftModifier);
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_TRUE(document().snapshots.empty());
    EXPECT_TRUE(eventually([] { return list().count() == 0; }));
    controller().session().undo();
    EXPECT_EQ(document().snapshots.size(), 2u) << "both in one step";
    EXPECT_TRUE(eventually([] { return list().count() == 2; }));
}

TEST_F(SnapshotsPanelTest, WhatWasRemovedIsSaidAndComesBack) {
    const Id material = EditorTest::session->selection.material();
    const Id light = controller().addLight(LightType::Point);
    keep();
    controller().removeLight(light);
    controller().removeMaterial(material);
    const Id added = controller().addMaterial();
    ASSERT_TRUE(eventually([] { return values().size() >= 3; }));
    const std::vector<std::string> all = values();
    EXPECT_THAT(all, ::testing::Contains("All of it: there | not there").Times(2));
    EXPECT_THAT(all, ::testing::Contains("All of it: not there | there"));
    QTest::mouseClick(button("Restore All of Snapshot 1"), Qt::LeftButton);
    EXPECT_NE(document().material(material), nullptr);
    EXPECT_NE(document().light(light), nullptr);
    EXPECT_NE(document().material(added), nullptr) << "nothing shows it: it stays";
    EXPECT_TRUE(lists(1));
    EXPECT_THAT(table().topLevelItem(0)->child(0)->toolTip(1).toStdString(),
                HasSubstr("came later and is kept"));
    EXPECT_FALSE(button("Restore All of Snapshot 1")->isEnabled());
}

// The wall compares snapshots where there are some.
TEST_F(SnapshotsPanelTest, AreColumnsOfTheWall) {
    auto* columns = find<QComboBox>(*window, "Columns");
    ASSERT_NE(columns, nullptr);
    session->wall.setOn(true);
    EXPECT_TRUE(eventually([&] { return columns->findText("Snapshots") < 0; }));
    session->wall.setOn(false);
    keep();
    set("material.metallic", selectedMaterial().metallic == 1.0f ? 0.0f : 1.0f);
    keep();
    session->wall.setOn(true);
    ASSERT_TRUE(eventually([&] { return columns->findText("Snapshots") >= 0; }));
    const int index = columns->findText("Snapshots");
    columns->setCurrentIndex(index);
    Q_EMIT columns->activated(index);
    WallPlan plan = session->wall.plan();
    plan.rows = {};
    session->wall.setPlan(plan);
    ASSERT_EQ(session->wall.cells().size(), 2u);
    EXPECT_EQ(session->wall.cells()[0].captions.front(), "Snapshot 1");
    ASSERT_TRUE(rests());
    EXPECT_FALSE(window->viewport().grabFramebuffer().isNull());
    session->wall.setOn(false);
}

} // namespace
} // namespace patina::editor
