// A lesson in the window, by mouse and keys: a COLLADA scene is dropped, lit by radiosity, stepped
// through, looked into, divided where light changes, mixed, recoloured, exported and opened again.
#include "app/editor/job/JobManager.h"
#include "app/editor/radiosity/RadiosityExportDialog.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/RadiosityDockFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QTreeWidget>
#include <QUrl>

namespace patina::editor {
namespace {

// A floor under a glowing square, with what only COLLADA knows: a camera, an animation, an extra.
constexpr const char* kLessonScene = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<!-- drawn by hand -->
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified><unit name="metre" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_cameras><camera id="cam"><optics><technique_common><perspective><yfov>40</yfov><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>50</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_animations><animation id="wait"/></library_animations>
<library_effects>
<effect id="white-fx"><profile_COMMON><technique sid="common"><lambert><diffuse><color>0.8 0.8 0.8 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="lamp-fx"><profile_COMMON><technique sid="common"><lambert><emission><color>1 1 1 1</color></emission><diffuse><color>0 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="white" name="White"><instance_effect url="#white-fx"/></material><material id="lamp" name="Lamp"><instance_effect url="#lamp-fx"/></material></library_materials>
<library_geometries>
<geometry id="floor" name="Floor"><mesh><source id="f"><float_array id="f-a" count="12">-1 0 -1 -1 0 1 1 0 1 1 0 -1</float_array><technique_common><accessor source="#f-a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="f-v"><input semantic="POSITION" source="#f"/></vertices><triangles count="2" material="m"><input semantic="VERTEX" source="#f-v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>
<geometry id="square" name="Square"><mesh><source id="s"><float_array id="s-a" count="12">-0.3 1 -0.3 0.3 1 -0.3 0.3 1 0.3 -0.3 1 0.3</float_array><technique_common><accessor source="#s-a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="s-v"><input semantic="POSITION" source="#s"/></vertices><triangles count="2" material="m"><input semantic="VERTEX" source="#s-v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="scene">
<node id="Floor" name="Floor"><instance_geometry url="#floor"><bind_material><technique_common><instance_material symbol="m" target="#white"/></technique_common></bind_material></instance_geometry></node>
<node id="Square" name="Square"><instance_geometry url="#square"><bind_material><technique_common><instance_material symbol="m" target="#lamp"/></technique_common></bind_material></instance_geometry></node>
<extra><technique profile="LESSON"><room>12</room></technique></extra>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";

struct RadiosityLesson : RadiosityWindow {
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(320, 240); // software OpenGL pays for each pixel
        if (!window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
    }
    void TearDown() override {
        controller().openScene(QStringLiteral("builtin:plane"));
        EXPECT_TRUE(settled(*session));
        if (window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
    }

    [[nodiscard]] QString file(const char* name) const {
        return folder.filePath(QLatin1String(name));
    }
    static void dropOnWindow(const QString& path) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(path)});
        QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QCoreApplication::sendEvent(window.get(), &enter);
        QDropEvent event({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QCoreApplication::sendEvent(window.get(), &event);
    }
    void openLesson() {
        QFile scene(file("lesson.dae"));
        ASSERT_TRUE(scene.open(QIODevice::WriteOnly));
        scene.write(kLessonScene);
        scene.close();
        dropOnWindow(scene.fileName());
        ASSERT_TRUE(settled(*session));
        ASSERT_EQ(document().meshes.size(), 2u);
        set("environment.enabled", {Scope::Environment, 0}, false);
        set("view.radiosityArea", {Scope::View, 0}, 0.05f);
        set("view.radiosityRays", {Scope::View, 0}, 64.0f);
        press("radiosityLight");
        ASSERT_TRUE(solved()) << radiosity().failure().toStdString();
    }
    // By the dialog; what it says when it is done.
    static UserNotice exported(const QString& path, int light = 0, bool intoOrigin = true) {
        UserNotice said;
        QObject here;
        QObject::connect(&controller(), &DocumentController::noticed, &here,
                         [&](const UserNotice& notice) { said = notice; });
        EXPECT_TRUE(window->actions().exportRadiosity->isEnabled());
        window->actions().exportRadiosity->trigger();
        auto* dialog = part<QDialog>("radiosityExportDialog");
        if (dialog == nullptr)
            return said;
        auto* name = part<QLineEdit>("radiosityExportPath");
        name->setFocus();
        name->selectAll();
        QTest::keyClicks(name, path);
        part<QComboBox>("radiosityExportLight")->setCurrentIndex(light);
        auto* into = part<QCheckBox>("radiosityExportIntoOrigin");
        if (into->isEnabled() && into->isChecked() != intoOrigin)
            into->click();
        auto* run = part<QPushButton>("radiosityExportRun");
        EXPECT_TRUE(run->isEnabled()) << path.toStdString();
        QTest::mouseClick(run, Qt::LeftButton);
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        EXPECT_TRUE(eventually([&] { return !said.text.isEmpty(); }));
        return said;
    }
};

TEST_F(RadiosityLesson, FromADropToAFileThatIsOpenedAgain) {
    openLesson();
    const auto stepped = [](std::uint64_t shots) {
        return eventually([=] { return radiosity().step() && radiosity().step()->done == shots; });
    };
    press("radiosityFirst");
    ASSERT_TRUE(stepped(0));
    press("radiosityNext");
    ASSERT_TRUE(stepped(1));
    press("radiosityBack");
    ASSERT_TRUE(stepped(0));
    press("radiositySolved");
    ASSERT_TRUE(eventually([] { return !radiosity().step(); }));
    ASSERT_TRUE(solved());

    // The floor, right below the middle of the picture.
    Camera camera = document().view.camera;
    camera.pitchDeg = 50.0f;
    camera.yawDeg = 0.0f;
    camera.target = glm::vec3(0.0f);
    camera.distance = 4.0f;
    controller().setCamera(camera);
    ASSERT_TRUE(eventually([] { return window->viewport().isSettled(); }));
    QTest::mouseClick(&window->viewport(), Qt::LeftButton, {},
                      window->viewport().rect().center() + QPoint(40, 40));
    ASSERT_TRUE(radiosity().chosen());
    auto* flow = part<QTreeWidget>("radiosityFlow");
    ASSERT_EQ(flow->topLevelItemCount(), 3);
    EXPECT_EQ(flow->topLevelItem(0)->child(0)->text(0), QStringLiteral("Glowing surfaces"));

    const std::size_t even = radiosity().live()->elements().size();
    set("view.radiosityAdaptive", {Scope::View, 0}, 0.15f);
    ASSERT_TRUE(solved());
    EXPECT_GT(radiosity().live()->elements().size(), even) << "divided where light changes";

    // A lamp, and the mixer's mute: the solution of it alone is taken out again.
    controller().addLight(LightType::Sphere);
    const Target lamp{Scope::Light, document().lights.back().id};
    set("light.position", lamp, glm::vec3(0.6f, 0.5f, 0.6f));
    ASSERT_TRUE(solved());
    const auto both = radiosity().live()->solution.radiosity;
    set("light.enabled", lamp, false);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->switchedOff.size(), 1u);
    EXPECT_NE(radiosity().live()->solution.radiosity, both);

