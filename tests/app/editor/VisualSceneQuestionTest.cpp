// Several visual scenes in a COLLADA file: asked about after opening; another one opens instead.
#include "app/editor/VisualSceneQuestion.h"
#include "tests/app/editor/EditorFixture.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <fstream>

namespace patina::editor {
namespace {

constexpr const char* kTwoRooms = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes>
<visual_scene id="hall" name="Hall"><node name="A"><instance_geometry url="#g"/></node></visual_scene>
<visual_scene id="attic" name="Attic"><node name="A"><instance_geometry url="#g"/></node>
<node name="B"><translate>2 0 0</translate><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#hall"/></scene></COLLADA>)";

TEST(VisualSceneQuestion, OpensAnotherSceneThanTheFileNames) {
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("rooms.dae"));
    std::ofstream(file.toStdString()) << kTwoRooms;
    Session session;
    QWidget window;
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window, 60'000));
    VisualSceneQuestion asks(session.controller, window);
    QObject::connect(&asks, &VisualSceneQuestion::chosen, &session.controller,
                     [&](const QString& scene) { session.controller.openScene(scene); });
    QSignalSpy opened(&session.controller, &DocumentController::sceneOpened);
    const auto question = [&] { return window.findChild<QDialog*>("visualSceneQuestion"); };

    session.controller.openScene(file);
    ASSERT_TRUE(settled(session));
    EXPECT_EQ(session.controller.document().meshes.size(), 1u);
    ASSERT_NE(question(), nullptr);
    auto* list = question()->findChild<QListWidget*>("visualScenes");
    ASSERT_EQ(list->count(), 2);
    EXPECT_EQ(list->item(0)->text(), "Hall (open)");
    EXPECT_EQ(list->item(1)->text(), "Attic");
    QPushButton* open = nullptr;
    for (QAbstractButton* button : question()->findChild<QDialogButtonBox*>()->buttons())
        if (button->text() == "&Open Scene")
            open = qobject_cast<QPushButton*>(button);
    ASSERT_NE(open, nullptr);
    EXPECT_FALSE(open->isEnabled()) << "it is open already";
    list->setCurrentRow(1);
    QTest::mouseClick(open, Qt::LeftButton);
    ASSERT_TRUE(eventually([&] { return question() == nullptr; }));
    ASSERT_TRUE(eventually([&] { return opened.count() == 2; }));
    ASSERT_TRUE(settled(session));
    EXPECT_EQ(session.controller.document().meshes.size(), 2u);
    EXPECT_EQ(question(), nullptr) << "it was chosen";
    // The list of recent files names the file, which asks again.
    EXPECT_EQ(opened.last().first().toString(), file);
}

} // namespace
} // namespace patina::editor
