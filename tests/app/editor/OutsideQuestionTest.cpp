// Pictures outside the model's folder: asked about once, read when the user agrees.
#include "app/editor/OutsideQuestion.h"
#include "app/editor/document/PrintableNotice.h"
#include "core/io/ImageIO.h"
#include "core/light/Environment.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "tests/app/editor/EditorFixture.h"

#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <algorithm>
#include <fstream>

namespace patina::editor {
namespace {

class OutsideQuestionTest : public ::testing::Test {
  protected:
    void SetUp() override {
        QSettings().clear();
        m_window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&m_window, 60'000));
        const std::filesystem::path folder = m_folder.path().toStdString();
        std::filesystem::create_directories(folder / "model");
        std::filesystem::create_directories(folder / "private");
        ASSERT_TRUE(saveImage(m_session.worker, Image(4, 4, 3, PixelType::U8, ColorEncoding::Srgb),
                              folder / "private/secret.png")
                        .ok());
        std::ofstream(folder / "model/a.mtl")
            << "newmtl Skin\nKd 1 1 1\nmap_Kd ../private/secret.png\n";
        std::ofstream(folder / "model/a.obj")
            << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
               "usemtl Skin\nf 1/1/1 2/2/1 3/3/1\n";
        m_model = QString::fromStdString((folder / "model/a.obj").string());
    }
    void TearDown() override { QSettings().clear(); }

    void open(Session& session) {
        session.controller.openScene(m_model);
        ASSERT_TRUE(settled(session));
    }
    QMessageBox* question() { return m_window.findChild<QMessageBox*>("outsideQuestion"); }
    void answer(const QString& button) {
        ASSERT_NE(question(), nullptr);
        for (QAbstractButton* candidate : question()->buttons())
            if (candidate->text() == button)
                QTest::mouseClick(candidate, Qt::LeftButton);
        ASSERT_TRUE(eventually([this] { return question() == nullptr; }));
    }
    static const Material& skin(Session& session) {
        for (const Material& material : session.controller.document().materials)
            if (material.name == "Skin")
                return material;
        ADD_FAILURE() << "no material";
        return session.controller.document().materials.front();
    }

    QTemporaryDir m_folder;
    QString m_model;
    Session m_session;
    QWidget m_window;
    OutsideQuestion m_asks{m_session, m_window};
};

TEST_F(OutsideQuestionTest, ReadsThemOnceTheUserAgreesAndRemembersIt) {
    open(m_session);
    ASSERT_NE(question(), nullptr);
    EXPECT_EQ(question()->textFormat(), Qt::PlainText);
    EXPECT_TRUE(question()->text().contains("a.obj"));
    EXPECT_TRUE(question()->informativeText().contains("secret.png"));
    EXPECT_EQ(question()->defaultButton()->text(), "&Leave Out");
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    answer("&Read Them");
    ASSERT_TRUE(settled(m_session));
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_TRUE(skin(m_session).baseColorMap.problem.empty());

    // Neither the same run nor the next asks again.
    open(m_session);
    EXPECT_EQ(question(), nullptr);
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
    Session next;
    OutsideQuestion asks(next, m_window);
    open(next);
    EXPECT_EQ(question(), nullptr);
    EXPECT_NE(skin(next).baseColorMap.image, nullptr);
}

TEST_F(OutsideQuestionTest, LeavesThemOutAndDoesNotAskAgainForEachEdit) {
    open(m_session);
    answer("&Leave Out");
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    m_session.controller.addMaterial();
    m_session.controller.undoStack().undo();
    EXPECT_EQ(question(), nullptr);
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    open(m_session); // on purpose
    EXPECT_NE(question(), nullptr);
}

TEST_F(OutsideQuestionTest, AsksForModelsThatAreAdded) {
    m_session.controller.newDocument();
    ASSERT_TRUE(settled(m_session));
    EXPECT_EQ(question(), nullptr);
    m_session.controller.addModel(m_model);
    ASSERT_TRUE(settled(m_session));
    answer("&Read Them");
    ASSERT_TRUE(settled(m_session));
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
}

// What is granted to one file is not granted to another that is shown beside it.
TEST_F(OutsideQuestionTest, AsksForEachFileOfItsOwn) {
    const std::filesystem::path folder = m_folder.path().toStdString();
    ASSERT_TRUE(saveImage(m_session.worker, Image(2, 2, 3, PixelType::U8, ColorEncoding::Srgb),
                          folder / "private/other.png")
                    .ok());
    std::ofstream(folder / "model/b.mtl")
        << "newmtl Other\nKd 1 1 1\nmap_Kd ../private/other.png\n";
    std::ofstream(folder / "model/b.obj")
        << "mtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
           "usemtl Other\nf 1/1/1 2/2/1 3/3/1\n";
    open(m_session);
    answer("&Leave Out");
    m_session.controller.addModel(QString::fromStdString((folder / "model/b.obj").string()));
    ASSERT_TRUE(settled(m_session));
    ASSERT_NE(question(), nullptr);
    EXPECT_TRUE(question()->text().contains("b.obj"));
    EXPECT_TRUE(question()->informativeText().contains("other.png"));
    EXPECT_FALSE(question()->informativeText().contains("secret.png"));
    answer("&Read Them");
    ASSERT_TRUE(settled(m_session));
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    const auto& materials = m_session.controller.document().materials;
    const auto other = std::find_if(materials.begin(), materials.end(),
                                    [](const Material& m) { return m.name == "Other"; });
    ASSERT_NE(other, materials.end());
    EXPECT_NE(other->baseColorMap.image, nullptr);
}

// Pictures that come while the user has gone back wait, as all that was asked for does.
TEST_F(OutsideQuestionTest, ReadingEndsNoRedo) {
    open(m_session);
    m_session.controller.addMaterial();
    for (QAbstractButton* button : question()->buttons())
        if (button->text() == "&Read Them")
            button->click();
    m_session.controller.undoStack().undo();
    ASSERT_TRUE(settled(m_session));
    EXPECT_TRUE(m_session.controller.undoStack().canRedo());
    m_session.controller.undoStack().redo();
    ASSERT_TRUE(eventually([&] { return skin(m_session).baseColorMap.image != nullptr; }));
}

// A project of somebody else's, whose state folder is not ours.
class OutsideProjectQuestion : public OutsideQuestionTest {
  protected:
    void SetUp() override {
        OutsideQuestionTest::SetUp();
        const std::filesystem::path folder = m_folder.path().toStdString();
        m_secret = (folder / "private/secret.png").string();
        ASSERT_TRUE(saveImage(m_session.worker,
                              Image(64, 32, 3, PixelType::F32, ColorEncoding::Linear),
                              folder / "private/light.exr")
                        .ok());
        std::filesystem::create_directories(folder / "project");
        m_model = QString::fromStdString((folder / "project/scene.patina").string());
        beUser("theirs");
        Document document = startDocument();
        Material& material = document.materials.front();
        material.name = "Skin";
        material.baseColorMap.source = m_secret;
        material.baseColorMap.image =
            std::make_shared<const Image>(4, 4, 3, PixelType::U8, ColorEncoding::Srgb);
        document.environment().source = (folder / "private/light.exr").string();
        ASSERT_TRUE(saveProject(m_session.worker, document, m_model.toStdString()).ok());
        beUser("mine");
    }
    void TearDown() override {
        qputenv("XDG_STATE_HOME", m_before);
        OutsideQuestionTest::TearDown();
    }
    void beUser(const char* name) const {
        qputenv("XDG_STATE_HOME", (m_folder.path() + "/state of " + name).toUtf8());
    }
    bool isLit() const {
        const Environment& environment = m_session.controller.document().environment();
        return environment.problem.empty() && environment.image != nullptr &&
               environment.image->f32()[0] == 0.0f; // the file is black
    }

