// The numeric field, the slider and the colour picker by real mouse and key events.

#include "app/editor/job/UiTasks.h"
#include "app/editor/panel/LogPanel.h"
#include "app/editor/widget/BusyIndicator.h"
#include "app/editor/widget/ColorConversion.h"
#include "app/editor/widget/ColorPicker.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/NoticeArea.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/OutputFile.h"
#include "app/editor/widget/Slider.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/base/Log.h"
#include "tests/support/Events.h"

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

struct NumberFieldTest : ::testing::Test {
    NumberFieldTest() {
        field.resize(80, 24);
        field.setValue(0.5);
        field.show();
        other.show(); // somewhere for the focus to go
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&field));
    }
    void drag(int pixels, Qt::KeyboardModifiers modifiers = {}) {
        move(pixels, modifiers);
        QTest::mouseRelease(&field, Qt::LeftButton, modifiers, from + QPoint(pixels, 0));
    }
    void move(int pixels, Qt::KeyboardModifiers modifiers = {}) {
        QTest::mousePress(&field, Qt::LeftButton, modifiers, from);
        moveTo(pixels, modifiers);
    }
    void moveTo(int pixels, Qt::KeyboardModifiers modifiers = {}) {
        // QTest::mouseMove() knows no modifiers.
        const QPointF at = from + QPointF(pixels, 0);
        QMouseEvent event(QEvent::MouseMove, at, field.mapToGlobal(at), Qt::NoButton,
                          Qt::LeftButton, modifiers);
        QApplication::sendEvent(&field, &event);
    }
    void type(const char* keys) {
        QTest::mouseClick(&field, Qt::LeftButton, {}, from);
        QTest::keyClicks(&field, QString::fromLatin1(keys));
    }

    const QPoint from{20, 12};
    NumberField field{{0, 3, -10, 10, 3, false, {}}}; // 100 pixels are 1
    QLineEdit other;
    QSignalSpy started{&field, &NumberField::dragStarted};
    QSignalSpy dragged{&field, &NumberField::dragged};
    QSignalSpy finished{&field, &NumberField::dragFinished};
    QSignalSpy edited{&field, &NumberField::edited};
    QSignalSpy stepped{&field, &NumberField::stepped};
};

TEST_F(NumberFieldTest, ScrubsByTheDistance) {
    drag(50);
    EXPECT_DOUBLE_EQ(field.value(), 1.0);
    EXPECT_EQ(started.count(), 1);
    EXPECT_EQ(finished.count(), 1);
    EXPECT_EQ(dragged.last().at(0).toDouble(), 1.0);
    EXPECT_EQ(edited.count(), 0);
    EXPECT_FALSE(field.isEditing());
}

TEST_F(NumberFieldTest, ShiftIsFineAndControlIsCoarse) {
    drag(50, Qt::ShiftModifier);
    EXPECT_DOUBLE_EQ(field.value(), 0.55);
    field.setValue(0.5);
    drag(50, Qt::ControlModifier);
    EXPECT_DOUBLE_EQ(field.value(), 5.5);
}

TEST_F(NumberFieldTest, ChangingTheSpeedOnTheWayDoesNotJump) {
    move(50);
    EXPECT_DOUBLE_EQ(field.value(), 1.0);
    moveTo(50, Qt::ShiftModifier);
    EXPECT_DOUBLE_EQ(field.value(), 1.0);
    moveTo(60, Qt::ShiftModifier);
    EXPECT_DOUBLE_EQ(field.value(), 1.01);
}

TEST_F(NumberFieldTest, GoingBackEndsExactlyWhereItBegan) {
    field.setValue(0.123456789);
    move(77);
    ASSERT_NE(field.value(), 0.123456789);
    moveTo(0);
    EXPECT_EQ(field.value(), 0.123456789);
    EXPECT_EQ(dragged.last().at(0).toDouble(), 0.123456789);
}

TEST_F(NumberFieldTest, StopsAtTheHardRange) {
    drag(5000);
    EXPECT_EQ(field.value(), 10);
    drag(-9000);
    EXPECT_EQ(field.value(), -10);
}

