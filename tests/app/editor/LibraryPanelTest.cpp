// The Library dock by real events: folders are dropped, environments found, sorted, marked and
// used, and stepped through by keys.
#include "app/editor/library/LibraryPanel.h"
#include "app/editor/document/DraggedSources.h"
#include "app/editor/library/LibraryDelegate.h"
#include "app/editor/library/LibraryModel.h"
#include "app/editor/library/LibraryTexts.h"
#include "app/editor/library/LibraryView.h"
#include "app/editor/viewport/DropTarget.h"
#include "core/catalog/EnvironmentTags.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/core/catalog/Pictures.h"
#include "tests/support/Events.h"

#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMimeData>
#include <QScrollBar>
#include <QSettings>
#include <QToolButton>
#include <QUrl>

namespace patina::editor {
namespace {

using test::Disc;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LibraryPanelTest : public EditorTest {
  protected:
    void SetUp() override {
        window->viewport().setFixedSize(200, 160);
        EditorTest::SetUp();
        if (!window->actions().library->isChecked())
            window->actions().library->trigger();
        ASSERT_TRUE(eventually([] { return view().isVisible() && !library().busy(); }));
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        // A low warm sun, a high white one, a soft cool sky, and what is none.
        write("low.hdr", Disc{30, 10, 4, 4000, 1}.picture(128), {1.0, 0.6, 0.25});
        write("high.exr", Disc{30, 70, 4, 20000, 1}.picture(128), {1.0, 1.0, 1.0});
        write("soft.hdr", test::uniform(glm::dvec3(2.0), 64), {0.7, 0.85, 1.4});
        QFile broken(path("broken.hdr"));
        ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
        broken.write("#?RADIANCE\nnothing");
    }
    void TearDown() override {
        search().clear();
        button("Favourites only").setChecked(false);
        button("Descending").setChecked(false);
        sortBox().setCurrentIndex(0);
        for (const char* name : {"low.hdr", "high.exr", "soft.hdr"})
            library().setFavourite(path(name), false);
        library().setFolderShown({}, true);
        const auto folders = library().folders();
        for (const LibraryFolder& each : folders)
            library().removeFolder(each.path);
        ASSERT_TRUE(eventually([] { return !library().busy(); }));
    }

    static EnvironmentLibrary& library() { return EditorTest::session->library; }
    static LibraryPanel& panel() { return *window->findChild<LibraryPanel*>(); }
    static LibraryView& view() { return panel().view(); }
    static QLineEdit& search() { return *find<QLineEdit>(panel(), "Search the library"); }
    static QComboBox& sortBox() { return *find<QComboBox>(panel(), "Sort by"); }
    static QToolButton& button(const char* name) {
        return *find<QToolButton>(panel(), QString::fromLatin1(name));
    }
    static QString details() {
        return find<QLabel>(panel(), "Measured of the environment")->text();
    }

    QString path(const char* name) {
        return QDir(folder.path()).filePath(QString::fromLatin1(name));
    }
    void write(const char* name, Image image, const std::array<double, 3>& tint) {
        for (std::size_t i = 0; i < image.f32().size(); ++i)
            image.f32()[i] *= static_cast<float>(tint[i % 3]);
        const Result<void> saved =
            saveImage(controller().worker(), image, path(name).toStdString());
        ASSERT_TRUE(saved.ok()) << saved.error().text();
    }
    static void drop(QWidget& widget, const QString& file) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        QDragEnterEvent enter(widget.rect().center(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(&widget, &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event(QPointF(widget.rect().center()), Qt::CopyAction, &data, Qt::LeftButton,
                         {});
        QApplication::sendEvent(&widget, &event);
    }
    // The folder of this test alone, measured and compared.
    void dropFolder() {
        drop(panel(), folder.path());
        ASSERT_TRUE(eventually([] { return !library().busy(); }));
        library().setFolderShown({}, false);
    }
    static std::vector<std::string> titles() {
        std::vector<std::string> result;
        for (int i = 0; i < view().model()->rowCount(); ++i)
            result.push_back(view().model()->index(i, 0).data().toString().toStdString());
        return result;
    }
    static QModelIndex item(const char* title) {
        for (int i = 0; i < view().model()->rowCount(); ++i)
            if (const QModelIndex index = view().model()->index(i, 0);
                index.data().toString() == QLatin1String(title))
                return index;
        return {};
    }
    static void click(const QPoint& at) {
        QTest::mouseClick(view().viewport(), Qt::LeftButton, {}, at);
    }
    static QMenu* menuOf(const char* title) {
        view().setCurrentIndex(item(title));
        const QPoint at = view().visualRect(item(title)).center();
        QContextMenuEvent event(QContextMenuEvent::Mouse, at, view().viewport()->mapToGlobal(at));
        QApplication::sendEvent(view().viewport(), &event);
        return panel().findChild<QMenu*>(QStringLiteral("libraryMenu"));
    }
    static void choose(QMenu& menu, const char* text) {
        for (QAction* action : menu.actions())
            if (action->text().remove(QLatin1Char('&')) == QLatin1String(text)) {
                action->trigger();
                menu.close();
                test::handleEvents();
                return;
            }
        FAIL() << text << " is not in the menu";
    }
    static std::string lit() { return document().environment().source; }
};

TEST_F(LibraryPanelTest, BuiltInSkiesAreThereAndMeasured) {
    EXPECT_THAT(titles(),
                ElementsAre("Clear Sky", "Night", "Overcast", "Studio", "Sunset", "White"));
    for (int i = 0; i < view().model()->rowCount(); ++i) {
        const QModelIndex index = view().model()->index(i, 0);
        EXPECT_FALSE(index.data(LibraryModel::PictureRole).value<QPixmap>().isNull());
        EXPECT_TRUE(index.flags().testFlag(Qt::ItemIsDragEnabled));
    }
}

TEST_F(LibraryPanelTest, AFolderThatIsDroppedIsMeasuredAndRemembered) {
    dropFolder();
    EXPECT_THAT(titles(), ElementsAre("high", "low", "soft"));
    for (const char* title : {"high", "low", "soft"})
        EXPECT_FALSE(item(title).data(LibraryModel::PictureRole).value<QPixmap>().isNull());
    EXPECT_EQ(QSettings().value(QStringLiteral("library/folders")).toStringList(),
              QStringList(folder.path()));
    ASSERT_EQ(panel().folders().count(), 2);
    EXPECT_THAT(panel().folders().item(1)->text().toStdString(), HasSubstr("(4)"));

    // What cannot be read is listed with its reason, beside those that can.
    auto* toggle = &button("1 file cannot be read");
    ASSERT_TRUE(toggle->isVisible());
    auto* unreadable = find<QListWidget>(panel(), "Files that cannot be read");
    EXPECT_FALSE(unreadable->isVisible());
    QTest::mouseClick(toggle, Qt::LeftButton);
    EXPECT_TRUE(unreadable->isVisible());
    ASSERT_EQ(unreadable->count(), 1);
    EXPECT_TRUE(unreadable->item(0)->text().startsWith(QLatin1String("broken.hdr: ")));
    EXPECT_GT(unreadable->item(0)->text().size(), 20);
    QTest::mouseClick(toggle, Qt::LeftButton);

    // Removed, its environments go and its files stay.
    panel().folders().setCurrentRow(1);
    QTest::mouseClick(&button("Remove the folder"), Qt::LeftButton);
    ASSERT_TRUE(eventually([] { return !library().busy(); }));
    library().setFolderShown({}, true);
    EXPECT_EQ(titles().size(), 6u);
    EXPECT_TRUE(QFile::exists(path("low.hdr")));
    EXPECT_TRUE(QSettings().value(QStringLiteral("library/folders")).toStringList().isEmpty());
}

TEST_F(LibraryPanelTest, SearchFindsNamesAndTags) {
    dropFolder();
    search().setFocus();
    QTest::keyClicks(&search(), QStringLiteral("sun"));
    EXPECT_THAT(titles(), ElementsAre("high", "low"));
    QTest::keyClicks(&search(), QStringLiteral(" warm"));
    EXPECT_THAT(titles(), ElementsAre("low"));
    search().setText(QStringLiteral("nothing of the kind"));
    EXPECT_TRUE(titles().empty());
    EXPECT_FALSE(view().grab().isNull()); // words in the place of items
    search().setText(QStringLiteral("SOF"));
    EXPECT_THAT(titles(), ElementsAre("soft"));
}

TEST_F(LibraryPanelTest, SortsByWhatWasMeasured) {
    dropFolder();
    const auto sort = [](CatalogSort by, bool descending = false) {
        sortBox().setCurrentIndex(static_cast<int>(by));
        if (button("Descending").isChecked() != descending)
            QTest::mouseClick(&button("Descending"), Qt::LeftButton);
        return titles();
    };
    EXPECT_THAT(sort(CatalogSort::SunElevation), ElementsAre("low", "high", "soft"));
    EXPECT_THAT(sort(CatalogSort::SunElevation, true), ElementsAre("high", "low", "soft"));
    EXPECT_THAT(sort(CatalogSort::Range), ElementsAre("soft", "low", "high"));
    EXPECT_THAT(sort(CatalogSort::KeyToFill, true), ElementsAre("high", "low", "soft"));
    EXPECT_THAT(sort(CatalogSort::Temperature), ElementsAre("low", "high", "soft"));
    EXPECT_EQ(item("soft").data(LibraryModel::SubtitleRole).toString(),
              sortedText(*library().item(path("soft.hdr")), CatalogSort::Temperature));
    // The choice outlives the session.
    EXPECT_EQ(QSettings().value(QStringLiteral("library/sort")).toInt(),
              static_cast<int>(CatalogSort::Temperature));
}

TEST_F(LibraryPanelTest, TheStarMarksFavourites) {
    dropFolder();
    const QPoint star = LibraryDelegate::starRect(view().visualRect(item("low"))).center();
    click(star);
    EXPECT_TRUE(library().isFavourite(path("low.hdr")));
    EXPECT_EQ(undoCount(), 0); // of the library, and not of the document
    QTest::mouseClick(&button("Favourites only"), Qt::LeftButton);
    EXPECT_THAT(titles(), ElementsAre("low"));
    EXPECT_EQ(QSettings().value(QStringLiteral("library/favourites")).toStringList(),
              QStringList(path("low.hdr")));
    click(LibraryDelegate::starRect(view().visualRect(item("low"))).center());
    EXPECT_TRUE(titles().empty());
    // Two clicks on the star are two changes, and light nothing.
    QTest::mouseClick(&button("Favourites only"), Qt::LeftButton);
    QTest::mouseDClick(view().viewport(), Qt::LeftButton, {},
                       LibraryDelegate::starRect(view().visualRect(item("low"))).center());
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(LibraryPanelTest, EnterLightsTheSceneAsOneStep) {
    dropFolder();
    const std::string before = lit();
    view().setFocus();
    view().setCurrentIndex(item("high"));
    EXPECT_THAT(details().toStdString(), HasSubstr("key to fill"));
    QTest::keyClick(&view(), Qt::Key_Right);
    EXPECT_EQ(view().currentSource(), path("low.hdr"));
    QTest::keyClick(&view(), Qt::Key_Return);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("low.hdr").toStdString());
    EXPECT_EQ(undoCount(), 1);
    EXPECT_TRUE(item("low").data(LibraryModel::CurrentRole).toBool());
    controller().undoStack().undo();
    EXPECT_EQ(lit(), before);
    EXPECT_FALSE(item("low").data(LibraryModel::CurrentRole).toBool());

    // A double-click does the same.
    controller().undoStack().redo();
    const QPoint at = view().visualRect(item("high")).center();
    QTest::mouseClick(view().viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(view().viewport(), Qt::LeftButton, {}, at);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("high.exr").toStdString());
    EXPECT_EQ(undoCount(), 2);
}

TEST_F(LibraryPanelTest, PageDownStepsAndUndoLeadsBackBeforeAllSteps) {
    dropFolder();
    const std::string before = lit();
    ViewportWidget& viewport = window->viewport();
    viewport.setFocus();
    QTest::keyClick(&viewport, Qt::Key_PageDown);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("high.exr").toStdString()); // from elsewhere to the first
    EXPECT_EQ(view().currentSource(), path("high.exr"));
    // Faster than files are read: each step counts.
    QTest::keyClick(&viewport, Qt::Key_PageDown);
    QTest::keyClick(&viewport, Qt::Key_PageDown);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("soft.hdr").toStdString());
    QTest::keyClick(&viewport, Qt::Key_PageUp);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("low.hdr").toStdString());
    EXPECT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    EXPECT_EQ(lit(), before);
    controller().undoStack().redo();
    EXPECT_EQ(lit(), path("low.hdr").toStdString());
    // Around the ends, in the order that is shown.
    sortBox().setCurrentIndex(static_cast<int>(CatalogSort::SunElevation));
    ASSERT_THAT(titles(), ElementsAre("low", "high", "soft"));
    viewport.setFocus();
    QTest::keyClick(&viewport, Qt::Key_PageUp);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("soft.hdr").toStdString());
    // What was used is a step of its own.
    library().use(path("low.hdr"));
    ASSERT_TRUE(settled(*session));
    QTest::keyClick(&viewport, Qt::Key_PageDown);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(undoCount(), 3);
}

