// The Light sweep dock by real events: lights are ranked, looked at and used in the scene.
#include "app/editor/sweep/LightSweepPanel.h"
#include "app/editor/sweep/SweepControls.h"
#include "app/editor/sweep/SweepModel.h"
#include "app/editor/sweep/SweepPicture.h"
#include "app/editor/sweep/SweepStrip.h"
#include "core/document/ViewChoices.h"
#include "core/edit/EditSession.h"
#include "core/io/ImageIO.h"
#include "core/light/LatLongGrid.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QHeaderView>
#include <QImage>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTableView>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

namespace patina::editor {
namespace {

using ::testing::HasSubstr;

class LightSweepTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        controller().openScene(QStringLiteral("builtin:sphere"));
        ASSERT_TRUE(settled(*session));
        window->resize(1440, 900);
        window->viewport().setFixedSize(200, 160);
        dock = window->findChild<QDockWidget*>(QStringLiteral("lightSweep"));
        if (!dock->isVisible())
            window->actions().lightSweep->trigger();
        ASSERT_TRUE(eventually([this] { return dock->isVisible(); }));
        ASSERT_EQ(panel().outcome(), nullptr) << "that of another scene went with it";
        check("Scene's environments", true);
        check("Built-in skies", false);
        check("Folder", false);
        control<QSpinBox>("Rotations").setValue(8);
        control<QComboBox>("Rank by").setCurrentIndex(0);
        control<QComboBox>("Compare with").setCurrentIndex(0);
    }
    static LightSweepPanel& panel() { return *window->findChild<LightSweepPanel*>(); }
    static QTableView& table() { return panel().table(); }
    template <class Widget>
    static Widget& control(const char* name) {
        Widget* found = find<Widget>(panel(), QString::fromLatin1(name));
        EXPECT_NE(found, nullptr) << name;
        return *found;
    }
    static void check(const char* name, bool on) { control<QCheckBox>(name).setChecked(on); }
    static QPushButton& button(const char* name) {
        return *panel().findChild<QPushButton*>(QString::fromLatin1(name));
    }
    static void click(QAbstractButton& one) { QTest::mouseClick(&one, Qt::LeftButton); }
    static bool swept() {
        const SweepOutcomePtr before = panel().outcome();
        click(button("sweepStart"));
        return eventually([&] { return !panel().isRunning(); }) && panel().outcome() != before;
    }
    static double cell(int row, int column) {
        return table().model()->index(row, column).data(SweepModel::SortRole).toDouble();
    }
    static std::string textOf(int row, int column) {
        return table().model()->index(row, column).data().toString().toStdString();
    }
    static void addSky(const char* source) {
        controller().addEnvironment(QString::fromLatin1(source),
                                    DocumentController::EnvironmentUse::Light);
        ASSERT_TRUE(settled(*session));
    }
    // Light from one side of such a colour.
    std::string write(const char* name, const glm::vec3& color) {
        const LatLongGrid grid(16);
        Image image(32, 16, 3, PixelType::F32, ColorEncoding::Linear);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 32; ++x)
                for (int c = 0; c < 3; ++c)
                    image.f32()[static_cast<std::size_t>(3 * (y * 32 + x) + c)] =
                        color[c] * (grid.direction(x, y).x > 0.3 ? 3.0f : 0.2f);
        const std::string file = folder.filePath(QString::fromLatin1(name)).toStdString();
        EXPECT_TRUE(saveImage(controller().worker(), image, file).ok());
        return file;
    }
    // Two environments and a file that is none.
    void sweepFolder() {
        write("blue.exr", {0.2f, 0.4f, 1.0f});
        write("red.exr", {1.0f, 0.3f, 0.2f});
        QFile broken(folder.filePath(QStringLiteral("broken.hdr")));
        ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
        broken.write("no picture");
        broken.close();
        check("Scene's environments", false);
        panel().controls().setFolder(folder.path());
        control<QSpinBox>("Rotations").setValue(4);
        ASSERT_TRUE(swept()) << panel().warning().toStdString();
    }
    static std::size_t lightOf(const char* title, double rotationDeg) {
        const SweepOutcome& outcome = *panel().outcome();
        for (std::size_t i = 0; i < outcome.sweep.scores.size(); ++i) {
            const SweepLight& light = outcome.sweep.scores[i].light;
            if (outcome.environments[light.environment].title == title &&
                light.rotationDeg == rotationDeg)
                return i;
        }
        ADD_FAILURE() << "no light " << title << " at " << rotationDeg;
        return 0;
    }
    QDockWidget* dock = nullptr;
};

} // namespace