    const QByteArray m_before = qgetenv("XDG_STATE_HOME");
    std::string m_secret;
};

TEST_F(OutsideProjectQuestion, ReadsPicturesAndEnvironmentsOnceTheUserAgrees) {
    open(m_session);
    ASSERT_NE(question(), nullptr);
    EXPECT_TRUE(question()->text().contains("scene.patina"));
    EXPECT_TRUE(question()->informativeText().contains("secret.png"));
    EXPECT_TRUE(question()->informativeText().contains("light.exr"));
    EXPECT_EQ(question()->defaultButton()->text(), "&Leave Out");
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_FALSE(isLit());
    answer("&Read Them");
    ASSERT_TRUE(settled(m_session));
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_TRUE(isLit());
    EXPECT_EQ(question(), nullptr);
    open(m_session); // and remembers it
    EXPECT_EQ(question(), nullptr);
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_TRUE(isLit());
}

TEST_F(OutsideProjectQuestion, LeavesThemOutAndSavingChangesNothingOfThat) {
    open(m_session);
    answer("&Leave Out");
    m_session.controller.addMaterial();
    EXPECT_EQ(question(), nullptr);
    bool saved = false;
    m_session.controller.saveAs(m_model, [&](bool ok) { saved = ok; }, {});
    ASSERT_TRUE(settled(m_session));
    ASSERT_TRUE(saved);
    open(m_session);
    EXPECT_NE(question(), nullptr);
    EXPECT_EQ(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_EQ(skin(m_session).baseColorMap.source, m_secret);
}

TEST_F(OutsideProjectQuestion, DoesNotAskAboutWhatTheUserSaved) {
    beUser("theirs");
    open(m_session);
    EXPECT_EQ(question(), nullptr);
    EXPECT_NE(skin(m_session).baseColorMap.image, nullptr);
    EXPECT_TRUE(isLit());
}

TEST(PrintableNotice, HoldsNoControlCharacters) {
    const UserNotice notice{NoticeKind::Error,
                            QStringLiteral("a\x1b]52;c;ZXZpbA==\x07"),
                            {QStringLiteral("b\x1b[2J"), QString(QChar(0x202e)) + "gnp.exe"}};
    const UserNotice shown = printableNotice(notice);
    EXPECT_EQ(shown.kind, NoticeKind::Error);
    ASSERT_EQ(shown.details.size(), 2);
    for (const QString& text : {shown.text, shown.details[0], shown.details[1]})
        for (const QChar c : text)
            EXPECT_FALSE(c.unicode() < 32 || c.unicode() == 0x202e) << text.toStdString();
    EXPECT_EQ(shown.text.toStdString(), "a␛]52;c;ZXZpbA==␇");
}

} // namespace
} // namespace patina::editor
