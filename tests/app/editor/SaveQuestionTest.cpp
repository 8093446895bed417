// What the window asks before a save overwrites what it may not, and before a scene that was being
// opened replaces edits made meanwhile: real buttons.

#include "tests/app/editor/EditorFixture.h"

#include "core/edit/EditSession.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>

namespace patina::editor {
namespace {

struct SaveQuestions : EditorTest {
    void SetUp() override {
        EditorTest::SetUp();
        m_file = folder.filePath(QStringLiteral("chair.patina"));
        controller().saveAs(m_file);
        ASSERT_TRUE(settled(*session));
    }
    void TearDown() override {
        for (QDialog* dialog : window->findChildren<QDialog*>())
            dialog->done(QDialog::Rejected);
        controller().newDocument();
        ASSERT_TRUE(eventually([] { return session->controller.isPristine() || question(); }));
        if (question())
            QTest::mouseClick(question()->button(QMessageBox::Discard), Qt::LeftButton);
        ASSERT_TRUE(settled(*session));
    }
    static void setExposure(float value) {
        controller().setParameter(parameter("view.exposureEv"), {Scope::View, 0}, value);
    }
    static QMessageBox* question() {
        for (QMessageBox* box : window->findChildren<QMessageBox*>())
            if (box->isVisible())
                return box;
        return nullptr;
    }
    static void press(const char* name) {
        ASSERT_TRUE(eventually([] { return question() != nullptr; }));
        auto* button = question()->findChild<QPushButton*>(QLatin1String(name));
        ASSERT_NE(button, nullptr) << name;
        QTest::mouseClick(button, Qt::LeftButton);
        QCoreApplication::processEvents();
    }
    [[nodiscard]] QByteArray content() const {
        QFile file(m_file);
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        return file.readAll();
    }
    void changeByOthers() const {
        QFile file(m_file);
        ASSERT_TRUE(file.open(QIODevice::Append));
        file.write("\n\n");
    }
    QString m_file;
};

TEST_F(SaveQuestions, AChangedFileIsOverwrittenOnlyWhenTheUserSaysSo) {
    changeByOthers();
    const QByteArray theirs = content();
    setExposure(1.5f);
    window->files().save();
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    EXPECT_TRUE(question()->text().contains(QStringLiteral("chair.patina")));
    if (const QString shots = qEnvironmentVariable("PATINA_SCREENSHOTS"); !shots.isEmpty()) {
        QDir().mkpath(shots);
        question()->grab().save(shots + QStringLiteral("/overwrite-question.png"));
    }
    QTest::mouseClick(question()->button(QMessageBox::Cancel), Qt::LeftButton);
    EXPECT_EQ(content(), theirs);
    EXPECT_TRUE(controller().isModified());
    window->files().save();
    press("overwrite");
    ASSERT_TRUE(settled(*session));
    EXPECT_FALSE(controller().isModified());
    EXPECT_TRUE(content().contains("1.5"));
}

TEST_F(SaveQuestions, AChangedFileCanBeReadAgain) {
    changeByOthers();
    const QByteArray theirs = content();
    setExposure(1.5f);
    bool proceeded = false;
    window->files().guard([&] { proceeded = true; });
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    QTest::mouseClick(question()->button(QMessageBox::Save), Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return question() != nullptr; })) << "saving asks in its turn";
    press("reload");
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().view.exposureEv, 0.0f);
    EXPECT_FALSE(controller().isModified());
    EXPECT_EQ(content(), theirs);
    EXPECT_FALSE(proceeded) << "what followed the save does not happen without it";
}

TEST_F(SaveQuestions, AFolderThatIsGoneLeadsToAnotherPlace) {
    const QString inner = folder.filePath(QStringLiteral("work"));
    ASSERT_TRUE(QDir().mkdir(inner));
    controller().saveAs(inner + QStringLiteral("/stool.patina"));
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(QDir().rename(inner, folder.filePath(QStringLiteral("moved"))));
    setExposure(1.5f);
    window->files().save();
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    EXPECT_EQ(question()->findChild<QPushButton*>(QStringLiteral("overwrite")), nullptr);
    press("saveElsewhere");
    ASSERT_TRUE(eventually([] {
        const auto dialogs = window->findChildren<QFileDialog*>();
        return !dialogs.isEmpty() && dialogs.first()->isVisible();
    }));
    EXPECT_FALSE(QDir(inner).exists());
    EXPECT_TRUE(controller().isModified());
}

TEST_F(SaveQuestions, EditsMadeWhileASceneOpensAreAskedFor) {
    controller().openScene(QStringLiteral("builtin:sphere"));
    setExposure(2.25f);
    ASSERT_TRUE(eventually([] { return question() != nullptr; }));
    EXPECT_EQ(document().view.exposureEv, 2.25f);
    QTest::mouseClick(question()->button(QMessageBox::Save), Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return document().meshes.front().source == "builtin:sphere"; }));
    EXPECT_TRUE(content().contains("2.25")) << "saved before it went";
    EXPECT_FALSE(controller().isModified());
}

} // namespace
} // namespace patina::editor