TEST_F(LightSweepTest, TwoSkiesInEightRotationsAreSixteenRowsTheWorstFirst) {
    addSky("builtin:clear-sky");
    ASSERT_EQ(document().environments.size(), 2u);
    const Document before = document();
    ASSERT_TRUE(swept()) << panel().warning().toStdString();
    EXPECT_EQ(document(), before) << "a sweep edits nothing";
    ASSERT_EQ(table().model()->rowCount(), 16);
    for (int row = 0; row + 1 < 16; ++row) {
        EXPECT_EQ(textOf(row, SweepModel::Rank), std::to_string(row + 1));
        EXPECT_GE(cell(row, SweepModel::Score), cell(row + 1, SweepModel::Score)) << row;
    }
    EXPECT_GT(cell(0, SweepModel::Score), cell(15, SweepModel::Score));
    EXPECT_EQ(panel().selected(), rankLights(panel().outcome()->sweep, RankBy::Difference)[0]);
    EXPECT_THAT(panel().status().toStdString(), HasSubstr("16 lights of 2 environments"));
    EXPECT_THAT(panel().status().toStdString(), HasSubstr("quick bake"));
    EXPECT_FALSE(panel().isOfEarlierState());

    // Ranked by another score without another sweep; sorted by any column.
    const SweepOutcomePtr outcome = panel().outcome();
    control<QComboBox>("Rank by").setCurrentIndex(2);
    EXPECT_EQ(panel().outcome(), outcome);
    for (int row = 0; row + 1 < 16; ++row) {
        EXPECT_EQ(cell(row, SweepModel::Score), cell(row, SweepModel::Contrast));
        EXPECT_GE(cell(row, SweepModel::Score), cell(row + 1, SweepModel::Score)) << row;
    }
    const auto sortBy = [](int column) {
        QHeaderView& header = *table().horizontalHeader();
        table().scrollTo(table().model()->index(0, column));
        test::handleEvents();
        QTest::mouseClick(
            header.viewport(), Qt::LeftButton, {},
            QPoint(header.sectionViewportPosition(column) + header.sectionSize(column) / 2,
                   header.height() / 2));
    };
    sortBy(SweepModel::Rotation);
    for (int row = 0; row < 16; ++row)
        EXPECT_EQ(cell(row, SweepModel::Rotation), 45.0 * (row / 2)) << row;
    sortBy(SweepModel::Rank);
}

TEST_F(LightSweepTest, PicturesShowTheLightTheLookComparedWithAndAllRotations) {
    addSky("builtin:clear-sky");
    ASSERT_TRUE(swept());
    const SweepOutcome& outcome = *panel().outcome();
    EXPECT_EQ(outcome.pixels.height, 128);
    EXPECT_EQ(outcome.pixels.width, 160) << "as wide as the viewport, in proportion";
    ASSERT_EQ(panel().strip().count(), 8);
    ASSERT_TRUE(eventually([] { return !panel().lightPicture().picture().isNull(); }));
    const std::size_t worst = *panel().selected();
    const LightScore& score = outcome.sweep.scores[worst];
    // What is around the surfaces is cut off.
    const QRect seen = surfacesRect(outcome.pixels);
    EXPECT_LT(seen.width(), outcome.pixels.width);
    for (const std::uint32_t place : outcome.pixels.places)
        ASSERT_TRUE(seen.contains(static_cast<int>(place) % outcome.pixels.width,
                                  static_cast<int>(place) / outcome.pixels.width));
    const QPoint ring = QPoint(score.worstPixel.x, score.worstPixel.y) - seen.topLeft();
    EXPECT_EQ(panel().lightPicture().picture(),
              displayedImage(
                  sweepPicture(outcome.pixels, outcome.measured, outcome.settings, score.light),
                  outcome.settings.view)
                  .copy(seen));
    EXPECT_EQ(panel().lightPicture().marked(), ring);
    EXPECT_EQ(panel().referencePicture().picture(),
              displayedImage(outcome.sweep.reference, outcome.settings.view).copy(seen));
    // Where surfaces are it has colours, and nothing elsewhere.
    const QImage map = panel().sensitivityPicture().picture();
    EXPECT_EQ(qAlpha(map.pixel(0, 0)), 0);
    EXPECT_EQ(qAlpha(map.pixel(ring)), 255);

    // A picture of the strip is clicked: its light is chosen, in the table too.
    const int other = (panel().strip().currentRow() + 3) % 8;
    panel().strip().scrollToItem(panel().strip().item(other));
    test::handleEvents();
    QTest::mouseClick(panel().strip().viewport(), Qt::LeftButton, {},
                      panel().strip().visualItemRect(panel().strip().item(other)).center());
    EXPECT_EQ(*panel().selected(), worst - worst % 8 + static_cast<std::size_t>(other));
    const QModelIndex current = table().currentIndex();
    EXPECT_EQ(current.siblingAtColumn(SweepModel::Rotation).data(SweepModel::SortRole).toDouble(),
              45.0 * other);

    // A light of the other environment brings its rotations.
    const std::size_t opposite = (worst + 8) % 16;
    panel().select(opposite);
    EXPECT_EQ(panel().strip().currentRow(), static_cast<int>(opposite % 8));
    EXPECT_TRUE(eventually([&] { return !panel().strip().picture(opposite).isNull(); }));
}