TEST_F(NumberFieldTest, EscapeDuringAScrubRestores) {
    move(50);
    QTest::keyClick(&field, Qt::Key_Escape);
    EXPECT_EQ(field.value(), 0.5);
    EXPECT_EQ(dragged.last().at(0).toDouble(), 0.5);
    EXPECT_EQ(finished.count(), 1);
    moveTo(90); // the button is still down
    EXPECT_EQ(field.value(), 0.5);
}

TEST_F(NumberFieldTest, AClickTypesAndEnterTakesIt) {
    type("0,75");
    EXPECT_TRUE(field.isEditing());
    EXPECT_EQ(edited.count(), 0);
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(field.value(), 0.75);
    ASSERT_EQ(edited.count(), 1);
    EXPECT_EQ(edited[0][0].toDouble(), 0.75);
    EXPECT_EQ(started.count(), 0);
}

TEST_F(NumberFieldTest, EscapeWhileTypingKeepsTheOldValue) {
    type("0.9");
    QTest::keyClick(&field, Qt::Key_Escape);
    EXPECT_EQ(field.value(), 0.5);
    EXPECT_EQ(edited.count(), 0);
    EXPECT_EQ(field.text().toStdString(), "0.50");
}

TEST_F(NumberFieldTest, NonsenseAndUnchangedTextsAreNoEdit) {
    type("abc");
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(field.value(), 0.5);
    QTest::mouseClick(&field, Qt::LeftButton, {}, from);
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(edited.count(), 0);
}

TEST_F(NumberFieldTest, TypedValuesKeepTheirDigitsAndTheHardRange) {
    type("0.1234567");
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(field.value(), 0.1234567);
    type("1e9");
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(field.value(), 10);
}

TEST_F(NumberFieldTest, WheelOnlyWithTheFocus) {
    const auto wheel = [&](int angle) {
        QWheelEvent event(QPointF(from), field.mapToGlobal(QPointF(from)), {}, {0, angle},
                          Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&field, &event);
        return event.isAccepted();
    };
    other.activateWindow();
    other.setFocus();
    field.clearFocus();
    EXPECT_FALSE(wheel(120));
    EXPECT_EQ(field.value(), 0.5);
    // Asked for again and again: on a busy display the other's turn may come last.
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            field.activateWindow();
            field.setFocus();
            return field.hasFocus();
        },
        60'000));
    EXPECT_TRUE(wheel(120));
    EXPECT_DOUBLE_EQ(field.value(), 0.52); // a hundredth of the range, as a round number: 0.02
    EXPECT_TRUE(wheel(-240));
    EXPECT_DOUBLE_EQ(field.value(), 0.48);
    EXPECT_EQ(stepped.count(), 2);
}

TEST(NumberField, ParsesUnitsAndCommas) {
    EXPECT_EQ(NumberField::parse(QStringLiteral("45°"), QStringLiteral("°")), 45.0);
    EXPECT_EQ(NumberField::parse(QStringLiteral(" -0,5 ev"), QStringLiteral(" EV")), -0.5);
    EXPECT_EQ(NumberField::parse(QStringLiteral("1e-3"), {}), 1e-3);
    for (const char* bad : {"", "x", "nan", "inf", "1.2.3", "--1"})
        EXPECT_EQ(NumberField::parse(QString::fromLatin1(bad), {}), std::nullopt) << bad;
}