TEST_F(LibraryPanelTest, PageKeysScrollTheGridWhenItHasTheFocus) {
    const std::string before = lit();
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_PageDown);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), before);
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(LibraryPanelTest, AFileThatVanishedIsSkippedWithANotice) {
    dropFolder();
    const std::string before = lit();
    ASSERT_TRUE(QFile::remove(path("high.exr")));
    library().step(1);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), before);
    library().step(1); // from where the scene is
    library().rescan();
    ASSERT_TRUE(settled(*session));
    ASSERT_TRUE(eventually([] { return !library().busy(); }));
    EXPECT_THAT(titles(), ElementsAre("low", "soft"));
}

TEST_F(LibraryPanelTest, DuplicatesAreMarked) {
    ASSERT_TRUE(QFile::copy(path("low.hdr"), path("low copy.hdr")));
    dropFolder();
    EXPECT_THAT(titles(), ElementsAre("high", "low", "low copy", "soft"));
    EXPECT_NE(item("low").data(LibraryModel::DuplicateRole).toBool(),
              item("low copy").data(LibraryModel::DuplicateRole).toBool());
    search().setText(QStringLiteral("duplicate"));
    EXPECT_EQ(titles().size(), 1u);
}

TEST_F(LibraryPanelTest, TheMenuDoesWhatItSays) {
    dropFolder();
    QMenu* menu = menuOf("soft");
    ASSERT_NE(menu, nullptr);
    choose(*menu, "Copy Path");
    EXPECT_EQ(QGuiApplication::clipboard()->text(), path("soft.hdr"));
    menu = menuOf("soft");
    ASSERT_NE(menu, nullptr);
    choose(*menu, "Favourite");
    EXPECT_TRUE(library().isFavourite(path("soft.hdr")));
    menu = menuOf("soft");
    ASSERT_NE(menu, nullptr);
    choose(*menu, "No Favourite");
    EXPECT_FALSE(library().isFavourite(path("soft.hdr")));
    const std::size_t environments = document().environments.size();
    menu = menuOf("soft");
    ASSERT_NE(menu, nullptr);
    choose(*menu, "Add as Another Environment");
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(document().environments.size(), environments + 1);
    EXPECT_EQ(lit(), path("soft.hdr").toStdString());
    library().setFolderShown({}, true);
    menu = menuOf("Studio");
    ASSERT_NE(menu, nullptr);
    for (const QAction* action : menu->actions())
        EXPECT_NE(action->text(), QStringLiteral("&Copy Path")); // there is none
    choose(*menu, "Use");
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), "builtin:studio");
}

