// A turntable as files: each picture is the one that the command line draws; what is cancelled says
// what it leaves.
#include "app/editor/turntable/TurntableDialog.h"
#include "app/editor/widget/NoticeArea.h"
#include "core/edit/EditSession.h"
#include "core/io/ImageIO.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Events.h"

#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QStandardItemModel>
#include <cmath>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

using ::testing::HasSubstr;

class TurntableTest : public EditorTest {
  protected:
    void SetUp() override {
        window->viewport().setFixedSize(120, 90); // software OpenGL pays for each pixel
        EditorTest::SetUp();
        session->views.set({});
        m_path = qgetenv("PATH");
    }
    void TearDown() override {
        qputenv("PATH", m_path);
        session->jobs.cancelAll();
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        session->jobs.clearFinished();
    }

    [[nodiscard]] QString path(const char* name) const {
        return folder.filePath(QLatin1String(name));
    }
    [[nodiscard]] TurntableOrder order(const char* name, int count) const {
        TurntableOrder order;
        order.file = path(name);
        order.count = count;
        order.width = 64;
        order.height = 40;
        return order;
    }
    static JobRecord ended() {
        EXPECT_TRUE(eventually([] { return session->jobs.runningCount() == 0; }));
        const std::vector<JobRecord> jobs = session->jobs.jobs();
        return jobs.empty() ? JobRecord() : jobs.back();
    }
    // A program called ffmpeg that does what the test says, in front of the others.
    void installFfmpeg(const QByteArray& script) {
        const QString bin = path("bin");
        ASSERT_TRUE(QDir().mkpath(bin));
        QFile program(bin + QStringLiteral("/ffmpeg"));
        ASSERT_TRUE(program.open(QIODevice::WriteOnly));
        program.write("#!/bin/sh\n" + script + "\n");
        program.close();
        program.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        qputenv("PATH", bin.toLocal8Bit() + ":" + m_path);
    }
    static double rmse(const QImage& a, const QImage& b) {
        EXPECT_FALSE(a.isNull() || b.isNull());
        EXPECT_EQ(a.size(), b.size());
        double sum = 0.0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) {
                const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
                sum += std::pow(p.redF() - q.redF(), 2) + std::pow(p.greenF() - q.greenF(), 2) +
                       std::pow(p.blueF() - q.blueF(), 2);
            }
        return std::sqrt(sum / (3.0 * a.width() * a.height()));
    }
    void saveScene(const QString& file) {
        bool saved = false;
        controller().saveAs(file, [&](bool done) { saved = done; });
        ASSERT_TRUE(eventually([&] { return saved; }));
    }
    static void runCommand(const QStringList& arguments) {
        QProcess patina;
        patina.start(qEnvironmentVariable("PATINA_BIN_DIR") + QStringLiteral("/patina"), arguments);
        ASSERT_TRUE(patina.waitForFinished(120'000)) << patina.errorString().toStdString();
        ASSERT_EQ(patina.exitCode(), 0) << patina.readAllStandardError().toStdString();
    }
    static TurntableDialog* openDialog() {
        window->actions().exportTurntable->trigger();
        for (auto* dialog : window->findChildren<TurntableDialog*>())
            if (dialog->isVisible())
                return dialog;
        return nullptr;
    }
    template <class Widget>
    static Widget& part(TurntableDialog& dialog, const char* name) {
        return *dialog.findChild<Widget*>(QLatin1String(name));
    }

  private:
    QByteArray m_path;
};

TEST_F(TurntableTest, PicturesAreThoseOfTheCommandLine) {
    // Edits that follow are not in them.
    controller().setParameter(parameter("environment.rotationDeg"),
                              {Scope::Environment, document().mix.first}, 30.0f);
    ASSERT_TRUE(settled(*session));
    saveScene(path("scene.patina"));
    saveTurntable(order("turn.png", 3), *session);
    controller().setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 3.0f);
    const JobRecord turn = ended();
    ASSERT_EQ(turn.state, JobState::Done) << turn.summary.toStdString();
    EXPECT_THAT(turn.summary.toStdString(), HasSubstr("turn-0001.png to turn-0003.png"));
    controller().undoStack().undo();
    TurntableOrder light = order("light.png", 4);
    light.turning = Turning::Environment;
    saveTurntable(light, *session);
    ASSERT_EQ(ended().state, JobState::Done);

    const auto draw = [&](const QStringList& options, const char* file) {
        runCommand(QStringList{QStringLiteral("render"), path("scene.patina"),
                               QStringLiteral("--size"), QStringLiteral("64x40"),
                               QStringLiteral("-o"), path(file)} +
                   options);
    };
    draw({QStringLiteral("--turntable"), QStringLiteral("3")}, "line.png");
    draw({QStringLiteral("--light-turn"), QStringLiteral("4")}, "sun.png");
    const auto numbered = [&](const char* name, int i) {
        return QImage(
            folder.filePath(QStringLiteral("%1-000%2.png").arg(QLatin1String(name)).arg(i)));
    };
    for (int i = 1; i <= 3; ++i)
        EXPECT_LE(rmse(numbered("turn", i), numbered("line", i)), 0.0005) << i;
    for (int i = 1; i <= 4; ++i)
        EXPECT_LE(rmse(numbered("light", i), numbered("sun", i)), 0.0005) << i;
    // A view of a term, too.
    session->views.show(shading::kViewBaseColor);
    saveTurntable(order("colour.png", 2), *session);
    session->views.set({});
    ASSERT_EQ(ended().state, JobState::Done);
    draw({QStringLiteral("--turntable"), QStringLiteral("2"), QStringLiteral("--view"),
          QStringLiteral("baseColor")},
         "seen.png");
    for (int i = 1; i <= 2; ++i)
        EXPECT_LE(rmse(numbered("colour", i), numbered("seen", i)), 0.0005) << i;
    EXPECT_GT(rmse(numbered("colour", 1), numbered("line", 1)), 0.01);
    EXPECT_GT(rmse(numbered("turn", 1), numbered("turn", 2)), 0.01);
    EXPECT_GT(rmse(numbered("light", 1), numbered("light", 3)), 0.01);
}

