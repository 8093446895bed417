// The History dock: steps with their values and pictures, back and forth by clicks.
#include "app/editor/panel/HistoryPanel.h"
#include "core/edit/EditSession.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QListWidget>

namespace patina::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class HistoryPanelTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(200, 160);
        if (!window->actions().historyDock->isChecked())
            window->actions().historyDock->trigger();
        ASSERT_TRUE(eventually([] { return list().isVisible(); }));
        selectMaterialWithoutMaps();
    }
    static HistoryPanel& panel() { return *window->findChild<HistoryPanel*>(); }
    static QListWidget& list() { return *panel().findChild<QListWidget*>(); }
    void set(const char* id, const ParameterValue& value, DragSession session = 0) {
        controller().setParameter(parameter(id),
                                  {Scope::Material, EditorTest::session->selection.material()},
                                  value, session);
    }
    static std::vector<std::string> texts() {
        std::vector<std::string> result;
        for (int row = 0; row < list().count(); ++row)
            result.push_back(list().item(row)->text().toStdString());
        return result;
    }
    static bool shows(int rows, int current) {
        return eventually([=] { return list().count() == rows && list().currentRow() == current; });
    }
    static void click(int row) {
        list().scrollToItem(list().item(row));
        test::handleEvents();
        QTest::mouseClick(list().viewport(), Qt::LeftButton, Qt::NoModifier,
                          list().visualItemRect(list().item(row)).center());
    }
    static QImage iconOf(int row) { return list().item(row)->icon().pixmap(96, 54).toImage(); }
};

TEST_F(HistoryPanelTest, StepsHaveTheirValuesAndLeadBackAndForth) {
    ASSERT_TRUE(shows(1, 0));
    const Document start = document();
    set("material.perceptualRoughness", 0.25f);
    set("material.baseColor", glm::vec3(1.0f, 0.0f, 0.0f));
    set("material.doubleSided", true);
    ASSERT_TRUE(shows(4, 3));
    EXPECT_EQ(texts()[0], "Start");
    EXPECT_THAT(texts()[1], HasSubstr("Roughness"));
    EXPECT_THAT(texts()[1], HasSubstr("→ 0.25"));
    EXPECT_THAT(texts()[2], HasSubstr("→ #ff0000"));
    EXPECT_THAT(texts()[3], HasSubstr("off → on"));
    const Document end = document();
    click(1);
    ASSERT_TRUE(shows(4, 1)) << "the others can be done again";
    EXPECT_EQ(selectedMaterial().perceptualRoughness, 0.25f);
    EXPECT_FALSE(selectedMaterial().doubleSided);
    click(0);
    ASSERT_TRUE(shows(4, 0));
    EXPECT_EQ(document(), start);
    click(3);
    EXPECT_EQ(document(), end);
    click(1);
    set("material.metallic", 1.0f);
    ASSERT_TRUE(shows(3, 2)) << "an edit takes the place of what was undone";
    EXPECT_THAT(texts()[2], HasSubstr("Metallic"));
}

TEST_F(HistoryPanelTest, ADragIsOneStepWithItsLastValue) {
    const DragSession session = controller().newDragSession();
    for (const float value : {0.3f, 0.4f, 0.9f})
        set("material.metallic", value, session);
    ASSERT_TRUE(shows(2, 1));
    EXPECT_TRUE(eventually([] { return texts()[1].find("→ 0.9") != std::string::npos; }))
        << texts()[1];
}

TEST_F(HistoryPanelTest, EachStepGetsThePictureOfItsState) {
    const auto rests = [] { return eventually([] { return window->viewport().isSettled(); }); };
    ASSERT_TRUE(rests());
    set("material.baseColor", glm::vec3(0.0f, 0.0f, 1.0f));
    ASSERT_TRUE(shows(2, 1));
    const QImage before = iconOf(1);
    ASSERT_TRUE(rests());
    EXPECT_TRUE(eventually([&] { return iconOf(1) != before; })) << "its picture came";
    const QImage blue = iconOf(1);
    set("material.baseColor", glm::vec3(1.0f, 1.0f, 0.0f));
    ASSERT_TRUE(rests());
    ASSERT_TRUE(eventually([&] { return list().count() == 3 && iconOf(2) != before; }));
    EXPECT_NE(iconOf(2), blue);
    EXPECT_EQ(iconOf(1), blue) << "it keeps its own";
}

} // namespace
} // namespace patina::editor
