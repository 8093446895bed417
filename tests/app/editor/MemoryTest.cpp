// What the editor keeps for later stays within its budget, and Help › Memory says what there is.
#include "app/editor/memory/MemoryDialog.h"
#include "app/editor/memory/MemoryUse.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

namespace patina::editor {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

class MemoryTest : public EditorTest {
  protected:
    void TearDown() override { session->memory.setBudget(MemoryUse::usualBudget()); }
    // Steps whose images nothing else keeps, 16 MiB each.
    static void setMaps(int count) {
        for (int i = 0; i < count; ++i) {
            MapSlot slot;
            slot.source = "builtin:" + std::to_string(i);
            slot.image =
                std::make_shared<const Image>(2048, 2048, 4, PixelType::U8, ColorEncoding::Srgb);
            controller().session().setDiffering({Scope::Material, selectedMaterial().id},
                                                {{&parameter("material.baseColor.map"), slot}},
                                                "Set Map");
            controller().session().separateSteps();
        }
    }
    static std::size_t history() { return controller().session().historyBytes(); }
};

TEST_F(MemoryTest, WhatIsKeptForLaterStaysWithinTheBudget) {
    session->memory.setBudget(1024 * kMiB);
    setMaps(8);
    EXPECT_GE(history(), 7 * 16 * kMiB);
    EXPECT_GE(session->memory.kept(), history());
    const int steps = undoCount();
    session->memory.setBudget(MemoryUse::kLeastBudget);
    EXPECT_LE(session->memory.kept(), MemoryUse::kLeastBudget);
    EXPECT_LT(undoCount(), steps);
    EXPECT_GT(undoCount(), 0) << "the newest stay";
    EXPECT_EQ(document().material(selectedMaterial().id)->baseColorMap.source, "builtin:7");
    controller().undoStack().undo();
    EXPECT_EQ(document().material(selectedMaterial().id)->baseColorMap.source, "builtin:6");

    // By itself, too, and every second.
    controller().undoStack().redo();
    setMaps(6);
    EXPECT_TRUE(eventually([] { return session->memory.kept() <= MemoryUse::kLeastBudget; }));
}

TEST_F(MemoryTest, TheBudgetIsRememberedAndHasBounds) {
    session->memory.setBudget(300 * kMiB);
    EXPECT_EQ(session->memory.budget(), 300 * kMiB);
    EXPECT_EQ(MemoryUse(*session).budget(), 300 * kMiB) << "of the next session";
    session->memory.setBudget(0);
    EXPECT_EQ(session->memory.budget(), MemoryUse::kLeastBudget);
    EXPECT_LE(MemoryUse::usualBudget(), 1024 * kMiB);
}

TEST_F(MemoryTest, TheDialogShowsEveryKindAndSetsTheBudget) {
    window->actions().memory->trigger();
    auto* dialog = window->findChild<QDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_TRUE(eventually([&] { return dialog->isVisible(); }));
    QStringList shown;
    for (const QLabel* label : dialog->findChildren<QLabel*>())
        shown << label->text();
    const QList<MemoryPart> parts = session->memory.parts();
    ASSERT_GE(parts.size(), 6);
    for (const MemoryPart& part : parts) {
        EXPECT_TRUE(shown.contains(part.name)) << part.name.toStdString();
        EXPECT_FALSE(part.help.isEmpty());
    }
    EXPECT_GT(parts.last().bytes, 0u) << "the program itself";
    const auto textures = std::ranges::find(parts, QStringLiteral("Textures"), &MemoryPart::name);
    ASSERT_NE(textures, parts.end());
    EXPECT_GT(textures->bytes, kMiB) << "of the picture that is shown";

    auto* budget = dialog->findChild<QSpinBox*>(QStringLiteral("memoryBudget"));
    ASSERT_NE(budget, nullptr);
    budget->setFocus();
    budget->selectAll();
    QTest::keyClicks(budget, QStringLiteral("200"));
    QTest::keyClick(budget, Qt::Key_Return);
    EXPECT_EQ(session->memory.budget(), 200 * kMiB);
    auto* free = dialog->findChild<QPushButton*>(QStringLiteral("memoryFree"));
    ASSERT_NE(free, nullptr);
    setMaps(2);
    const std::size_t steps = history();
    QTest::mouseClick(free, Qt::LeftButton);
    EXPECT_EQ(session->lights.bytes(), 0u);
    EXPECT_EQ(history(), steps) << "undo steps stay";
    dialog->close();
}

} // namespace
} // namespace patina::editor