TEST_F(TurntableTest, AVideoIsWhatFfmpegMakesOfThePictures) {
    installFfmpeg("for last in \"$@\"; do :; done\ncat > \"$last\"");
    saveTurntable(order("turn.mp4", 3), *session);
    ASSERT_EQ(ended().state, JobState::Done);
    EXPECT_EQ(QFileInfo(path("turn.mp4")).size(), 3 * 64 * 40 * 3);

    TurntableOrder linear = order("turn.exr", 2);
    saveTurntable(linear, *session);
    ASSERT_EQ(ended().state, JobState::Done);
    const auto exr = loadImage(controller().worker(), path("turn-0002.exr").toStdString());
    ASSERT_TRUE(exr) << exr.error().text();
    EXPECT_EQ(exr->image().type(), PixelType::F32);
}

TEST_F(TurntableTest, ACancelKeepsNumberedPicturesAndNoVideo) {
    QStringList said;
    const auto listening = QObject::connect(&controller(), &DocumentController::noticed,
                                            [&](const UserNotice& notice) { said << notice.text; });
    saveTurntable(order("long.png", kMostSequenceFrames), *session);
    ASSERT_TRUE(eventually([&] { return QFile::exists(path("long-0002.png")); }));
    session->jobs.cancelAll();
    const JobRecord pictures = ended();
    EXPECT_EQ(pictures.state, JobState::Cancelled);
    EXPECT_THAT(pictures.summary.toStdString(), HasSubstr("long-0001.png to long-00"));
    EXPECT_TRUE(eventually([&] { return said.contains(pictures.summary); }));
    QObject::disconnect(listening);
    EXPECT_TRUE(QFile::exists(path("long-0001.png")));

    // While ffmpeg takes nothing: what waits for it is cancelled, too.
    installFfmpeg("touch \"" + path("started").toLocal8Bit() + "\"\nexec sleep 1000");
    TurntableOrder video = order("long.mp4", kMostSequenceFrames);
    saveTurntable(video, *session);
    ASSERT_TRUE(eventually([&] { return QFile::exists(path("started")); }));
    session->jobs.cancelAll();
    EXPECT_EQ(ended().state, JobState::Cancelled);
    EXPECT_FALSE(QFile::exists(path("long.mp4")));
}

TEST_F(TurntableTest, AnErrorNamesWhatWasWritten) {
    TurntableOrder large = order("large.png", 2);
    large.samples = 1024;
    saveTurntable(large, *session);
    const JobRecord refused = ended();
    EXPECT_EQ(refused.state, JobState::Failed);
    EXPECT_THAT(refused.summary.toStdString(), HasSubstr("choose fewer samples"));

    QDir(folder.path()).mkpath(QStringLiteral("turn-0002.png")); // where a picture should be
    saveTurntable(order("turn.png", 3), *session);
    const JobRecord failed = ended();
    EXPECT_EQ(failed.state, JobState::Failed);
    EXPECT_THAT(failed.summary.toStdString(), HasSubstr("1 of 3 pictures were written"));
}

