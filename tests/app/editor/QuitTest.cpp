// Leaving the editor: at the first try when nothing is lost, after a question otherwise.

#include "tests/app/editor/EditorFixture.h"

#include "app/editor/job/LivePreview.h"
#include "core/edit/EditSession.h"
#include "core/scene/DocumentIO.h"

#include <QDir>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>
#include <QWindow>

namespace patina::editor {
namespace {

// Each test has a window of its own to close.
class QuitTest : public ::testing::Test {
  protected:
    void SetUp() override {
        QApplication::setQuitOnLastWindowClosed(false); // the other tests go on
        m_window.resize(1040, 860);
        m_window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&m_window, 60'000));
        m_session.controller.newDocument();
        ASSERT_TRUE(settled(m_session));
    }

    void modify() {
        m_session.controller.setParameter(parameter("environment.rotationDeg"),
                                          {Scope::Environment, 0}, 45.0f);
        ASSERT_TRUE(m_session.controller.isModified());
    }
    // Shortcuts belong to the active window; without a window manager nobody else activates it.
    void pressCtrlQ() {
        m_window.activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(&m_window, 30'000));
        QTest::keyClick(&m_window, Qt::Key_Q, Qt::ControlModifier);
    }
    // What the cross in the title bar does.
    void pressCross() { m_window.windowHandle()->close(); }

    [[nodiscard]] bool closes() {
        return eventually([this] { return !m_window.isVisible(); });
    }
    QMessageBox* question() {
        for (QMessageBox* box : m_window.findChildren<QMessageBox*>())
            if (box->isVisible())
                return box;
        return nullptr;
    }
    void answer(QMessageBox::StandardButton button) {
        ASSERT_TRUE(eventually([this] { return question() != nullptr; }));
        QTest::mouseClick(question()->button(button), Qt::LeftButton);
        ASSERT_EQ(question(), nullptr);
        QCoreApplication::processEvents();
    }

    Session m_session;
    MainWindow m_window{m_session};
};

TEST_F(QuitTest, OneCtrlQIsEnoughWhenNothingIsLost) {
    pressCtrlQ();
    EXPECT_TRUE(closes());
    EXPECT_EQ(question(), nullptr);
}

TEST_F(QuitTest, OneCloseOfTheWindowIsEnoughWhenNothingIsLost) {
    pressCross();
    EXPECT_TRUE(closes());
    EXPECT_EQ(question(), nullptr);
}

TEST_F(QuitTest, UnsavedChangesAskEachTimeUntilTheyAreDiscarded) {
    modify();
    pressCtrlQ();
    answer(QMessageBox::Cancel);
    EXPECT_TRUE(m_window.isVisible());
    pressCross();
    answer(QMessageBox::Cancel);
    EXPECT_TRUE(m_window.isVisible());
    EXPECT_TRUE(m_session.controller.isModified());
    pressCtrlQ();
    answer(QMessageBox::Discard);
    EXPECT_TRUE(closes());
}

// Whatever is under way, and however little patience there is for the rest.
TEST_F(QuitTest, LosesNeitherASaveNorWhatABakeHasComputed) {
    QDir bakes(QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
               QStringLiteral("/bakes"));
    ASSERT_TRUE(bakes.removeRecursively());
    m_session.controller.openScene(QStringLiteral("builtin:sphere"));
    ASSERT_TRUE(settled(m_session));
    BakeRequest request;
    request.kind = BakeKind::AoVertex;
    request.ao.samples = 16384;
    m_session.bakes.start(request);
    ASSERT_TRUE(eventually([this] { return m_session.bakes.preview()->samplesDone() > 0; }));
    const QTemporaryDir folder;
    const QString first = folder.filePath(QStringLiteral("first.patina"));
    const QString second = folder.filePath(QStringLiteral("second.patina"));
    m_session.controller.saveAs(first);
    m_session.controller.saveAs(second);
    m_session.shutDown(std::chrono::milliseconds(0)); // as main does
    EXPECT_TRUE(projectVersion(first.toStdString()));
    EXPECT_TRUE(projectVersion(second.toStdString())) << "it waited for the first";
    EXPECT_EQ(bakes.entryList({QStringLiteral("*.checkpoint")}).size(), 1);
}

} // namespace
} // namespace patina::editor