TEST_F(LightSweepTest, AnEnvironmentOfAFolderIsUsedAsOneStepAndUndoRestoresAll) {
    sweepFolder();
    ASSERT_EQ(table().model()->rowCount(), 8);
    ASSERT_TRUE(panel().problems().isVisible());
    ASSERT_EQ(panel().problems().count(), 1);
    EXPECT_THAT(panel().problems().item(0)->text().toStdString(), HasSubstr("broken.hdr: "));
    EXPECT_GT(panel().problems().item(0)->text().size(), 14) << "with its reason";

    addSky("builtin:clear-sky"); // to fade from, to the first
    controller().fadeTo(document().environments.front().id);
    ASSERT_TRUE(settled(*session));
    const Document before = document();
    const int steps = undoCount();
    panel().select(lightOf("red", 270.0));
    click(button("sweepUse"));
    ASSERT_TRUE(eventually([&] { return undoCount() == steps + 1; }));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(undoCount(), steps + 1) << "one step";
    EXPECT_EQ(document().environments.size(), before.environments.size());
    EXPECT_EQ(document().environment().source,
              folder.filePath(QStringLiteral("red.exr")).toStdString());
    EXPECT_EQ(document().environment().kind, EnvironmentKind::Image);
    EXPECT_EQ(document().environment().rotationDeg, -90.0f) << "270°";
    EXPECT_EQ(document().mix.second, 0) << "alone";
    EXPECT_THAT(controller().session().undoText(), HasSubstr("Light with red at 270°"));
    EXPECT_FALSE(panel().isOfEarlierState()) << "it chose among what was swept";
    controller().undoStack().undo();
    EXPECT_EQ(document().environments, before.environments);
    EXPECT_EQ(document().mix.first, before.mix.first);
    EXPECT_EQ(document().mix.second, before.mix.second);
}

TEST_F(LightSweepTest, AnEnvironmentOfTheSceneIsUsedAgainAndNotReadAnew) {
    addSky("builtin:clear-sky");
    const Id first = document().environments.front().id, sky = document().environments.back().id;
    ASSERT_EQ(document().mix.first, sky);
    check("Built-in skies", true); // the clear sky and the studio among them are the scene's own
    control<QSpinBox>("Rotations").setValue(4);
    ASSERT_TRUE(swept());
    EXPECT_EQ(panel().outcome()->environments.size(), 6u) << "each sky once";
    const int steps = undoCount();
    panel().select(lightOf("Studio", 90.0));
    table().setFocus();
    QTest::keyClick(&table(), Qt::Key_Return);
    EXPECT_EQ(undoCount(), steps + 1) << "at once";
    EXPECT_EQ(document().environments.size(), 2u);
    EXPECT_EQ(document().mix.first, first);
    EXPECT_EQ(document().environment().rotationDeg, 90.0f);
    EXPECT_FALSE(panel().isOfEarlierState());
    controller().undoStack().undo();
    EXPECT_EQ(document().mix.first, sky);
    EXPECT_EQ(document().environment(first)->rotationDeg, 0.0f);
}