TEST_F(LibraryPanelTest, ItemsAreDraggedAsFiles) {
    dropFolder();
    const std::unique_ptr<QMimeData> data(view().model()->mimeData({item("low")}));
    EXPECT_EQ(data->urls(), QList<QUrl>{QUrl::fromLocalFile(path("low.hdr"))});
    EXPECT_TRUE(item("low").flags().testFlag(Qt::ItemIsDragEnabled));
    // Dropped on the window it is a file like any other.
    drop(*window, data->urls().front().toLocalFile());
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("low.hdr").toStdString());
}

TEST_F(LibraryPanelTest, BuiltInSkiesAreDraggedByName) {
    const std::unique_ptr<QMimeData> data(view().model()->mimeData({item("Sunset")}));
    EXPECT_FALSE(data->hasUrls()) << "it is no file that others could read";
    EXPECT_EQ(data->data(QLatin1String(kEnvironmentMime)), QByteArray("builtin:sunset"));
    EXPECT_TRUE(view().model()->mimeTypes().contains(QLatin1String(kEnvironmentMime)));
    // Dropped on the window it lights the scene, as one step.
    QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, data.get(), Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    EXPECT_EQ(window->findChild<DropHint*>()->lines(),
              QStringList{QStringLiteral("Light the scene with Sunset")});
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, data.get(), Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &event);
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), "builtin:sunset");
    EXPECT_EQ(undoCount(), 1);
    controller().undoStack().undo();
    EXPECT_EQ(lit(), "builtin:studio");

    // What another program says is none of ours is not taken.
    QMimeData foreign;
    foreign.setData(QLatin1String(kEnvironmentMime), "builtin:teapot\n/etc/passwd");
    QDragEnterEvent refused(QPoint(300, 300), Qt::CopyAction, &foreign, Qt::LeftButton, {});
    refused.ignore();
    QApplication::sendEvent(window.get(), &refused);
    EXPECT_FALSE(refused.isAccepted());
}

