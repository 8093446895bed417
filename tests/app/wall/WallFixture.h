// The start scene with three materials in the real window, small, and its wall.
#pragma once

#include "app/editor/viewport/ViewState.h"
#include "app/editor/wall/WallOverlay.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QComboBox>
#include <QDir>
#include <QMenu>
#include <QToolButton>

namespace patina::editor {

class WallWindow : public EditorTest {
  protected:
    void SetUp() override {
        session->wall.setOn(false);
        EditorTest::SetUp();
        window->viewport().setFixedSize(360, 240);  // software OpenGL pays for each pixel
        window->viewport().setAddsSlowFrames(true); // pictures are compared, on busy machines too
        session->views.set({});
        controller().editStructure(QStringLiteral("Materials"), [](Document& document) {
            document.materials.resize(1);
            for (MeshInstance& mesh : document.meshes)
                mesh.material = document.materials[0].id;
            for (const char* name : {"Gold", "Clay"}) {
                Material material;
                material.name = name;
                material.baseColor = name[0] == 'G' ? glm::vec3(1.0f, 0.7f, 0.2f) : glm::vec3(0.4f);
                material.metallic = name[0] == 'G' ? 1.0f : 0.0f;
                addMaterial(document, material);
            }
        });
        steps = undoCount();
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        viewport().setFocus();
    }
    void TearDown() override { session->wall.setOn(false); }

    static ViewportWidget& viewport() { return window->viewport(); }
    static WallState& wall() { return session->wall; }
    static void key(Qt::Key code) { QTest::keyClick(&viewport(), code); }
    static bool isSettled() {
        return eventually([] { return viewport().isSettled(); });
    }
    static WallOverlay& overlay() { return *viewport().findChild<WallOverlay*>(); }
    static QRect placeOf(std::size_t cell) { return overlay().layoutOfWall().cells[cell]; }
    static QPoint centreOf(std::size_t cell) { return placeOf(cell).center(); }
    static void click(std::size_t cell, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::mouseClick(&viewport(), Qt::LeftButton, modifiers, centreOf(cell));
    }
    static void choose(const char* box, const char* what) {
        auto* found = find<QComboBox>(*window, QLatin1String(box));
        ASSERT_NE(found, nullptr);
        const int index = found->findText(QLatin1String(what));
        ASSERT_GE(index, 0);
        found->setFocus();
        found->setCurrentIndex(index);
        Q_EMIT found->activated(index);
        viewport().setFocus();
    }
    static QImage pictureOf(std::size_t cell) {
        return viewport().grabFramebuffer().copy(placeOf(cell));
    }
    static void keepPicture(const char* name) {
        const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (pictures.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(window->grab().save(QDir(pictures).filePath(QLatin1String(name))));
    }

    int steps = 0; // that the scene took
};

} // namespace patina::editor
