// Environment files that are dropped onto cells of the wall and their captions.
#include "app/editor/document/DraggedSources.h"
#include "app/editor/viewport/DropTarget.h"
#include "app/editor/wall/OwnValueControls.h"
#include "core/document/EnvironmentTitle.h"
#include "core/io/ImageIO.h"
#include "tests/app/wall/WallFixture.h"

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMimeData>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

class WallDropTest : public WallWindow {
  protected:
    void SetUp() override {
        WallWindow::SetUp();
        key(Qt::Key_F3); // three materials
        ASSERT_TRUE(isSettled());
    }
    // Of one colour.
    QString writeEnvironment(const char* name, float red, float blue) {
        Image image(32, 16, 3, PixelType::F32, ColorEncoding::Linear);
        for (std::size_t i = 0; i < image.f32().size(); ++i)
            image.f32()[i] = i % 3 == 0 ? red : i % 3 == 1 ? 0.2f : blue;
        const QString file = folder.filePath(QLatin1String(name));
        EXPECT_TRUE(saveImage(session->worker, image, file.toStdString()).ok());
        return file;
    }
    static QPoint inWindow(const QPoint& position) {
        return viewport().mapTo(window.get(), position);
    }
    // What the window says while they are held there; then they are let go.
    static QStringList drop(const QStringList& sources, const QPoint& position) {
        QMimeData data;
        setDraggedSources(data, sources); // as the Environment Library does
        const QPoint at = inWindow(position);
        QDragEnterEvent enter(window->rect().topLeft(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &enter);
        QDragMoveEvent move(at, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &move);
        const QStringList lines = viewport().findChild<DropHint*>()->lines();
        QDropEvent event(QPointF(at), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(window.get(), &event);
        EXPECT_TRUE(event.isAccepted());
        EXPECT_TRUE(settled(*session));
        return lines;
    }
    static std::string environmentOf(std::size_t cell) {
        const Result<Document> shown = documentOf(document(), wall().cells()[cell].cell);
        return shown ? environmentTitle(shown->environment()) : shown.error().message;
    }
};

TEST_F(WallDropTest, AFileLightsTheCellItIsDroppedOnto) {
    const std::string before = environmentOf(0);
    const Id lighting = document().mix.first;
    const QImage first = pictureOf(0);
    const QString red = writeEnvironment("red.hdr", 1.0f, 0.1f);
    const QStringList lines = drop({red}, centreOf(1));
    ASSERT_EQ(lines.size(), 1);
    EXPECT_THAT(lines[0].toStdString(), testing::HasSubstr("red.hdr"));
    EXPECT_THAT(lines[0].toStdString(),
                testing::HasSubstr(captionOf(wall().cells()[1]).toStdString()));
    EXPECT_EQ(environmentOf(0), before);
    EXPECT_EQ(environmentOf(1), "red");
    EXPECT_EQ(environmentOf(2), before);
    EXPECT_EQ(document().mix.first, lighting) << "the scene is lit as it was";
    EXPECT_EQ(undoCount(), steps + 1) << "one environment came to the scene";
    EXPECT_EQ(wall().current(), 1u);
    ASSERT_TRUE(isSettled());
    keepPicture("wall-drop.png");

    // Again elsewhere: it is not added twice.
    drop({red}, centreOf(2));
    EXPECT_EQ(environmentOf(2), "red");
    EXPECT_EQ(undoCount(), steps + 1);

    // Another one by the list, and linked again.
    auto& controls = *window->findChild<OwnValueControls*>();
    auto* box = find<QComboBox>(controls, QStringLiteral("Environment"));
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(box->currentText(), QStringLiteral("red"));
    box->setCurrentIndex(0);
    Q_EMIT box->activated(0);
    EXPECT_EQ(environmentOf(2), before);
    EXPECT_NE(wall().cells()[2].own.element(CellElement::Environment), 0u);
    QTest::mouseClick(find<QToolButton>(controls, QStringLiteral("Link Environment")),
                      Qt::LeftButton);
    EXPECT_EQ(wall().cells()[2].own.element(CellElement::Environment), 0u);
    EXPECT_FALSE(controls.isVisible());

    // Undone, the environment is gone: the cell says so, and others are offered.
    controller().undoStack().undo();
    ASSERT_TRUE(isSettled());
    EXPECT_THAT(wall().text(1).toStdString(), testing::HasSubstr("no longer in the scene"));
    click(1);
    box = find<QComboBox>(controls, QStringLiteral("Environment"));
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(box->currentIndex(), -1);
    controller().undoStack().redo();
    EXPECT_EQ(environmentOf(1), "red");
}

TEST_F(WallDropTest, ThreeFilesLightThreeCells) {
    drop({writeEnvironment("a.hdr", 1.0f, 0.1f), writeEnvironment("b.hdr", 0.1f, 1.0f),
          writeEnvironment("c.hdr", 1.0f, 1.0f)},
         centreOf(1));
    EXPECT_EQ(environmentOf(1), "a");
    EXPECT_EQ(environmentOf(2), "b");
    ASSERT_EQ(wall().cells().size(), 3u);
    EXPECT_EQ(document().environments.size(), 4u) << "c is in the scene for whoever wants it";
}

TEST_F(WallDropTest, OntoAnEnvironmentTheyTakeItsPlace) {
    drop({writeEnvironment("a.hdr", 1.0f, 0.1f)}, centreOf(0)); // a second one
    WallPlan plan;
    plan.columns.compared = Compared::Environments;
    plan.rows.compared = Compared::Materials;
    wall().setPlan(plan);
    ASSERT_TRUE(wall().wall().isTable());
    ASSERT_TRUE(isSettled());
    const QString b = writeEnvironment("b.hdr", 0.1f, 1.0f);
    const auto captioned = [](const char* text) {
        const std::vector<WallLayout::Caption>& all = overlay().layoutOfWall().captions;
        const auto found = std::ranges::find(all, QLatin1String(text), &WallLayout::Caption::text);
        return found != all.end() ? *found : WallLayout::Caption();
    };
    const WallLayout::Caption column = captioned("a");
    ASSERT_EQ(column.of.size(), 3u) << "all materials under it";
    const int before = undoCount();
    const QStringList lines = drop({b}, column.place.center());
    EXPECT_EQ(lines, QStringList{QStringLiteral("Replace the environment a by b.hdr")});
    EXPECT_EQ(environmentOf(column.of.front()), "b");
    EXPECT_EQ(document().environments.size(), 2u);
    EXPECT_EQ(undoCount(), before + 1);

    // Onto a row: all its cells.
    const WallLayout::Caption row = captioned("Gold");
    ASSERT_EQ(row.of.size(), 2u);
    drop({b}, row.place.center());
    for (const std::size_t cell : row.of)
        EXPECT_EQ(environmentOf(cell), "b");
}

TEST_F(WallDropTest, BuiltInSkiesOfTheLibraryAreTakenAsFilesAre) {
    const std::string before = environmentOf(0);
    const QStringList lines = drop({QStringLiteral("builtin:sunset")}, centreOf(1));
    ASSERT_EQ(lines.size(), 1);
    EXPECT_THAT(lines[0].toStdString(), testing::HasSubstr("with Sunset"));
    EXPECT_EQ(environmentOf(1), "Sunset");
    EXPECT_EQ(environmentOf(0), before);
    EXPECT_EQ(undoCount(), steps + 1) << "one environment came to the scene";
    controller().undoStack().undo();
    controller().undoStack().redo();
    EXPECT_EQ(environmentOf(1), "Sunset");

    // Onto one that is compared: it takes its place.
    WallPlan plan;
    plan.columns.compared = Compared::Environments;
    wall().setPlan(plan);
    ASSERT_TRUE(isSettled());
    ASSERT_EQ(wall().cells().size(), 2u);
    const QStringList replaced = drop({QStringLiteral("builtin:night")}, centreOf(1));
    EXPECT_EQ(replaced, QStringList{QStringLiteral("Replace the environment Sunset by Night")});
    EXPECT_EQ(environmentOf(1), "Night");
    EXPECT_EQ(document().environments.size(), 2u);
    EXPECT_EQ(undoCount(), steps + 2);
}

TEST_F(WallDropTest, OtherFilesGoTheirUsualWay) {
    const QStringList lines =
        drop({writeEnvironment("a.hdr", 1.0f, 0.1f), folder.filePath(QStringLiteral("notes.txt"))},
             centreOf(1));
    EXPECT_THAT(lines.join(QLatin1Char('\n')).toStdString(),
                testing::HasSubstr("Light the scene with a.hdr"));
    EXPECT_EQ(environmentTitle(document().environment()), "a");
    EXPECT_EQ(wall().cells()[1].own.element(CellElement::Environment), 0u);
}

TEST_F(WallDropTest, AFileThatCannotBeReadLeavesTheCellAsItWas) {
    const QString file = folder.filePath(QStringLiteral("broken.hdr"));
    QFile broken(file);
    ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
    broken.write("#?RADIANCE\nnothing");
    broken.close();
    QStringList said;
    const auto listening =
        QObject::connect(&controller(), &DocumentController::noticed,
                         [&](const UserNotice& notice) { said << notice.text << notice.details; });
    drop({file}, centreOf(1));
    QObject::disconnect(listening);
    EXPECT_EQ(wall().cells()[1].own.element(CellElement::Environment), 0u);
    EXPECT_EQ(document().environments.size(), 1u);
    EXPECT_THAT(said.join(QLatin1Char('\n')).toStdString(), testing::HasSubstr("broken.hdr"));
}

} // namespace
} // namespace patina::editor
