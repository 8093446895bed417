// What all plots, charts and pictures of values have in common, held for each by one table: axes
// with units, a cursor for pointer and keys, a readout that tells the value there, a name, words
// when they are empty, and their values as text.
#include "app/editor/panel/LabPicture.h"
#include "app/editor/widget/BandBars.h"
#include "app/editor/widget/ContributionChart.h"
#include "app/editor/widget/DirectionAxes.h"
#include "app/editor/widget/EnergyBars.h"
#include "app/editor/widget/EnergyMap.h"
#include "app/editor/widget/FurnacePlot.h"
#include "app/editor/widget/LitSphere.h"
#include "app/editor/widget/LobeView.h"
#include "app/editor/widget/PictureTile.h"
#include "app/editor/widget/PolarPlot.h"
#include "app/editor/widget/ToneCurvePlot.h"
#include "core/light/LensCurves.h"
#include "tests/app/editor/EditorFixture.h"

#include <QClipboard>
#include <QMouseEvent>
#include <QSignalSpy>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace patina::editor {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PlotAxis angle(double min) {
    return {QStringLiteral("θₒ"), QStringLiteral("°"), min, 90.0, 30.0};
}
const PlotAxis kReflected{QStringLiteral("fᵣ"), QStringLiteral(" sr⁻¹")};

// 0.01 for each degree.
std::vector<PlotCurve> ramp(double min) {
    PlotCurve curve;
    for (double x = min; x <= 90.0; x += 10.0)
        curve.points.emplace_back(x, 0.01 * x + 1.0);
    return {curve};
}

QImage grey() {
    QImage image(64, 32, QImage::Format_RGB32);
    image.fill(Qt::gray);
    return image;
}

glm::vec3 skyAt(const glm::vec3& direction) {
    return glm::vec3(direction.y);
}

std::shared_ptr<const BrdfLens> lens() {
    DfgTables tables;
    const ShadingModel model;
    return std::make_shared<const BrdfLens>(model, SurfacePoint{glm::vec3(0.5f), 0.0f, 0.4f, 0.0f},
                                            tables.of(model));
}

TEST(PlotAxis, NumbersOfALogarithmicAxisArePowersOfTenAscending) {
    using Ticks = std::vector<double>;
    const auto ticks = [](double min, double max, int most) {
        PlotAxis axis{QStringLiteral("shots"), {}, min, max, 0.0, true, false};
        return axis.ticks(most);
    };
    const auto near = [](const Ticks& found, const Ticks& wanted) {
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], wanted[i], 1e-9 * wanted[i]);
    };
    near(ticks(1.0, 66433.0, 4), {1, 10, 100, 1000, 10000});
    near(ticks(1e-3, 100.0, 5), {1e-3, 1e-2, 1e-1, 1, 10, 100});
    near(ticks(1e-7, 1.0, 3), {1e-6, 1e-4, 1e-2, 1});
    near(ticks(1.0, 8.0, 4), {1, 2, 5});
    near(ticks(6.0, 8.0, 4), {6, 8});
}

// Numbers along the axis whichever way it runs, and what the values are without a title, too.
TEST(CurvePlotTest, AxesHaveNumbersNamesAndUnits) {
    CurvePlot plot({});
    plot.resize(300, 200);
    plot.setAxes({QStringLiteral("shots + 1"), {}, 1.0, 66433.0, 0.0, true, false},
                 {QStringLiteral("missing"), QStringLiteral(" %"), 1e-3, 100.0, 0.0, true, false});
    PlotCurve curve;
    curve.points = {{1.0, 100.0}, {66433.0, 1e-3}};
    plot.setCurves({curve});
    const auto ink = [&](const QRect& part) { // pixels as bright as text
        const QImage image = plot.grab(part).toImage();
        int count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                count += qGray(image.pixel(x, y)) > 90 ? 1 : 0;
        return count;
    };
    const QPointF left = plot.position(1.0, 1e-3), third = plot.position(100.0, 1e-3);
    EXPECT_GT(ink({int(left.x()) - 8, int(left.y()) + 3, 16, 14}), 4) << "1";
    EXPECT_GT(ink({int(third.x()) - 12, int(third.y()) + 3, 24, 14}), 12) << "100";
    // The curve falls: above its end is room for what the values are.
    const QPointF top = plot.position(66433.0, 100.0);
    EXPECT_GT(ink({int(top.x()) - 75, int(top.y()) + 2, 74, 14}), 20) << "missing [%]";
}