TEST_F(LibraryPanelTest, AFolderDroppedOnTheWindowOpensTheDock) {
    window->actions().library->trigger();
    ASSERT_FALSE(window->actions().library->isChecked());
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(folder.path())});
    QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &enter);
    const auto* hint = window->findChild<DropHint*>();
    ASSERT_EQ(hint->lines().size(), 1);
    EXPECT_THAT(hint->lines().front().toStdString(), HasSubstr("to the library"));
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(window.get(), &event);
    EXPECT_TRUE(hint->lines().isEmpty());
    EXPECT_TRUE(eventually([] { return view().isVisible() && !library().busy(); }));
    EXPECT_TRUE(window->actions().library->isChecked());
    EXPECT_EQ(titles().size(), 9u);
    EXPECT_EQ(undoCount(), 0);
}

TEST_F(LibraryPanelTest, ASecondLibraryReadsWhatWasKept) {
    dropFolder();
    EnvironmentLibrary again(controller(), libraryCacheFolder());
    ASSERT_EQ(again.folders().size(), 2u);
    EXPECT_FALSE(again.folders().front().shown);
    again.load();
    ASSERT_TRUE(eventually([&] { return !again.busy(); }));
    for (const char* name : {"low.hdr", "high.exr", "soft.hdr"}) {
        const LibraryItem* item = again.item(path(name));
        ASSERT_NE(item, nullptr);
        EXPECT_EQ(*item->entry, *library().item(path(name))->entry);
    }
}