TEST_F(LightSweepTest, ACancelLeavesTheEarlierResult) {
    ASSERT_TRUE(swept());
    const SweepOutcomePtr earlier = panel().outcome();
    const int rows = table().model()->rowCount();
    check("Built-in skies", true);
    control<QSpinBox>("Rotations").setValue(360);
    click(button("sweepStart"));
    ASSERT_TRUE(panel().isRunning());
    EXPECT_EQ(button("sweepStart").text(), QStringLiteral("Cancel"));
    ASSERT_EQ(session->jobs.runningCount(), 1) << "a row of the Jobs dock";
    EXPECT_EQ(session->jobs.jobs().back().title, QStringLiteral("Light sweep"));
    click(button("sweepStart"));
    EXPECT_FALSE(panel().isRunning()) << "at once";
    ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    EXPECT_EQ(session->jobs.jobs().back().state, JobState::Cancelled);
    EXPECT_EQ(panel().outcome(), earlier);
    EXPECT_EQ(table().model()->rowCount(), rows);
    EXPECT_THAT(panel().warning().toStdString(), HasSubstr("the result before it stays"));
    EXPECT_EQ(button("sweepStart").text(), QStringLiteral("Start"));

    // In the Jobs dock, too.
    click(button("sweepStart"));
    session->jobs.cancelAll();
    ASSERT_TRUE(eventually([] { return !panel().isRunning(); }));
    EXPECT_EQ(panel().outcome(), earlier);
    EXPECT_THAT(panel().warning().toStdString(), HasSubstr("Cancelled"));

    // A result is of its document.
    controller().newDocument();
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(panel().outcome(), nullptr);
    EXPECT_TRUE(panel().warning().isEmpty());
}

TEST_F(LightSweepTest, TheRankingAndTheRotationsAreSavedAsFiles) {
    EXPECT_FALSE(button("sweepSave").isEnabled()) << "there is nothing to save";
    addSky("builtin:clear-sky");
    ASSERT_TRUE(swept());
    const SweepOutcomePtr outcome = panel().outcome();
    control<QComboBox>("Rank by").setCurrentIndex(1);
    panel().select(lightOf("Clear Sky", 90.0));
    const auto saveAs = [&](const char* name) {
        click(button("sweepSave"));
        auto* dialog = window->findChild<QFileDialog*>(QStringLiteral("sweepSaveDialog"));
        ASSERT_NE(dialog, nullptr);
        ASSERT_TRUE(eventually([&] { return dialog->isVisible(); }));
        // What is typed, in another folder than the one that is proposed.
        dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
            ->setText(folder.filePath(QLatin1String(name)));
        QTest::keyClick(dialog, Qt::Key_Return);
        ASSERT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
    };
    saveAs("ranking.json");
    std::ifstream file(folder.filePath(QStringLiteral("ranking.json")).toStdString());
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    ASSERT_FALSE(json.is_discarded());
    EXPECT_EQ(json["settings"]["by"], "clipping");
    EXPECT_EQ(json["settings"]["rotations"], 8);
    EXPECT_EQ(json["transfer"]["source"], "quick");
    EXPECT_EQ(json["counts"]["environments"], 2);
    const std::vector<std::size_t> order = rankLights(outcome->sweep, RankBy::Clipping);
    ASSERT_EQ(json["ranking"].size(), 16u);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const LightScore& score = outcome->sweep.scores[order[k]];
        const nlohmann::json& light = json["ranking"][k];
        EXPECT_EQ(light["environment"], outcome->environments[score.light.environment].title);
        EXPECT_EQ(light["file"], outcome->environments[score.light.environment].source);
        EXPECT_EQ(light["rotationDeg"], score.light.rotationDeg);
        EXPECT_EQ(light["score"], score.clipped.sum());
    }

    saveAs("rotations.png");
    const QImage sheet(folder.filePath(QStringLiteral("rotations.png")));
    ASSERT_FALSE(sheet.isNull());
    const QRect seen = surfacesRect(outcome->pixels);
    EXPECT_GE(sheet.width(), seen.width());
    // The light that is chosen is on it, texel for texel.
    const QImage picture =
        displayedImage(sweepPicture(outcome->pixels, outcome->measured, outcome->settings,
                                    outcome->sweep.scores[*panel().selected()].light),
                       outcome->settings.view)
            .copy(seen);
    bool found = false;
    for (int y = 0; y + picture.height() <= sheet.height() && !found; ++y)
        for (int x = 0; x + picture.width() <= sheet.width() && !found; ++x)
            found = sheet.pixel(x, y) == picture.pixel(0, 0) &&
                    sheet.copy(QRect(QPoint(x, y), picture.size())) == picture;
    EXPECT_TRUE(found);
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        EXPECT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(sheet.save(QDir(pictures).filePath(QStringLiteral("sweep-rotations.png"))));
    }

    // What is neither is said, and not written.
    QStringList said;
    const auto listening = QObject::connect(&controller(), &DocumentController::noticed,
                                            [&](const UserNotice& notice) { said << notice.text; });
    saveAs("ranking.txt");
    QObject::disconnect(listening);
    EXPECT_THAT(said.join(QLatin1Char(' ')).toStdString(), HasSubstr(".json"));
    EXPECT_FALSE(QFile::exists(folder.filePath(QStringLiteral("ranking.txt"))));
}