TEST_F(TurntableTest, TheDialogSaysWhatItWillWrite) {
    TurntableDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    auto& summary = part<QLabel>(*dialog, "turntableSummary");
    auto& count = part<QSpinBox>(*dialog, "turntableCount");
    auto& rate = part<QSpinBox>(*dialog, "turntableRate");
    auto& length = part<QDoubleSpinBox>(*dialog, "turntableLength");
    auto& preset = part<QComboBox>(*dialog, "turntablePreset");
    auto& width = part<QSpinBox>(*dialog, "turntableWidth");
    auto& height = part<QSpinBox>(*dialog, "turntableHeight");
    auto& file = part<QLineEdit>(*dialog, "turntablePath");
    auto& run = part<QPushButton>(*dialog, "turntableRun");
    // Length and pictures follow each other.
    count.setValue(48);
    rate.setValue(24);
    EXPECT_DOUBLE_EQ(length.value(), 2.0);
    rate.setValue(12);
    EXPECT_DOUBLE_EQ(length.value(), 4.0);
    length.setValue(0.5);
    EXPECT_EQ(count.value(), 6);
    length.setValue(0.0);
    EXPECT_EQ(count.value(), 2) << "no fewer turn";
    EXPECT_DOUBLE_EQ(length.value(), std::round(200.0 / 12.0) / 100.0);
    count.setValue(3);
    // As do size and preset.
    EXPECT_EQ(width.value(), 1280);
    preset.setCurrentIndex(preset.findText(QStringLiteral("Square"), Qt::MatchStartsWith));
    Q_EMIT preset.activated(preset.currentIndex());
    EXPECT_EQ(height.value(), 1080);
    width.setValue(64);
    height.setValue(40);
    EXPECT_EQ(preset.currentText(), QStringLiteral("Custom"));
    height.setValue(1080);
    width.setValue(1920);
    EXPECT_TRUE(preset.currentText().startsWith(QStringLiteral("Full HD")));
    width.setValue(64);
    height.setValue(40);

    file.setText(QString());
    EXPECT_FALSE(run.isEnabled());
    file.setText(path("by-dialog.gif"));
    EXPECT_FALSE(run.isEnabled());
    EXPECT_THAT(summary.text().toStdString(), HasSubstr("choose one of these endings"));
    file.setText(path("gone/by-dialog.png"));
    EXPECT_FALSE(run.isEnabled());
    EXPECT_THAT(summary.text().toStdString(), HasSubstr("does not exist"));
    file.setText(path("by-dialog.png"));
    EXPECT_THAT(
        summary.text().toStdString(),
        HasSubstr("3 pictures of 64 × 40 pixels: by-dialog-0001.png to by-dialog-0003.png"));
    EXPECT_EQ(run.text(), QStringLiteral("Save"));
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        EXPECT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(
            dialog->grab().save(QDir(pictures).filePath(QStringLiteral("turntable-dialog.png"))));
    }
    // Files that are there are said, and named on the button.
    QFile existing(path("by-dialog-0002.png"));
    ASSERT_TRUE(existing.open(QIODevice::WriteOnly));
    existing.close();
    count.setValue(2);
    EXPECT_THAT(summary.text().toStdString(),
                HasSubstr("one file that exists will be overwritten"));
    EXPECT_EQ(run.text(), QStringLiteral("Overwrite"));
    session->views.show(shading::kViewBaseColor);
    count.setValue(3);
    EXPECT_THAT(summary.text().toStdString(), HasSubstr("of the view"));
    session->views.set({});
    const int steps = undoCount();
    QTest::mouseClick(&run, Qt::LeftButton);
    EXPECT_EQ(ended().state, JobState::Done);
    EXPECT_GT(QFileInfo(path("by-dialog-0003.png")).size(), 0);
    EXPECT_EQ(undoCount(), steps) << "saving pictures is no edit";
}

TEST_F(TurntableTest, WithoutFfmpegVideosAreOfferedWithTheReason) {
    qputenv("PATH", path("nothing").toLocal8Bit());
    TurntableDialog* dialog = openDialog();
    ASSERT_NE(dialog, nullptr);
    auto& format = part<QComboBox>(*dialog, "turntableFormat");
    const auto* model = qobject_cast<QStandardItemModel*>(format.model());
    for (int i = 0; i < format.count(); ++i) {
        const bool video = format.itemText(i).contains(QStringLiteral("video"));
        EXPECT_EQ(model->item(i)->isEnabled(), !video) << i;
        EXPECT_EQ(model->item(i)->toolTip().contains(QStringLiteral("install")), video) << i;
    }
    auto& note = part<QLabel>(*dialog, "turntableNote");
    EXPECT_TRUE(note.isVisible());
    EXPECT_THAT(note.text().toStdString(), HasSubstr("ffmpeg, which is not installed"));
    part<QLineEdit>(*dialog, "turntablePath").setText(path("turn.mp4"));
    EXPECT_FALSE(part<QPushButton>(*dialog, "turntableRun").isEnabled());
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        EXPECT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(dialog->grab().save(
            QDir(pictures).filePath(QStringLiteral("turntable-no-ffmpeg.png"))));
    }
    dialog->reject();
}

} // namespace
} // namespace patina::editor