TEST(NumberField, ComputesSums) {
    const auto value = [](const char* text) {
        return NumberField::parse(QString::fromUtf8(text), QStringLiteral("EV"));
    };
    EXPECT_EQ(value("1/3"), 1.0 / 3.0);
    EXPECT_EQ(value("1/3 EV"), 1.0 / 3.0);
    EXPECT_EQ(value("2+3*4"), 14.0);
    EXPECT_EQ(value("(2+3)*4-1"), 19.0);
    EXPECT_EQ(value("8/2/2"), 2.0);
    EXPECT_EQ(value("2^3^2"), 512.0);
    EXPECT_EQ(value("-2^2"), -4.0);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value(" 1 - -2 "), 3.0);
    EXPECT_EQ(value("1e3/2"), 500.0);
    EXPECT_EQ(value("0,5×2"), 1.0);
    EXPECT_EQ(value("−1÷4"), -0.25);
    for (const char* broken : {"", "1/", "/2", "1/0", "(1", "1)", "1 2", "2*", "1e", "a", "1..2",
                               "0x10", "nan", "inf", "1e999", "()", "--", "1**2"})
        EXPECT_EQ(value(broken), std::nullopt) << broken;
    EXPECT_EQ(value(std::string(100'000, '(').c_str()), std::nullopt) << "no end of the stack";
    EXPECT_EQ(value(std::string(100'000, '-').c_str()), std::nullopt);
}

TEST_F(NumberFieldTest, ASumIsTakenAndNonsenseIsMarkedUntilItIsCorrected) {
    type("1/3");
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(field.value(), 1.0 / 3.0);
    EXPECT_EQ(edited.count(), 1);

    type("1/");
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_TRUE(field.isEditing()) << "to be corrected";
    EXPECT_TRUE(field.property("refused").toBool());
    EXPECT_EQ(field.text(), QStringLiteral("1/"));
    EXPECT_EQ(edited.count(), 1);
    QTest::keyClick(&field, Qt::Key_4);
    EXPECT_FALSE(field.property("refused").toBool());
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_EQ(field.value(), 0.25);
    EXPECT_EQ(edited.count(), 2);

    type("x");
    QTest::keyClick(&field, Qt::Key_Return);
    QTest::keyClick(&field, Qt::Key_Escape);
    EXPECT_FALSE(field.isEditing());
    EXPECT_FALSE(field.property("refused").toBool());
    EXPECT_EQ(field.value(), 0.25);
    EXPECT_EQ(edited.count(), 2);
}

TEST(NumberField, FormatsWithoutNoise) {
    EXPECT_EQ(NumberField::format(0.5, 3).toStdString(), "0.50");
    EXPECT_EQ(NumberField::format(0.125, 3).toStdString(), "0.125");
    EXPECT_EQ(NumberField::format(-0.0001, 3).toStdString(), "0.00");
    EXPECT_EQ(NumberField::format(100, 0).toStdString(), "100");
    EXPECT_EQ(NumberField::format(45, 1).toStdString(), "45.0");
}

TEST(NumberField, AnglesGoAround) {
    NumberField field({-180, 180, -180, 180, 1, true, QStringLiteral("°")});
    field.resize(80, 24);
    field.setValue(170);
    field.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&field));
    QTest::mousePress(&field, Qt::LeftButton, {}, {20, 12});
    QTest::mouseMove(&field, {20 + 25, 12}); // 360° are 300 pixels, so 30°
    QTest::mouseRelease(&field, Qt::LeftButton, {}, {20 + 25, 12});
    EXPECT_DOUBLE_EQ(field.value(), -160);
    EXPECT_EQ(field.text(), QStringLiteral("-160.0°"));
}

TEST(SliderTest, TheHandleGoesAlongAndBackToItsExactStart) {
    Slider slider(0, 1, 0);
    slider.resize(214, 24); // 200 pixels of way
    slider.setValue(0.123456);
    slider.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&slider));
    QSignalSpy dragged(&slider, &Slider::dragged);
    const QPoint at(slider.handleX(), 12);
    QTest::mousePress(&slider, Qt::LeftButton, {}, at);
    EXPECT_EQ(dragged.count(), 0); // taking the handle changes nothing
    QTest::mouseMove(&slider, at + QPoint(100, 0));
    EXPECT_NEAR(dragged.last().at(0).toDouble(), 0.623456, 0.006);
    QTest::mouseMove(&slider, at);
    EXPECT_EQ(dragged.last().at(0).toDouble(), 0.123456);
    QTest::mouseMove(&slider, at + QPoint(5000, 0));
    EXPECT_EQ(dragged.last().at(0).toDouble(), 1.0);
    QTest::mouseRelease(&slider, Qt::LeftButton, {}, at);
}

TEST(SliderTest, APressElsewhereJumps) {
    Slider slider(0, 1, 0);
    slider.resize(214, 24);
    slider.setValue(0);
    slider.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&slider));
    QSignalSpy dragged(&slider, &Slider::dragged);
    QTest::mouseClick(&slider, Qt::LeftButton, {}, {107, 12});
    ASSERT_EQ(dragged.count(), 1);
    EXPECT_NEAR(dragged[0][0].toDouble(), 0.5, 0.006);
}

