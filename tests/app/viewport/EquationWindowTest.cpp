// The picture as its sum in the real window, by real mouse and keys: switches, solo, factors.

#include "app/editor/ViewActions.h"
#include "app/editor/viewport/EquationBar.h"
#include "app/editor/viewport/TermTile.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/viewport/ViewStrip.h"
#include "app/editor/viewport/ViewThumb.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "tests/app/editor/EditorFixture.h"
#include "tests/support/Keys.h"

#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {
namespace {

using namespace shading;
using Terms = std::array<bool, kTermCount>;

class EquationWindowTest : public EditorTest {
  protected:
    void SetUp() override {
        EditorTest::SetUp();
        window->viewport().setFixedSize(355, 300); // software OpenGL pays for each pixel
        session->views.set({});
        window->activateWindow();
        ASSERT_TRUE(QTest::qWaitForWindowActive(window.get(), 30'000));
        window->findChild<ViewStrip*>()->setFolded(true); // its thumbnails take time, too
        window->resize(1440, 640);                        // wide enough for all parts
        bar().close(0);
        bar().setFolded(false);
        window->viewport().setFocus();
    }
    static EquationBar& bar() { return *window->findChild<EquationBar*>(); }
    static ViewState& views() { return session->views; }
    static const Terms& terms() { return views().settings().terms; }
    static TermTile& tile(ViewKind kind) {
        const auto tiles = bar().findChildren<TermTile*>();
        // The row before may not be gone yet.
        return **std::find_if(tiles.rbegin(), tiles.rend(), [&](TermTile* tile) {
            return tile->thumb().kind() == kind && tile->isVisible();
        });
    }
    static QToolButton& button(ViewKind kind, const char* name) {
        return *tile(kind).findChild<QToolButton*>(QLatin1String(name));
    }
    // The first thumbnails wait for their programs, which software OpenGL compiles for long.
    template <class Condition>
    static bool inTime(Condition condition) {
        return QTest::qWaitFor(condition, 240'000);
    }
    static bool showsCrumbs() {
        const auto crumbs = bar().findChildren<QToolButton*>(QStringLiteral("crumb"));
        // Those of the depth before may not be gone yet.
        return std::ranges::any_of(crumbs, [](const auto* crumb) { return crumb->isVisible(); });
    }
    static bool hasPicture(ViewKind kind) {
        return inTime([=] { return !tile(kind).thumb().picture().isNull(); });
    }
    static void click(QWidget& widget) { QTest::mouseClick(&widget, Qt::LeftButton); }
    static void key(int code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(&window->viewport(), static_cast<Qt::Key>(code), modifiers);
    }
    // Of a line of the header; empty where it does not show.
    static std::string lineOf(const char* name) {
        const auto* label = bar().findChild<QLabel*>(QLatin1String(name));
        return label->isVisible() ? label->text().toStdString() : std::string();
    }
    static std::string formula() { return lineOf("formula"); }
    static std::string lacks() { return lineOf("lacks"); }
    static bool rested() {
        // Its size may be about to change.
        const ViewportWidget& viewport = window->viewport();
        return eventually(
            [&] { return viewport.frameSize() == viewport.size() * viewport.devicePixelRatioF(); });
    }
    static void keepPicture(const char* name) {
        const QString pictures = qEnvironmentVariable("PATINA_SCREENSHOTS");
        if (pictures.isEmpty())
            return;
        ASSERT_TRUE(QDir().mkpath(pictures));
        EXPECT_TRUE(window->grab().save(QDir(pictures).filePath(QLatin1String(name))));
    }
    static Id addLight(LightType type) {
        controller().addLight(type);
        return document().lights.back().id;
    }
};

TEST_F(EquationWindowTest, TheSumStandsUnderThePictureInLiveThumbnails) {
    addLight(LightType::Directional);
    for (const ViewKind kind :
         {kViewDiffuseIbl, kViewSpecularIbl, kViewDirectDiffuse, kViewDirectSpecular})
        EXPECT_TRUE(hasPicture(kind)) << viewInfo(kind).id;
    EXPECT_TRUE(hasPicture(kViewFinal));
    EXPECT_TRUE(tile(kViewEmissive).thumb().isEmpty()) << "nothing glows";
    EXPECT_EQ(formula(),
              "Final = Diffuse IBL + Specular IBL + Direct Diffuse + Direct Specular + Emission");
    keepPicture("equation-sum.png");
    click(tile(kViewSpecularIbl).thumb());
    EXPECT_EQ(views().shown(), kViewSpecularIbl);
    click(tile(kViewFinal).thumb());
    EXPECT_EQ(views().shown(), kViewFinal);
    EXPECT_EQ(undoCount(), 1) << "the light";
}

TEST_F(EquationWindowTest, TermsAreTakenOutOfThePictureAndPutBack) {
    ASSERT_TRUE(hasPicture(kViewFinal));
    ASSERT_TRUE(rested());
    const QImage whole = tile(kViewFinal).thumb().picture();
    auto* allOn = bar().findChild<QToolButton*>(QStringLiteral("allTermsOn"));
    EXPECT_FALSE(allOn->isVisible());
    click(button(kViewDiffuseIbl, "on"));
    EXPECT_EQ(terms(), (Terms{false, true, true, true, true}));
    EXPECT_EQ(lacks(), "The picture lacks Diffuse IBL");
    EXPECT_TRUE(inTime([&] { return tile(kViewFinal).thumb().picture() != whole; }))
        << "the sum of what is on";
    keepPicture("equation-muted.png");
    // Folded, the bar still says so.
    click(*bar().findChild<QToolButton*>(QStringLiteral("foldEquation")));
    EXPECT_TRUE(bar().isFolded());
    EXPECT_TRUE(allOn->isVisible());
    EXPECT_EQ(lacks(), "The picture lacks Diffuse IBL");
    click(*allOn);
    EXPECT_EQ(terms(), (Terms{true, true, true, true, true}));
    EXPECT_FALSE(allOn->isVisible());
}

TEST_F(EquationWindowTest, SoloLeavesATermAloneAndReturnsToWhatWas) {
    click(button(kViewEmissive, "on"));
    const Terms before = terms();
    views().show(kViewBaseColor);
    click(button(kViewSpecularIbl, "solo"));
    EXPECT_EQ(terms(), (Terms{false, true, false, false, false}));
    EXPECT_EQ(views().shown(), kViewFinal);
    click(button(kViewDiffuseIbl, "solo"));
    EXPECT_EQ(terms(), (Terms{true, false, false, false, false}));
    EXPECT_TRUE(button(kViewDiffuseIbl, "solo").isChecked());
    EXPECT_FALSE(button(kViewSpecularIbl, "solo").isChecked());
    click(button(kViewDiffuseIbl, "solo"));
    EXPECT_EQ(terms(), before);
}

TEST_F(EquationWindowTest, ATermOpensIntoItsFactorsAndTheirs) {
    QTest::mouseDClick(&tile(kViewDiffuseIbl).thumb(), Qt::LeftButton);
    EXPECT_EQ(bar().opened(), kViewDiffuseIbl);
    EXPECT_EQ(formula(), "= ρ × kD × E(n) / π × AO");
    EXPECT_TRUE(hasPicture(kViewIrradiance));
    EXPECT_EQ(
        tile(kViewIrradiance).findChild<QLabel*>(QStringLiteral("termName"))->text().toStdString(),
        "Irradiance / π");
    click(tile(kViewTransmission).thumb());
    EXPECT_EQ(views().shown(), kViewTransmission);
    keepPicture("equation-diffuse.png");
    QTest::keyClick(&tile(kViewTransmission).thumb(), Qt::Key_Escape);
    EXPECT_EQ(bar().opened(), kViewFinal);

    click(button(kViewSpecularIbl, "open"));
    EXPECT_EQ(formula(), "= Lₚ × (F0·A + B) × gain × AOₛ");
    keepPicture("equation-specular.png");
    click(button(kViewSingleScatterAlbedo, "open"));
    EXPECT_EQ(bar().opened(), kViewSingleScatterAlbedo);
    EXPECT_EQ(formula(), "= F0 × A + B");
    keepPicture("equation-albedo.png");
    controller().setParameter(*findParameter("model.fresnel"), {Scope::Model, 0},
                              static_cast<int>(Fresnel::Dielectric));
    EXPECT_EQ(formula(), "= ( A + B ) × F̄");
    click(*bar().findChild<QToolButton*>(QStringLiteral("crumb")));
    EXPECT_EQ(bar().opened(), kViewFinal);
}

// A view that was a factor becomes the result: its tile is new, its thumbnail is not.
TEST_F(EquationWindowTest, TheResultHasItsPictureAtEveryDepth) {
    click(button(kViewSpecularIbl, "open"));
    ASSERT_TRUE(hasPicture(kViewSingleScatterAlbedo));
    ASSERT_TRUE(hasPicture(kViewSpecularIbl));
    click(button(kViewSingleScatterAlbedo, "open"));
    for (const ViewKind kind : {kViewSingleScatterAlbedo, kViewF0, kViewDfgScale, kViewDfgBias})
        EXPECT_TRUE(hasPicture(kind)) << viewInfo(kind).id;
    keepPicture("equation-result.png");
    bar().close(1);
    for (const ViewKind kind : {kViewSpecularIbl, kViewSingleScatterAlbedo})
        EXPECT_TRUE(hasPicture(kind)) << viewInfo(kind).id;
    bar().close(0);
    EXPECT_TRUE(hasPicture(kViewFinal));
}

TEST_F(EquationWindowTest, WhatThePictureLacksIsSaidAtEveryDepthAndFolded) {
    click(button(kViewDirectDiffuse, "on"));
    const std::string lacking = "The picture lacks Direct Diffuse";
    EXPECT_EQ(lacks(), lacking);
    click(button(kViewSpecularIbl, "open"));
    EXPECT_EQ(lacks(), lacking);
    EXPECT_EQ(formula(), "= Lₚ × (F0·A + B) × gain × AOₛ");
    click(button(kViewSingleScatterAlbedo, "open"));
    EXPECT_EQ(lacks(), lacking);
    keepPicture("equation-lacks.png");
    // Folded it is the sum again, not where the artist went into it.
    auto* fold = bar().findChild<QToolButton*>(QStringLiteral("foldEquation"));
    click(*fold);
    EXPECT_EQ(lacks(), lacking);
    EXPECT_FALSE(showsCrumbs());
    click(*bar().findChild<QToolButton*>(QStringLiteral("allTermsOn")));
    EXPECT_EQ(lacks(), "");
    EXPECT_EQ(formula(),
              "Final = Diffuse IBL + Specular IBL + Direct Diffuse + Direct Specular + Emission");
    click(*fold);
    EXPECT_EQ(formula(), "= F0 × A + B");
    EXPECT_TRUE(eventually(showsCrumbs));
}

TEST_F(EquationWindowTest, FactorsOfDirectLightAreThoseOfALight) {
    EXPECT_FALSE(button(kViewDirectSpecular, "open").isEnabled()) << "no light";
    const Id area = addLight(LightType::Sphere);
    const Id sun = addLight(LightType::Directional);
    click(button(kViewDirectSpecular, "open"));
    EXPECT_EQ(views().settings().light, sun) << "one that has a direction";
    EXPECT_EQ(formula(), "= D × G × F × gain ÷ (4 N·V) × E × shadow");
    EXPECT_TRUE(tile(kViewLightSpecular).isVisible());
    keepPicture("equation-direct.png");
    auto* lights = bar().findChild<QComboBox*>();
    ASSERT_TRUE(lights->isVisible());
    lights->setFocus();
    QTest::keyClick(lights, Qt::Key_Up);
    EXPECT_EQ(views().settings().light, area);
    EXPECT_TRUE(bar().findChild<QLabel*>(QStringLiteral("dim"))->isVisible());
    keepPicture("equation-area.png");
    // Without its lights the term has no factors.
    while (!document().lights.empty())
        controller().removeLight(document().lights.back().id);
    EXPECT_EQ(bar().opened(), kViewFinal);
}

TEST_F(EquationWindowTest, KeysFoldSwitchAndPeek) {
    key(Qt::Key_Equal);
    EXPECT_TRUE(bar().isFolded());
    key(Qt::Key_Equal);
    EXPECT_FALSE(bar().isFolded());
    key(Qt::Key_2, Qt::AltModifier);
    EXPECT_EQ(terms(), (Terms{true, false, true, true, true}));
    key(Qt::Key_5, Qt::AltModifier);
    key(Qt::Key_0, Qt::AltModifier);
    EXPECT_EQ(terms(), (Terms{true, true, true, true, true}));
    test::pressKey(window->viewport(), 100'000, Qt::Key_1, QStringLiteral("1"), Qt::AltModifier);
    EXPECT_FALSE(terms()[0]);
    test::releaseKey(window->viewport(), 100'000 + ViewActions::kPeekMs + 1, Qt::Key_1,
                     QStringLiteral("1"), Qt::AltModifier);
    EXPECT_TRUE(terms()[0]) << "held: only a look";
}

} // namespace
} // namespace patina::editor