TEST_F(LibraryPanelTest, StepsWaitForTheListOfFiles) {
    ASSERT_TRUE(QFile::remove(path("broken.hdr"))); // it is in the order until it was tried
    dropFolder();
    EnvironmentLibrary fresh(controller(), libraryCacheFolder());
    fresh.step(1);
    fresh.step(1);
    EXPECT_TRUE(fresh.items().empty());
    ASSERT_TRUE(eventually([&] { return !fresh.busy(); }));
    ASSERT_TRUE(settled(*session));
    EXPECT_EQ(lit(), path("low.hdr").toStdString());
    EXPECT_EQ(undoCount(), 1);
}

TEST_F(LibraryPanelTest, TheGridStaysWhereItIsScrolledTo) {
    for (int i = 0; i < 40; ++i)
        ASSERT_TRUE(QFile::copy(path("soft.hdr"), path(qPrintable(QString("copy %1.hdr").arg(i)))));
    dropFolder();
    test::handleEvents();
    QScrollBar& bar = *view().verticalScrollBar();
    ASSERT_GT(bar.maximum(), 100);
    bar.setValue(100);
    ASSERT_TRUE(QFile::copy(path("soft.hdr"), path("zebra.hdr"))); // the last one
    library().rescan();
    ASSERT_TRUE(eventually([] { return !library().busy() && titles().back() == "zebra"; }));
    EXPECT_EQ(bar.value(), 100);
}

TEST_F(LibraryPanelTest, TooltipsNameAllNumbersAndTags) {
    dropFolder();
    const std::string text = item("low").data(Qt::ToolTipRole).toString().toStdString();
    for (const char* part : {"256 × 128", "Lat-long", "Brightest source", "elevation 10°", "stops",
                             " : 1", " K", "Mean luminance", "Warm"})
        EXPECT_THAT(text, HasSubstr(part));
    EXPECT_THAT(item("low").data(Qt::AccessibleTextRole).toString().toStdString(),
                HasSubstr("Sun, Warm"));
}

TEST_F(LibraryPanelTest, UprightItHasTheFoldersAboveTheGrid) {
    dropFolder();
    library().setFolderShown({}, true);
    LibraryPanel panel(library(), EditorTest::session->preview);
    panel.resize(300, 700);
    panel.show();
    test::handleEvents();
    if (const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS"); !pictures.isEmpty()) {
        ASSERT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(
            panel.grab().save(QDir(pictures).filePath(QStringLiteral("library-upright.png"))));
    }
    EXPECT_EQ(panel.width(), 300);
    const QRect folders(panel.folders().mapTo(&panel, QPoint(0, 0)), panel.folders().size());
    const QRect grid(panel.view().mapTo(&panel, QPoint(0, 0)), panel.view().size());
    EXPECT_LT(folders.bottom(), grid.top());
    panel.resize(1100, 260);
    test::handleEvents();
    const QRect beside(panel.folders().mapTo(&panel, QPoint(0, 0)), panel.folders().size());
    EXPECT_LT(beside.right(), panel.view().mapTo(&panel, QPoint(0, 0)).x());
}

} // namespace
} // namespace patina::editor