struct Entry {
    const char* name;
    QStringList axes; // with units, as they are titled
    std::function<PlotFrame*(Session&)> make;
    std::function<void(PlotFrame&)> fill;        // not set: it always has values
    QPointF place;                               // where the pointer is brought
    std::function<double(const QPointF&)> value; // that the readout tells there
    int key = Qt::Key_Right;
};

void PrintTo(const Entry& entry, std::ostream* out) {
    *out << entry.name;
}

std::vector<Entry> entries() {
    static const std::shared_ptr<const BrdfLens> shown = lens();
    const QString deg = QStringLiteral("θₒ [°]");
    const auto sky = [](const QPointF& place) { return double{skyAt(directionAt(place)).x}; };
    std::vector<Entry> all;
    all.push_back({"CurvePlot",
                   {deg, QStringLiteral("fᵣ [sr⁻¹]")},
                   [](Session&) {
                       auto* plot = new CurvePlot(QStringLiteral("Curves"));
                       plot->setAxes(angle(0.0), kReflected);
                       return plot;
                   },
                   [](PlotFrame& frame) { static_cast<CurvePlot&>(frame).setCurves(ramp(0.0)); },
                   {45.0, 0.0},
                   [](const QPointF& p) { return 0.01 * p.x() + 1.0; }});
    all.push_back({"PolarPlot",
                   {deg, QStringLiteral("fᵣ [sr⁻¹]")},
                   [](Session&) {
                       auto* plot = new PolarPlot(QStringLiteral("Polar"));
                       plot->setQuantity(kReflected.name, kReflected.unit);
                       return plot;
                   },
                   [](PlotFrame& frame) {
                       static_cast<PolarPlot&>(frame).setCurves(ramp(-90.0), 1.9, false, 4.0);
                   },
                   {45.0, 1.0},
                   [](const QPointF& p) { return 0.01 * p.x() + 1.0; }});
    all.push_back({"EnergyPlot",
                   {QStringLiteral("angle [°]"), QStringLiteral("returned [%]")},
                   [](Session&) {
                       return new EnergyPlot(
                           QStringLiteral("By angle"),
                           {QStringLiteral("angle"), QStringLiteral("°"), 0.0, 90.0, 30.0});
                   },
                   [](PlotFrame& frame) { static_cast<CurvePlot&>(frame).setCurves(ramp(0.0)); },
                   {30.0, 0.0},
                   [](const QPointF& p) { return 0.01 * p.x() + 1.0; }});
    all.push_back({"FurnacePlot",
                   {QStringLiteral("roughness"), QStringLiteral("returned [%]")},
                   [](Session&) { return new FurnacePlot; },
                   {},
                   {0.8, 0.0},
                   [](const QPointF& p) {
                       return 100.0 * double{FurnacePlot().returned(static_cast<float>(p.x()))};
                   }});
    all.push_back({"ToneCurvePlot",
                   {QStringLiteral("light [EV]"), QStringLiteral("display [%]")},
                   [](Session&) { return new ToneCurvePlot; },
                   [](PlotFrame& frame) {
                       static_cast<ToneCurvePlot&>(frame).setCurve({0.0f, 0.25f, 1.0f});
                   },
                   {-4.0, 0.0},
                   [](const QPointF& p) {
                       return p.x() < 0.0 ? 25.0 * (p.x() + 8.0) / 8.0 : 25.0 + 75.0 * p.x() / 8.0;
                   }});
    all.push_back(
        {"EnergyMap",
         {QStringLiteral("roughness"), QStringLiteral("angle [°]"), QStringLiteral("returned [%]")},
         [](Session&) { return new EnergyMap; },
         [](PlotFrame& frame) {
             static_cast<EnergyMap&>(frame).setValues({0.5, 1.0, 0.5, 1.0}, 2);
         },
         {0.5, 30.0},
         [](const QPointF& p) { return 50.0 + 50.0 * std::clamp(2.0 * p.x() - 0.5, 0.0, 1.0); }});
    all.push_back(
        {"EnergyBars",
         {QStringLiteral("part"), QStringLiteral("compensation"), QStringLiteral("share [%]")},
         [](Session&) { return new EnergyBars; },
         [](PlotFrame& frame) {
             static_cast<EnergyBars&>(frame).setShares({0.4, 0.3, 0.2, 0.1}, {0.5, 0.3, 0.2, 0.0},
                                                       false);
         },
         {1.0, 0.0},
         [](const QPointF& p) { return 40.0 - 10.0 * p.x(); }});
    all.push_back({"ContributionChart",
                   {QStringLiteral("radiance [cd/m²]"), QStringLiteral("contribution")},
                   [](Session&) { return new ContributionChart; },
                   [](PlotFrame& frame) {
                       static_cast<ContributionChart&>(frame).setContributions(
                           {{"a", "Sun", glm::vec3(0.5f), glm::vec3(0.0f), true},
                            {"b", "Sky", glm::vec3(0.25f), glm::vec3(0.0f), true}});
                   },
                   {0.0, 1.0},
                   [](const QPointF& p) { return p.y() < 0.5   ? 0.5
                                                 : p.y() < 1.5 ? 0.25
                                                               : 0.75; },
                   Qt::Key_Up});
    all.push_back({"BandBars",
                   {QStringLiteral("l, m"), QStringLiteral("transfer")},
                   [](Session&) { return new BandBars; },
                   [](PlotFrame& frame) {
                       static_cast<BandBars&>(frame).setCoefficients(
                           {0.125f, -0.5f, 0.75f, 0.25f},
                           {QStringLiteral("0.1"), QStringLiteral("0.2")});
                   },
                   {2.0, 0.0},
                   [](const QPointF& p) {
                       return std::array{0.125, -0.5, 0.75, 0.25}[static_cast<std::size_t>(p.x())];
                   }});
    all.push_back(
        {"LobeView",
         {QStringLiteral("φ [°]"), deg, QStringLiteral("fᵣ [sr⁻¹]")},
         [](Session& session) { return new LobeView(session.tasks, QStringLiteral("In space")); },
         [](PlotFrame& frame) {
             const glm::vec3 toLight = lensDirection(-0.5f);
             const float peak = lobePeak(*shown, toLight, LobeEnd::Light, {});
             static_cast<LobeView&>(frame).setLobes(
                 {{{0, QStringLiteral("shown")},
                   std::make_shared<const LobeMesh>(
                       makeLobeMesh(*shown, toLight, LobeEnd::Light, {}, peak)),
                   shown}},
                 0.5 * 180.0 / std::numbers::pi, {}, double{peak});
         },
         {0.0, 20.0},
         [](const QPointF& p) {
             const double phi = p.x() * std::numbers::pi / 180.0;
             const double theta = p.y() * std::numbers::pi / 180.0;
             const glm::vec3 v(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
             return double{
                 shading::luminance(shown->brdf(lensDirection(-0.5f), v, LensLobe::Both))};
         }});
    all.push_back(
        {"LitSphere",
         {QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("luminance [cd/m²]")},
         [](Session& session) { return new LitSphere(session.tasks, QStringLiteral("On a ball")); },
         [](PlotFrame& frame) {
             static_cast<LitSphere&>(frame).setBalls({{{0, QStringLiteral("shown")}, shown}});
         },
         {-0.3, 0.3},
         [](const QPointF& p) {
             SphereLight light;
             light.toLight = glm::normalize(glm::vec3(-0.75f, 0.75f, 0.6f));
             const glm::vec2 at(static_cast<float>(p.x()), static_cast<float>(p.y()));
             return double{shading::luminance(
                 sphereRadiance(*shown, light, {at, std::sqrt(1.0f - glm::dot(at, at))}))};
         }});
    all.push_back({"PictureTile",
                   {QStringLiteral("azimuth [°]"), QStringLiteral("elevation [°]"),
                    QStringLiteral("radiance [cd/m²]")},
                   [](Session&) {
                       return new PictureTile(QStringLiteral("Sky"), {QStringLiteral("radiance"),
                                                                      QStringLiteral(" cd/m²")});
                   },
                   [](PlotFrame& frame) {
                       static_cast<PictureTile&>(frame).setPicture(
                           grey(), QStringLiteral("a note"),
                           [](const glm::vec3& d) { return std::vector{double{skyAt(d).x}}; });
                   },
                   {90.0, 30.0},
                   sky});
    all.push_back(
        {"LabPicture",
         {QStringLiteral("azimuth [°]"), QStringLiteral("elevation [°]"),
          QStringLiteral("radiance [cd/m²]")},
         [](Session&) {
             auto* picture = new LabPicture({LabKind::Environment, 0}, LabPicture::Role::Stage);
             picture->setCaption(QStringLiteral("Environment"), {});
             picture->setReader([](const LabPlace& place) {
                 return std::vector<PlotValue>{{{}, {double{skyAt(place.direction).x}}}};
             });
             return picture;
         },
         [](PlotFrame& frame) { static_cast<LabPicture&>(frame).setPicture(grey()); },
         {90.0, 30.0},
         sky});
    return all;
}

class PlotsTest : public ::testing::TestWithParam<Entry> {
  protected:
    static void SetUpTestSuite() { session = std::make_unique<Session>(); }
    static void TearDownTestSuite() { session.reset(); }
    void SetUp() override {
        frame.reset(GetParam().make(*session));
        frame->resize(340, 240);
        frame->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(frame.get(), 60'000));
    }
    void fill() {
        if (GetParam().fill)
            GetParam().fill(*frame);
        ASSERT_EQ(frame->message(), QString());
    }
    void hover(const QPointF& at) {
        QMouseEvent move(QEvent::MouseMove, at, frame->mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                         {});
        QApplication::sendEvent(frame.get(), &move);
    }
    void key(int key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(frame.get(), static_cast<Qt::Key>(key), modifiers);
    }
    // The readout tells the value there, in one of its rows.
    void expectValue(const QPointF& place) {
        const QString number = plotNumber(GetParam().value(place));
        QStringList rows;
        for (const ReadoutRow& row : frame->readoutAt(place).rows)
            rows << row.text;
        EXPECT_TRUE(rows.join(QLatin1Char('\n')).contains(number))
            << number.toStdString() << " is not in " << rows.join(' ').toStdString() << " at "
            << place.x() << ' ' << place.y();
    }

    static std::unique_ptr<Session> session;
    std::unique_ptr<PlotFrame> frame;
};

std::unique_ptr<Session> PlotsTest::session;

TEST_P(PlotsTest, HasANameAndAxesWithUnits) {
    EXPECT_FALSE(frame->accessibleName().isEmpty());
    fill();
    QStringList titles;
    for (const PlotAxis& axis : frame->axes())
        titles << axis.title();
    EXPECT_EQ(titles.join(QLatin1Char('|')).toStdString(),
              GetParam().axes.join(QLatin1Char('|')).toStdString());
}

TEST_P(PlotsTest, SaysWhenThereIsNothing) {
    if (GetParam().fill) {
        EXPECT_FALSE(frame->message().isEmpty());
        key(GetParam().key);
        EXPECT_FALSE(frame->probe().has_value()) << "there is nothing to read";
    }
    fill();
    const QImage values = frame->grab().toImage();
    frame->setMessage(QStringLiteral("Nothing is reflected."));
    EXPECT_EQ(frame->message(), QStringLiteral("Nothing is reflected."));
    EXPECT_NE(frame->grab().toImage(), values);
    frame->setMessage({});
    EXPECT_EQ(frame->grab().toImage(), values);
}

TEST_P(PlotsTest, ThePointerReadsTheValueUnderIt) {
    fill();
    const QImage before = frame->grab().toImage();
    hover(frame->pointOf(GetParam().place));
    ASSERT_TRUE(frame->probe().has_value());
    EXPECT_TRUE(frame->reads());
    const auto near = [this](double at, double wanted, const PlotAxis& axis) {
        EXPECT_NEAR(at, wanted, axis.whole ? 0.0 : 4.0 * std::abs(axis.step()))
            << axis.name.toStdString();
    };
    near(frame->probe()->x(), GetParam().place.x(), frame->axes()[0]);
    if (frame->probe()->y() != 0.0) // else it only moves across
        near(frame->probe()->y(), GetParam().place.y(), frame->axes()[1]);
    expectValue(*frame->probe());
    EXPECT_NE(frame->grab().toImage(), before) << "it is seen";
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(frame.get(), &leave);
    EXPECT_FALSE(frame->probe().has_value());
    EXPECT_EQ(frame->grab().toImage(), before);
}

TEST_P(PlotsTest, TheKeysMoveACursorThatIsTold) {
    fill();
    const QString description = frame->accessibleDescription();
    const QImage before = frame->grab().toImage();
    QSignalSpy probed(frame.get(), &PlotFrame::probed);
    const int away = GetParam().key, back = away == Qt::Key_Up ? Qt::Key_Down : Qt::Key_Left;
    key(Qt::Key_Home);
    ASSERT_TRUE(frame->probe().has_value());
    const QPointF first = *frame->probe();
    key(Qt::Key_End);
    const QPointF last = *frame->probe();
    EXPECT_NE(first, last) << "the ends of the axis";
    key(away == Qt::Key_Up ? away : back);
    const QPointF inside = *frame->probe();
    EXPECT_NE(inside, last);
    key(away == Qt::Key_Up ? back : away);
    EXPECT_EQ(*frame->probe(), last);
    key(away == Qt::Key_Up ? away : back);
    EXPECT_EQ(*frame->probe(), inside);
    EXPECT_EQ(probed.count(), 5);
    expectValue(inside);
    EXPECT_TRUE(frame->reads());
    EXPECT_TRUE(frame->accessibleDescription().startsWith(frame->readoutAt(inside).text()))
        << frame->accessibleDescription().toStdString();
    EXPECT_NE(frame->grab().toImage(), before);
    key(Qt::Key_Escape);
    EXPECT_FALSE(frame->probe().has_value());
    EXPECT_EQ(frame->accessibleDescription(), description);
}

TEST_P(PlotsTest, TheFocusIsSeen) {
    fill();
    const QImage before = frame->grab().toImage();
    EXPECT_TRUE(frame->focusPolicy() & Qt::TabFocus);
    QApplication::setActiveWindow(frame.get());
    frame->setFocus(Qt::OtherFocusReason);
    ASSERT_TRUE(eventually([this] { return frame->hasFocus(); }));
    EXPECT_NE(frame->grab().toImage(), before);
}

TEST_P(PlotsTest, ItsValuesAreCopiedAsText) {
    fill();
    QGuiApplication::clipboard()->clear();
    key(Qt::Key_C, Qt::ControlModifier);
    const QString text = QGuiApplication::clipboard()->text();
    EXPECT_EQ(text, frame->valuesText());
    const QStringList lines = text.split(QLatin1Char('\n'));
    ASSERT_GE(lines.size(), 3);
    const auto columns = lines.front().count(QLatin1Char('\t'));
    EXPECT_GE(columns, 1);
    for (const QString& line : lines)
        EXPECT_EQ(line.count(QLatin1Char('\t')), columns) << line.toStdString();
    for (const QString& title : GetParam().axes) {
        const QString unit = title.mid(title.indexOf(QLatin1Char('[')));
        EXPECT_TRUE(unit == title || lines.front().contains(unit)) << lines.front().toStdString();
    }
}

INSTANTIATE_TEST_SUITE_P(All, PlotsTest, ::testing::ValuesIn(entries()),
                         [](const auto& entry) { return std::string(entry.param.name); });

// --- What some of them do ------------------------------------------------------------------------

TEST(PlotKeys, ReturnDoesWhatAPressDoes) {
    EnergyPlot plot(QStringLiteral("By angle"),
                    {QStringLiteral("angle"), QStringLiteral("°"), 0.0, 90.0, 30.0});
    plot.setCurves(ramp(0.0));
    plot.setMarker(45.0, {});
    QSignalSpy picked(&plot, &EnergyPlot::picked);
    QTest::keyClick(&plot, Qt::Key_Right);
    QTest::keyClick(&plot, Qt::Key_Return);
    ASSERT_EQ(picked.count(), 1);
    EXPECT_EQ(picked.front().front().toDouble(), 46.0) << "keys begin at the marker";

    PolarPlot polar(QStringLiteral("Polar"));
    polar.setCurves(ramp(-90.0), 1.9, false, 4.0);
    polar.setIncidence(30.0);
    QSignalSpy moved(&polar, &PolarPlot::incidenceDragged);
    QTest::keyClick(&polar, Qt::Key_Right, Qt::ControlModifier);
    EXPECT_EQ(moved.count(), 0);
    QTest::keyClick(&polar, Qt::Key_Space);
    ASSERT_EQ(moved.count(), 1);
    EXPECT_EQ(moved.front().front().toDouble(), 40.0) << "ten steps from the mirror direction";
    QTest::keyClick(&polar, Qt::Key_Left, Qt::AltModifier);
    EXPECT_EQ(moved.back().front().toDouble(), 31.0);
    QTest::keyClick(&polar, Qt::Key_Left, Qt::AltModifier | Qt::ShiftModifier);
    EXPECT_NEAR(moved.back().front().toDouble(), 30.1, 1e-9) << "Shift is fine";
}

// What is no number leaves a gap, and neither it nor infinity hides the rest.
TEST(PlotValues, ThatAreNotFiniteAreSaid) {
    CurvePlot plot(QStringLiteral("Curves"));
    plot.resize(300, 200);
    plot.setAxes(angle(0.0), kReflected);
    PlotCurve curve;
    curve.points = {{0, 1}, {30, kNaN}, {60, std::numeric_limits<double>::infinity()}, {90, 2}};
    plot.setCurves({curve});
    EXPECT_GE(plot.axes()[1].max, 2.0);
    EXPECT_LE(plot.axes()[1].max, 4.0);
    EXPECT_EQ(plot.readout(30.0).front(), QStringLiteral("– sr⁻¹"));
    EXPECT_EQ(plot.readout(60.0).front(), QStringLiteral("∞ sr⁻¹"));
    EXPECT_FALSE(plot.grab().isNull());
}

TEST(PlotAxisTest, SharesValuesAndTicksBelongTogether) {
    const PlotAxis falling{QStringLiteral("azimuth"), QStringLiteral("°"), 360.0, 0.0};
    EXPECT_EQ(falling.share(90.0), 0.75);
    EXPECT_EQ(falling.value(0.75), 90.0);
    EXPECT_LT(falling.step(), 0.0) << "towards its end";
    PlotAxis decades{QStringLiteral("f"), {}, 0.01, 10.0};
    decades.logarithmic = true;
    EXPECT_NEAR(decades.share(1.0), 2.0 / 3.0, 1e-12);
    EXPECT_EQ(decades.ticks(5).size(), 4u);
    const PlotAxis rows{QStringLiteral("row"), {}, 2.0, 0.0, 1.0, false, true};
    EXPECT_EQ(rows.value(0.99), 0.0);
    EXPECT_EQ(rows.value(0.5), 1.0);
    EXPECT_EQ(rows.value(0.01), 2.0);
    EXPECT_NEAR(rows.share(0.0), 5.0 / 6.0, 1e-12) << "the middle of its row";
    const PlotAxis roughness{QStringLiteral("roughness"), {}};
    EXPECT_EQ(roughness.rounded(0.12345), 0.123);
    EXPECT_EQ(roughness.title(), QStringLiteral("roughness"));
}

} // namespace
} // namespace patina::editor