// 0.5 linear is 188 on the display, not 128: IEC 61966-2-1.
TEST(Color, IsLinearInsideAndEncodedOutside) {
    EXPECT_EQ(hexOf(glm::vec3(0.5f)).toStdString(), "#bcbcbc");
    EXPECT_EQ(hexOf(glm::vec3(1, 0, 0.21404114f)).toStdString(), "#ff0080");
    const auto color = parseHex(QStringLiteral("#808080"));
    ASSERT_TRUE(color);
    EXPECT_NEAR(color->x, 0.2158605f, 1e-5);
    EXPECT_EQ(parseHex(QStringLiteral("c84")), parseHex(QStringLiteral("#cc8844")));
    for (const char* bad : {"", "#12", "#12345", "red", "#gggggg"})
        EXPECT_EQ(parseHex(QString::fromLatin1(bad)), std::nullopt) << bad;
}

TEST(Color, HsvGoesThereAndBack) {
    for (float r = 0; r <= 1; r += 0.25f)
        for (float g = 0; g <= 1; g += 0.25f)
            for (float b = 0; b <= 1; b += 0.25f) {
                const glm::vec3 back = linearOf(hsvOf({r, g, b}));
                EXPECT_NEAR(back.x, r, 1e-4);
                EXPECT_NEAR(back.y, g, 1e-4);
                EXPECT_NEAR(back.z, b, 1e-4);
            }
}

TEST(ColorPickerTest, KeepsTheHueOfWhatBecomesGrey) {
    ColorPicker picker;
    picker.setColor(linearOf({0.6f, 0.8f, 0.9f}));
    picker.show();
    auto* square = picker.findChild<SaturationValueSquare*>();
    QSignalSpy dragged(&picker, &ColorPicker::dragged);
    const auto drag = [&](QPoint at) {
        QTest::mousePress(square, Qt::LeftButton, {}, at);
        QTest::mouseRelease(square, Qt::LeftButton, {}, at);
    };
    drag({-1, -1}); // no saturation: white
    const auto white = qvariant_cast<glm::vec3>(dragged.last().at(0));
    EXPECT_NEAR(white.x, 1, 1e-5);
    picker.setColor(white); // as the document says it back
    drag({square->width() - 1, 0});
    const auto back = hsvOf(qvariant_cast<glm::vec3>(dragged.last().at(0)));
    EXPECT_NEAR(back.hue, 0.6f, 1e-3);
    EXPECT_NEAR(back.saturation, 1.0f, 1e-3);
}

TEST(MapSlotTest, SourcesHaveReadableNames) {
    EXPECT_EQ(MapSlotWidget::sourceTitle("/home/ann/tex/bricks_d.png").toStdString(),
              "bricks_d.png");
    EXPECT_EQ(MapSlotWidget::sourceTitle("builtin:wood/baseColor").toStdString(), "Wood");
    EXPECT_EQ(MapSlotWidget::sourceTitle("/a/chair.glb#embedded:1").toStdString(),
              "image 2 of chair.glb");
}