TEST_F(LightSweepTest, AnEditMakesTheResultOneOfAnEarlierStateUntilItIsUndoneOrRunAgain) {
    ASSERT_TRUE(swept());
    QPushButton& again = *find<QPushButton>(panel(), QStringLiteral("Run Again"));
    EXPECT_FALSE(again.isVisible());
    // What is behind the scene is in no picture of the sweep.
    controller().setParameter(parameter("environment.background"), {Scope::Environment, 0},
                              static_cast<int>(BackgroundMode::Color));
    EXPECT_FALSE(panel().isOfEarlierState());
    const Id material = document().materials.front().id;
    controller().setParameter(parameter("material.baseColor"), {Scope::Material, material},
                              glm::vec3(0.9f, 0.1f, 0.1f));
    EXPECT_TRUE(panel().isOfEarlierState());
    EXPECT_TRUE(again.isVisible());
    EXPECT_THAT(panel().warning().toStdString(), HasSubstr("has changed since this sweep"));
    controller().undoStack().undo();
    EXPECT_FALSE(panel().isOfEarlierState());
    EXPECT_FALSE(again.isVisible());

    controller().undoStack().redo();
    const SweepOutcomePtr earlier = panel().outcome();
    click(again);
    ASSERT_TRUE(eventually([] { return !panel().isRunning(); }));
    EXPECT_NE(panel().outcome(), earlier);
    EXPECT_FALSE(panel().isOfEarlierState());
    EXPECT_NE(panel().outcome()->sweep.reference, earlier->sweep.reference) << "it is red";
}

TEST_F(LightSweepTest, TheScenesLightIsComparedWithAndSweptToo) {
    controller().setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 45.0f);
    write("blue.exr", {0.2f, 0.4f, 1.0f});
    check("Scene's environments", false);
    panel().controls().setFolder(folder.path());
    control<QComboBox>("Compare with").setCurrentIndex(1);
    ASSERT_TRUE(swept());
    const SweepOutcome& outcome = *panel().outcome();
    ASSERT_EQ(outcome.environments.size(), 2u);
    EXPECT_THAT(panel().referencePicture().title().toStdString(),
                HasSubstr("Scene's light: Studio at 45°"));
    // The light that was compared with differs from itself by nothing.
    EXPECT_LT(outcome.sweep.scores[lightOf("Studio", 45.0)].difference.worst, 1e-6);
    EXPECT_EQ(textOf(0, SweepModel::Name), "blue");
}

TEST_F(LightSweepTest, SaysWhyThereIsNothingToRank) {
    check("Scene's environments", false);
    EXPECT_FALSE(button("sweepStart").isEnabled()) << "nothing is chosen";
    check("Scene's environments", true);
    std::vector<Id> materials;
    for (const Material& material : document().materials)
        materials.push_back(material.id);
    for (const Id material : materials)
        controller().setParameter(parameter("material.baseColor"), {Scope::Material, material},
                                  glm::vec3(0.0f));
    EXPECT_FALSE(swept());
    EXPECT_EQ(panel().outcome(), nullptr);
    EXPECT_THAT(panel().warning().toStdString(), HasSubstr("is metal or black"));
    controller().setParameter(parameter("view.toneMap"), {Scope::View, 0},
                              static_cast<int>(ToneMap::OpenColorIo));
    EXPECT_FALSE(swept());
    EXPECT_THAT(panel().warning().toStdString(), HasSubstr("OpenColorIO"));
}

} // namespace patina::editor
