// A project that is opened again is lit at once by the radiosity that was solved before.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "tests/app/editor/RadiosityDockFixture.h"

#include "app/editor/radiosity/RadiosityPanel.h"
#include "app/editor/radiosity/RadiosityUpdater.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace patina::editor {
namespace {

namespace fs = std::filesystem;

struct KeptRadiosity : RadiosityWindow {
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(240, 200); // software OpenGL pays for each pixel
        controller().openScene(QStringLiteral("builtin:cornell-reference"));
        ASSERT_TRUE(settled(*session));
        putUnderSky(controller());
        ASSERT_TRUE(eventually([] { return !radiosity().keeping(); })); // of the test before
        fs::remove_all(radiosityCacheFolder());
        set("environment.enabled", {Scope::Environment, 0}, false);
        set("view.radiosityArea", {Scope::View, 0}, 0.02f);
        set("view.radiosityRays", {Scope::View, 0}, 64.0f);
        controller().addLight(LightType::Sphere);
        set("light.position", light(), document().bounds().center());
        if (!window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
        press("radiosityLight");
        ASSERT_TRUE(solved());
        ASSERT_EQ(radiosity().live()->sources.size(), 2u);
        file = folder.filePath(QStringLiteral("kept.patina"));
    }
    void TearDown() override {
        for (const QMetaObject::Connection& connection : connections)
            QObject::disconnect(connection);
        if (window->actions().radiosity->isChecked())
            window->actions().radiosity->trigger();
    }

    static Target light() { return {Scope::Light, document().lights.back().id}; }
    static QString words(const char* name) {
        auto* label = window->findChild<QLabel*>(QLatin1String(name));
        return label ? label->text() : QString();
    }
    static void press(const char* name) {
        auto* button = window->findChild<QPushButton*>(QLatin1String(name));
        ASSERT_NE(button, nullptr) << name;
        ASSERT_TRUE(button->isEnabled()) << name;
        QTest::mouseClick(button, Qt::LeftButton);
    }
    static std::size_t keptFiles() {
        std::error_code none;
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(radiosityCacheFolder(), none), {}));
    }
    void save() const {
        bool ok = false;
        controller().saveAs(file, [&](bool worked) { ok = worked; });
        ASSERT_TRUE(eventually([&] { return ok; }));
    }
    // Leaves the project: what is solved is kept without a pause.
    static void leave() {
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        ASSERT_TRUE(eventually([] { return document().meshes.size() == 1; }));
    }
    // Opens it again; what was shown on the way is in `seen`, what the dock said in `said`.
    void reopen() {
        connections.push_back(QObject::connect(&radiosity(), &RadiosityUpdater::shownChanged, [&] {
            if (radiosity().live())
                seen.push_back(radiosity().live());
        }));
        connections.push_back(QObject::connect(&radiosity(), &RadiosityUpdater::changed, [&] {
            said += words("radiosityStatus") + QLatin1Char('\n') + words("radiosityStep") +
                    QLatin1Char('\n');
        }));
        controller().openScene(file);
        ASSERT_TRUE(settled(*session));
        ASSERT_TRUE(eventually([] { return radiosity().live() != nullptr; }));
    }

    QString file, said;
    std::vector<LiveRadiosityPtr> seen;
    std::vector<QMetaObject::Connection> connections;
};

TEST_F(KeptRadiosity, AProjectOpenedAgainIsLitAtOnce) {
    const LiveRadiosityPtr before = radiosity().live();
    EXPECT_EQ(before->foundSources(), 0u);
    save();
    leave();
    ASSERT_TRUE(eventually([] { return keptFiles() == 2; }));
    reopen();
    ASSERT_TRUE(solved());
    ASSERT_FALSE(seen.empty());
    EXPECT_TRUE(seen.front()->solved) << "no sweep is shown";
    EXPECT_EQ(seen.front()->foundSources(), 2u);
    EXPECT_EQ(seen.front()->factors, nullptr);
    EXPECT_EQ(seen.front()->solution.radiosity, before->solution.radiosity);
    // Then what steps and edits need.
    EXPECT_TRUE(said.contains(QStringLiteral("computing form factors"))) << said.toStdString();
    EXPECT_TRUE(said.contains(QStringLiteral("Computing form factors"))) << "below the steps";
    EXPECT_FALSE(said.contains(QStringLiteral("direct light so far"))) << said.toStdString();
    EXPECT_TRUE(radiosity().canStep());
    EXPECT_EQ(radiosity().live()->solution.radiosity, before->solution.radiosity);
    EXPECT_TRUE(radiosity().live()->factors);
    auto* status = window->findChild<QLabel*>(QStringLiteral("radiosityStatus"));
    EXPECT_TRUE(status->toolTip().contains(QStringLiteral("cache")))
        << status->toolTip().toStdString();
    press("radiosityFirst");
    EXPECT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done == 0; }));
    press("radiosityNext");
    EXPECT_TRUE(eventually([] { return radiosity().step() && radiosity().step()->done == 1; }));
}