TEST(ThumbnailsTest, ShowsWhatTheEncodingMeans) {
    Image data(2, 2, 1, PixelType::U8, ColorEncoding::Data);
    std::fill(data.u8().begin(), data.u8().end(), std::uint8_t{128});
    EXPECT_EQ(qRed(displayImage(data, 8).pixel(0, 0)), 128); // numbers as they are
    Image color(2, 2, 3, PixelType::U8, ColorEncoding::Srgb);
    std::fill(color.u8().begin(), color.u8().end(), std::uint8_t{200});
    EXPECT_EQ(qGreen(displayImage(color, 8).pixel(1, 1)), 200); // decoded and encoded again
    Image large(64, 16, 3, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_EQ(displayImage(large, 8).size(), QSize(8, 2));
    EXPECT_TRUE(displayImage(Image(), 8).isNull());
}

// Two maps in one image look like two maps.
TEST(ThumbnailsTest, ShowTheChannelThatIsRead) {
    auto packed = std::make_shared<Image>(2, 2, 4, PixelType::U8, ColorEncoding::Data);
    for (std::size_t i = 0; i < packed->u8().size(); ++i)
        packed->u8()[i] = static_cast<std::uint8_t>(40 + 50 * (i % 4));
    const MapChannel channels[] = {MapChannel::R, MapChannel::G, MapChannel::B, MapChannel::A};
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(displayImage(*packed, 8, 0.0f, channels[c]).pixel(1, 1),
                  qRgb(40 + 50 * c, 40 + 50 * c, 40 + 50 * c));
    EXPECT_EQ(displayImage(*packed, 8).pixel(1, 1), qRgb(40, 90, 140));

    // In the slot's own picture, which follows the choice of the channel.
    TaskRunner runner(postToThisThread());
    Thumbnails thumbnails(runner);
    MapSlotWidget widget(thumbnails, QStringLiteral("Roughness map"), false);
    widget.resize(240, 60);
    MapSlot slot;
    slot.source = "/packed.png";
    slot.image = packed;
    for (int c = 0; c < 4; ++c) {
        slot.channel = channels[c];
        widget.setSlot(slot);
        EXPECT_TRUE(QTest::qWaitFor([&] {
            return qRed(widget.grab().toImage().pixel(20, 20)) == 40 + 50 * c;
        })) << c;
    }
}

TEST(NoticeAreaTest, StacksCountsAndDismisses) {
    QWidget picture;
    picture.resize(600, 400);
    NoticeArea area(picture);
    picture.show();
    const UserNotice missing{NoticeKind::Warning,
                             QStringLiteral("2 files are missing"),
                             {QStringLiteral("Missing: a.png"), QStringLiteral("Missing: b.png")}};
    area.add(missing);
    area.add({NoticeKind::Error, QStringLiteral("x.png is damaged"), {}});
    ASSERT_EQ(area.bars().size(), 2);
    EXPECT_EQ(area.bars()[0]->notice().text, QStringLiteral("x.png is damaged"));
    area.add(missing); // the same again: counted, not stacked
    EXPECT_EQ(area.bars().size(), 2);
    EXPECT_TRUE(area.isVisible());
    for (QToolButton* button : area.bars()[0]->findChildren<QToolButton*>())
        if (button->toolTip() == QStringLiteral("Dismiss"))
            button->click();
    EXPECT_EQ(area.bars().size(), 1);
    for (int i = 0; i < 20; ++i)
        area.add({NoticeKind::Error, QString::number(i), {}});
    EXPECT_EQ(area.bars().size(), 2);
    EXPECT_EQ(area.bars()[0]->notice().text, QStringLiteral("19"));
}

TEST(NoticeAreaTest, LiesInsideThePictureWhateverItsSize) {
    QWidget picture;
    picture.resize(600, 400);
    NoticeArea area(picture);
    picture.show();
    const QString sentence = QStringLiteral("A sentence that says what happened and what to do. ");
    area.add({NoticeKind::Error, sentence.repeated(4), {}});
    area.add({NoticeKind::Warning, QStringLiteral("Short"), {}});
    for (const QSize& size : {QSize(600, 400), QSize(320, 240), QSize(1900, 900)}) {
        picture.resize(size);
        test::handleEvents();
        EXPECT_TRUE(picture.rect().contains(area.geometry())) << size.width();
        EXPECT_TRUE(area.bars()[0]->isVisible());
        for (const NoticeBar* bar : area.bars()) {
            if (!bar->isVisible())
                continue;
            for (const QLabel* label : bar->findChildren<QLabel*>())
                EXPECT_GE(label->height(), label->heightForWidth(label->width()))
                    << label->text().toStdString();
        }
    }
}

// What was read and sent away is no news when the file is opened again; that it failed again is.
TEST(NoticeAreaTest, AWarningThatWasDismissedStaysAway) {
    QWidget picture;
    picture.resize(600, 400);
    NoticeArea area(picture);
    picture.show();
    const auto dismiss = [&] {
        for (QToolButton* button : area.bars()[0]->findChildren<QToolButton*>())
            if (button->toolTip() == QStringLiteral("Dismiss"))
                button->click();
    };
    const UserNotice warning{NoticeKind::Warning,
                             QStringLiteral("b.obj has no normals"),
                             {},
                             QStringLiteral("/a/b.obj")};
    for (const NoticeKind kind : {NoticeKind::Warning, NoticeKind::Error}) {
        UserNotice notice = warning;
        notice.kind = kind;
        notice.text += QString::number(static_cast<int>(kind));
        area.add(notice);
        ASSERT_EQ(area.bars().size(), 1);
        dismiss();
        area.add(notice);
        EXPECT_EQ(area.bars().size(), kind == NoticeKind::Error ? 1 : 0);
    }
    dismiss();
    UserNotice other = warning;
    other.text += QStringLiteral("0");
    other.file = QStringLiteral("/c/b.obj");
    area.add(other);
    EXPECT_EQ(area.bars().size(), 1) << "of another file";
}

TEST(NoticeAreaTest, ALowPictureShowsTheNewestAlone) {
    QWidget picture;
    picture.resize(600, 160);
    NoticeArea area(picture);
    picture.show();
    area.add({NoticeKind::Error, QStringLiteral("First"), {}});
    area.add({NoticeKind::Error, QStringLiteral("Second"), {}});
    test::handleEvents();
    ASSERT_EQ(area.bars().size(), 2);
    EXPECT_TRUE(area.bars()[0]->isVisible());
    EXPECT_FALSE(area.bars()[1]->isVisible());
    picture.resize(600, 900);
    test::handleEvents();
    EXPECT_TRUE(area.bars()[1]->isVisible());
}

TEST(NoticeAreaTest, TellsFilesOfOneNameApartByTheirFolders) {
    QWidget picture;
    NoticeArea area(picture);
    const auto empty = [](const QString& file) {
        return UserNotice{
            NoticeKind::Error, QStringLiteral("scene.gltf: the file is empty"), {file}, file};
    };
    const auto shown = [&] {
        QStringList texts;
        for (const NoticeBar* bar : area.bars())
            texts << bar->text();
        return texts;
    };
    area.add(empty(QStringLiteral("/models/bike/scene.gltf")));
    EXPECT_EQ(shown(), QStringList{QStringLiteral("scene.gltf: the file is empty")});
    area.add(empty(QStringLiteral("/models/car/scene.gltf")));
    EXPECT_EQ(shown(), (QStringList{QStringLiteral("car/scene.gltf: the file is empty"),
                                    QStringLiteral("bike/scene.gltf: the file is empty")}));
    area.add(empty(QStringLiteral("/old/car/scene.gltf")));
    EXPECT_EQ(shown(), (QStringList{QStringLiteral("old/car/scene.gltf: the file is empty"),
                                    QStringLiteral("models/car/scene.gltf: the file is empty")}));
    area.add(empty(QStringLiteral("/old/car/scene.gltf"))); // the same file again
    EXPECT_EQ(shown()[0], QStringLiteral("old/car/scene.gltf: the file is empty (2 times)"));
}

TEST(NoticeAreaTest, GoodNewsFadesAndProblemsStay) {
    QWidget picture;
    picture.resize(600, 400);
    NoticeArea area(picture);
    picture.show();
    area.add({NoticeKind::Info, QStringLiteral("Exported"), {}});
    area.add({NoticeKind::Error, QStringLiteral("Broken"), {}});
    ASSERT_EQ(area.bars().size(), 2);
    ASSERT_TRUE(QTest::qWaitFor([&] { return area.bars().size() == 1; }, 60'000));
    EXPECT_EQ(area.bars()[0]->notice().text, QStringLiteral("Broken"));
}

TEST(LogPanelTest, ShowsTheBeginningOfItsNewestLine) {
    LogPanel panel;
    panel.resize(300, 120);
    panel.show();
    for (int i = 0; i < 30; ++i)
        logWarning("{} {}", i, std::string(400, 'x'));
    auto* text = panel.findChild<QPlainTextEdit*>();
    ASSERT_NE(text, nullptr);
    ASSERT_TRUE(QTest::qWaitFor([&] { return text->blockCount() >= 30; }, 60'000));
    test::handleEvents();
    EXPECT_GT(text->horizontalScrollBar()->maximum(), 0);
    EXPECT_EQ(text->horizontalScrollBar()->value(), 0);
    EXPECT_EQ(text->verticalScrollBar()->value(), text->verticalScrollBar()->maximum());
    text->verticalScrollBar()->setValue(0); // somebody reads
    logWarning("one more");
    ASSERT_TRUE(QTest::qWaitFor([&] { return text->blockCount() >= 31; }, 60'000));
    EXPECT_EQ(text->verticalScrollBar()->value(), 0);
}

TEST(OutputFileTest, FormatAndExtensionFollowEachOther) {
    QDialog dialog;
    QFormLayout form(&dialog);
    OutputFile output(QStringLiteral("x"),
                      {{QStringLiteral("Exact"), QStringLiteral("exr"), QStringLiteral("OpenEXR")},
                       {QStringLiteral("Small"), QStringLiteral("hdr"), QStringLiteral("HDR")}},
                      QStringLiteral("/a/sky.v2.exr"), dialog);
    output.addFormatRow(form, QStringLiteral("help"));
    output.addFileRow(form);
    output.addButtons(form, QStringLiteral("Save"));
    auto* format = dialog.findChild<QComboBox*>(QStringLiteral("xFormat"));
    auto* path = dialog.findChild<QLineEdit*>(QStringLiteral("xPath"));
    auto* run = dialog.findChild<QPushButton*>(QStringLiteral("xRun"));
    ASSERT_TRUE(format && path && run);
    const QSignalSpy changed(&output, &OutputFile::changed);
    const QSignalSpy accepted(&output, &OutputFile::accepted);

    format->setCurrentIndex(1);
    EXPECT_EQ(output.path(), QStringLiteral("/a/sky.v2.hdr"));
    EXPECT_EQ(changed.count(), 1);
    path->setText(QStringLiteral(" /b/Dawn.EXR "));
    EXPECT_EQ(output.format(), 0);
    EXPECT_EQ(output.path(), QStringLiteral("/b/Dawn.EXR")); // as typed
    EXPECT_EQ(changed.count(), 2);
    path->setText(QStringLiteral("/b/Dawn.txt")); // of no format
    EXPECT_EQ(output.format(), 0);

    output.setRunnable(false, QStringLiteral("Save"));
    run->click();
    EXPECT_EQ(accepted.count(), 0);
    output.setRunnable(true, QStringLiteral("Overwrite"));
    EXPECT_EQ(run->text(), QStringLiteral("Overwrite"));
    run->click();
    EXPECT_EQ(accepted.count(), 1);
}

TEST(BusyIndicator, TurnsLessOftenWhereTheWindowTakesLongToShow) {
    EXPECT_EQ(BusyIndicator::stepMs(0.5), 50) << "20 times a second";
    EXPECT_EQ(BusyIndicator::stepMs(20.0), 400) << "a twentieth of the time at most";
    EXPECT_EQ(BusyIndicator::stepMs(5000.0), 1000) << "it never seems to stand still";

    // Measured of what is on screen, and it turns.
    BusyIndicator indicator;
    indicator.setActivity(QStringLiteral("Working"));
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&indicator));
    const QImage first = indicator.grab().toImage();
    EXPECT_TRUE(QTest::qWaitFor([&] { return indicator.grab().toImage() != first; }, 30'000));
}

} // namespace
} // namespace patina::editor