    const Id white = document().meshes.front().material;
    set("material.baseColor", {Scope::Material, white}, glm::vec3(0.7f, 0.1f, 0.1f));
    ASSERT_TRUE(solved());

    const UserNotice said = exported(file("lit.dae"));
    EXPECT_EQ(said.kind, NoticeKind::Info) << said.text.toStdString();
    EXPECT_TRUE(said.text.contains(QStringLiteral("lit.dae"))) << said.text.toStdString();
    QFile lit(file("lit.dae"));
    ASSERT_TRUE(lit.open(QIODevice::ReadOnly));
    const QByteArray text = lit.readAll();
    // What Patina does not know is still there.
    for (const char* kept : {"<!-- drawn by hand -->", "<camera id=\"cam\">",
                             "<animation id=\"wait\"", "<room>12</room>"})
        EXPECT_TRUE(text.contains(kept)) << kept;
    EXPECT_TRUE(text.contains("COLOR"));

    controller().openScene(file("lit.dae"));
    ASSERT_TRUE(settled(*session));
    ASSERT_GE(document().meshes.size(), 2u);
    EXPECT_GT(document().meshes.front().mesh->triangleCount(), 2u) << "divided as it was solved";
}

TEST_F(RadiosityLesson, EveryFormatIsWrittenAndTheScenesOwnFileIsNot) {
    openLesson();
    for (const char* name : {"a.glb", "b.gltf", "c.ply"}) {
        const UserNotice said = exported(file(name));
        EXPECT_EQ(said.kind, NoticeKind::Info) << said.text.toStdString();
        EXPECT_TRUE(QFile::exists(file(name))) << name;
    }
    EXPECT_EQ(exported(file("texels.dae"), 1).kind, NoticeKind::Info);
    EXPECT_TRUE(QFile::exists(file("texels_light-map.png")));
    EXPECT_TRUE(QFile::exists(file("texels_light-map.exr")));
    const UserNotice fresh = exported(file("new.dae"), 0, false);
    EXPECT_EQ(fresh.kind, NoticeKind::Info) << fresh.text.toStdString();
    QFile written(file("new.dae"));
    ASSERT_TRUE(written.open(QIODevice::ReadOnly));
    EXPECT_FALSE(written.readAll().contains("drawn by hand"));

    window->actions().exportRadiosity->trigger();
    auto* name = part<QLineEdit>("radiosityExportPath");
    name->selectAll();
    QTest::keyClicks(name, file("lesson.dae"));
    EXPECT_FALSE(part<QPushButton>("radiosityExportRun")->isEnabled());
    part<QDialog>("radiosityExportDialog")->reject();
    EXPECT_TRUE(eventually([] { return window->findChild<RadiosityExportDialog*>() == nullptr; }));
}

} // namespace
} // namespace patina::editor