TEST_F(KeptRadiosity, EditsOfAProjectOpenedAgainAreSolved) {
    save();
    leave();
    ASSERT_TRUE(eventually([] { return keptFiles() == 2; }));
    reopen();
    const LiveRadiosityPtr found = radiosity().live();
    ASSERT_EQ(found->foundSources(), 2u);
    // Whether form factors are there by now or not.
    glm::vec3 position = document().bounds().center();
    position.x += 0.1f;
    set("light.position", light(), position);
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->foundSources(), 1u);
    EXPECT_NE(radiosity().live()->solution.radiosity, found->solution.radiosity);
    EXPECT_TRUE(radiosity().canStep());
    // What the edit came to is kept without being left, and one that follows is another file.
    EXPECT_TRUE(eventually([] { return keptFiles() == 3; }));
    controller().undoStack().undo();
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->solution.radiosity, found->solution.radiosity);
}

TEST_F(KeptRadiosity, AnEditThatIsTakenBackIsFound) {
    const LiveRadiosityPtr before = radiosity().live();
    ASSERT_TRUE(eventually([] { return keptFiles() == 2; })) << "once nothing is edited";
    const Id material = document().meshes.front().material;
    set("material.baseColor", {Scope::Material, material}, glm::vec3(0.9f, 0.2f, 0.1f));
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->foundSources(), 0u);
    controller().undoStack().undo();
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->foundSources(), 2u);
    EXPECT_EQ(radiosity().live()->solution.radiosity, before->solution.radiosity);
    EXPECT_TRUE(radiosity().live()->factors) << "of the same elements";
}

TEST_F(KeptRadiosity, StopLeavesTheFormFactorsOut) {
    save();
    leave();
    ASSERT_TRUE(eventually([] { return keptFiles() == 2; }));
    connections.push_back(QObject::connect(&radiosity(), &RadiosityUpdater::changed, [&] {
        if (radiosity().findingFactors() && !radiosity().stopped())
            press("radiositySolve");
    }));
    reopen();
    ASSERT_TRUE(eventually([] { return radiosity().stopped() && !radiosity().findingFactors(); }));
    EXPECT_TRUE(radiosity().live()->solved) << "the light stays";
    EXPECT_FALSE(radiosity().canStep());
    EXPECT_TRUE(words("radiosityStep").contains(QStringLiteral("Solve Again")))
        << words("radiosityStep").toStdString();
    QObject::disconnect(connections.front());
    press("radiositySolve");
    ASSERT_TRUE(solved());
    EXPECT_TRUE(radiosity().canStep());
}

TEST_F(KeptRadiosity, DamagedFilesAreSolvedAnew) {
    const LiveRadiosityPtr before = radiosity().live();
    save();
    leave();
    ASSERT_TRUE(eventually([] { return keptFiles() == 2; }));
    for (const auto& entry : fs::directory_iterator(radiosityCacheFolder()))
        std::ofstream(entry.path(), std::ios::binary) << "damaged";
    reopen();
    ASSERT_TRUE(solved());
    EXPECT_EQ(radiosity().live()->foundSources(), 0u);
    EXPECT_EQ(radiosity().live()->solution.radiosity, before->solution.radiosity);
    EXPECT_TRUE(eventually([] { return keptFiles() == 2; })) << "kept anew";
}

} // namespace
} // namespace patina::editor
