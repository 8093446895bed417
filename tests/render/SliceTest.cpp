// Frames that are drawn in slices are those that are drawn in one piece.

#include "core/document/ViewChoices.h"
#include "core/document/Views.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/scene/FrameSlicer.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <map>
#include <string>

namespace patina::render {
namespace {

using namespace shading;

constexpr int kWidth = 300, kHeight = 200; // not whole tiles

class Slices : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        m_document = makeScene(makeSphere(160)); // more triangles than a slice has at least
        m_document.materials[0].baseColor = {0.8f, 0.3f, 0.2f};
        m_document.view.background = BackgroundMode::Environment;
        m_document.environment().image = makeEnvironment(32, [](const glm::vec3& d) {
            return glm::vec3(0.6f + 0.4f * d.y, 0.5f, 0.5f - 0.4f * d.x);
        });
        Material glass = m_document.materials[0];
        glass.id = 11;
        glass.alphaMode = AlphaMode::Blend;
        glass.baseColor = {0.2f, 0.4f, 0.9f};
        glass.opacity = 0.4f;
        m_document.materials.push_back(glass);
        MeshInstance plane;
        plane.id = 12;
        plane.name = "plane";
        plane.mesh = makePlane();
        plane.material = glass.id;
        plane.placement = glm::mat4({2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {0, 0.3f, 0, 1});
        m_document.meshes.push_back(plane);
        Light sun;
        sun.id = 13;
        sun.type = LightType::Directional;
        sun.castsShadow = true;
        m_document.lights = {sun};
        m_document.view.camera.pitchDeg = 20.0f;
        setIblOf(m_document);
        begin();
    }

    // As after an edit: no frame of the scene is there.
    void begin() {
        Document other = m_document;
        other.lights[0].intensity += 1.0f;
        sceneRenderer().setDocument(other);
        sceneRenderer().setDocument(m_document);
    }

    FrameSettings settings() const {
        FrameSettings frame;
        frame.width = kWidth;
        frame.height = kHeight;
        frame.samples = 1;
        frame.camera = m_document.view.camera;
        frame.showOverlays = true; // they show depth
        frame.selectedMesh = m_document.meshes[0].id;
        frame.dither = true;
        return frame;
    }
    struct Pictures {
        Image linear, displayed;
        friend bool operator==(const Pictures&, const Pictures&) = default;
    };
    Pictures drawn(const FrameSettings& frame) {
        EXPECT_TRUE(renderer().render(frame, 0).ok());
        return {renderer().readLinear(), renderer().readDisplayed()};
    }
    // Slices of the least size; returns how many there were.
    int prepare(const FrameSettings& frame) {
        for (int slices = 1; slices < 10'000; ++slices) {
            const Result<bool> complete = renderer().prepare(frame, 0.0, -1.0);
            EXPECT_TRUE(complete.ok());
            if (!complete || *complete)
                return slices;
        }
        ADD_FAILURE() << "it does not end";
        return 0;
    }
    static FrameSettings withoutSelection(FrameSettings frame) {
        frame.selectedMesh = 0;
        return frame;
    }
    void addsFrames(bool split);

    Document m_document;
};

TEST_F(Slices, AddUpToTheFrameInOnePiece) {
    std::map<std::string, FrameSettings> frames;
    const auto view = [&](ViewKind kind, ViewMode mode = ViewMode::Raw) {
        FrameSettings frame = settings();
        frame.view.shown = {kind, mode, {}};
        return frame;
    };
    frames["picture"] = settings();
    frames["multisampled"] = settings();
    frames["multisampled"].samples = 4;
    frames["floats"] = settings();
    frames["floats"].floats = true;
    frames["term"] = view(kViewDirectSpecular);
    frames["factor"] = view(kViewNoV);
    frames["contribution"] = view(kViewBaseColor, ViewMode::Contribution);
    frames["range"] = view(kViewLuminance);
    frames["wireframe"] = view(kViewWireframe);
    frames["does not apply"] = view(kViewBentNormal);
    frames["split"] = view(kViewDirectSpecular);
    frames["split"].view.split = ViewSplit{};
    frames["split of numbers"] = view(kViewFinal);
    frames["split of numbers"].view.split =
        ViewSplit{{kViewNoV, ViewMode::Raw, {}}, {0.4f, 0.6f}, 30.0f};
    // Frames of numbers have no radiance of their own, by which the grid is exposed.
    const auto numbers = [](const FrameSettings& frame) {
        const ViewChoice& shown = frame.view.shown;
        return shown.kind == kViewNoV || shown.kind == kViewLuminance ||
               shown.kind == kViewBentNormal;
    };
    for (auto& [name, frame] : frames) {
        frame.showOverlays = !numbers(frame);
        begin();
        const Pictures whole = drawn(frame);
        EXPECT_TRUE(renderer().isCurrent(frame)) << name;
        begin();
        EXPECT_FALSE(renderer().isCurrent(frame)) << name;
        EXPECT_GT(prepare(frame), 20) << name;
        EXPECT_TRUE(renderer().isPrepared(frame)) << name;
        const Pictures sliced = drawn(frame);
        EXPECT_TRUE(sliced.displayed == whole.displayed) << name;
        EXPECT_TRUE(numbers(frame) || sliced.linear == whole.linear) << name;
        EXPECT_TRUE(renderer().isCurrent(frame)) << name;
    }
}

// Where exposure follows the picture, slices measure the same.
TEST_F(Slices, TheEyeSeesTheFrameInOnePiece) {
    for (const ToneMap curve : {ToneMap::Aces, ToneMap::ReinhardPhotographic}) {
        m_document.view.exposureMode = ExposureMode::Automatic;
        m_document.view.toneMap = curve;
        m_document.view.reinhardAutoKey = true;
        m_document.materials[0].metallic = 1.0f; // the term, too, has its colour
        for (const ViewKind kind : {kViewFinal, kViewDirectSpecular}) {
            FrameSettings frame = settings();
            frame.view.shown.kind = kind;
            begin();
            const Pictures whole = drawn(frame);
            const std::optional<Luminance> luminance = renderer().readLuminance();
            ASSERT_TRUE(luminance);
            m_document.materials[0].baseColor = {0.1f, 0.1f, 0.9f}; // seen meanwhile
            begin();
            EXPECT_FALSE(drawn(frame) == whole);
            m_document.materials[0].baseColor = {0.8f, 0.3f, 0.2f};
            begin();
            prepare(frame);
            const Pictures sliced = drawn(frame);
            if (kind == kViewFinal) {
                EXPECT_TRUE(sliced == whole);
                EXPECT_EQ(renderer().readLuminance(), luminance);
            } else {
                EXPECT_TRUE(sliced.linear == whole.linear);
            }
        }
    }
}

// What is drawn over the picture changes while it is prepared, or once it is.
TEST_F(Slices, OverlaysAreThoseOfTheFrameThatIsShown) {
    FrameSettings frame = settings(), selected = settings();
    frame.selectedMesh = 0;
    const Pictures plain = drawn(frame), outlined = drawn(selected);
    ASSERT_FALSE(plain.displayed == outlined.displayed);
    for (int before : {6, 10'000}) {
        begin();
        (void)drawn(frame);
        begin();
        while (before-- > 0 && !renderer().isPrepared(frame))
            ASSERT_TRUE(renderer().prepare(frame, 0.0, -1.0).ok());
        FrameSettings kept = selected;
        kept.keepPicture = true;
        EXPECT_TRUE(drawn(kept).displayed == outlined.displayed) << "at once";
        EXPECT_FALSE(renderer().isPrepared(selected));
        prepare(selected);
        EXPECT_TRUE(drawn(selected) == outlined);
    }
}

// A picture that stays is drawn anew only where it would differ.
TEST_F(Slices, WhatStaysFollowsExposureAndMarks) {
    FrameSettings frame = settings();
    const Pictures whole = drawn(frame);
    FrameSettings kept = frame;
    kept.keepPicture = true;
    kept.camera.yawDeg += 40.0f;
    EXPECT_TRUE(drawn(kept) == whole);
    m_document.view.exposureEv = 2.0f;
    begin();
    const Image bright = drawn(kept).displayed;
    EXPECT_FALSE(bright == whole.displayed);
    EXPECT_TRUE(drawn(frame).displayed == bright);

    FrameSettings split = frame;
    split.view.split = ViewSplit{{kViewNoV, ViewMode::Raw, {}}, {0.5f, 0.5f}, 0.0f};
    const Pictures sides = drawn(split);
    kept = split;
    kept.keepPicture = true;
    kept.selectedMesh = 0;
    EXPECT_TRUE(drawn(kept).displayed == sides.displayed);
    EXPECT_FALSE(renderer().isCurrent(withoutSelection(split)));
    EXPECT_TRUE(renderer().isCurrent(split));
}

TEST_F(Slices, EachFrameThatIsAddedIsTheSame) {
    for (const bool split : {false, true}) {
        begin();
        addsFrames(split);
    }
}

void Slices::addsFrames(bool split) {
    FrameSettings frame = settings();
    frame.accumulate = true;
    if (split)
        frame.view.split = ViewSplit{{kViewDirectSpecular, ViewMode::Raw, {}}, {0.5f, 0.5f}, 0.0f};
    std::vector<Pictures> whole;
    for (int i = 0; i < ViewRenderer::kSteadyFrames; ++i)
        whole.push_back(drawn(frame));
    EXPECT_FALSE(whole.front() == whole.back());
    begin();
    for (int i = 0; i < ViewRenderer::kSteadyFrames; ++i) {
        EXPECT_FALSE(renderer().isCurrent(frame));
        prepare(frame);
        EXPECT_TRUE(drawn(frame) == whole[static_cast<std::size_t>(i)]) << i;
        EXPECT_EQ(renderer().accumulatedFrames(), i + 1);
    }
    EXPECT_TRUE(renderer().isCurrent(frame));
}

TEST_F(Slices, WhatIsSetMeanwhileBeginsAnew) {
    FrameSettings frame = settings();
    frame.accumulate = true;
    const Pictures before = drawn(frame);
    for (int i = 0; i < 6; ++i) // the second frame is added to the first in part
        ASSERT_FALSE(renderer().prepare(frame, 0.0, -1.0).value());
    m_document.materials[0].baseColor = {0.1f, 0.9f, 0.2f};
    begin();
    EXPECT_FALSE(renderer().isPrepared(frame));
    FrameSettings kept = frame;
    kept.keepPicture = true;
    EXPECT_TRUE(drawn(kept) == before) << "until then the picture stays";
    prepare(frame);
    const Pictures after = drawn(frame);
    EXPECT_EQ(renderer().accumulatedFrames(), 1);
    begin();
    EXPECT_TRUE(drawn(frame) == after);
    EXPECT_FALSE(after == before);
}

TEST_F(Slices, AnAbandonedFrameLeavesNothingInTheNext) {
    FrameSettings frame = settings();
    frame.accumulate = true;
    const Pictures first = drawn(frame);
    for (int i = 0; i < 6; ++i)
        ASSERT_FALSE(renderer().prepare(frame, 0.0, -1.0).value());
    EXPECT_TRUE(drawn(frame) == first) << "in one piece: it cannot be continued";
    EXPECT_EQ(renderer().accumulatedFrames(), 1);
}

TEST_F(Slices, LookingAtAPixelLeavesThePicture) {
    for (const ViewKind kind : {kViewFinal, kViewNoV}) {
        FrameSettings frame = settings();
        frame.accumulate = true;
        frame.view.shown.kind = kind;
        begin();
        (void)drawn(frame);
        const Pictures second = drawn(frame);
        ASSERT_TRUE(renderer().inspect(kWidth / 2, kHeight / 2).ok());
        FrameSettings again = frame;
        again.reuseScene = true;
        EXPECT_TRUE(drawn(again) == second);
        EXPECT_EQ(renderer().accumulatedFrames(), 2);
        (void)drawn(frame);
        EXPECT_EQ(renderer().accumulatedFrames(), 3);
    }
}

// --- How frames are cut --------------------------------------------------------------------------

struct Cut {
    int slices = 0;
    double slowestMs = 0.0;
};

// A frame whose pixels and triangles take so long.
Cut cut(FrameSlicer& slicer, int width, int height, double msPerMegapixel, double triangles,
        double msPerMegatriangle, double budgetMs) {
    const auto tiles =
        static_cast<std::size_t>(FrameSlicer::tiles(width) * FrameSlicer::tiles(height));
    std::vector<int> covered(static_cast<std::size_t>(width * height), 0);
    slicer.begin(width, height, std::vector<float>(tiles, 1.0f), -1.0, budgetMs);
    Cut result;
    while (!slicer.done() && result.slices < 100'000) {
        SceneSlice slice = slicer.slice();
        const double first = static_cast<double>(slice.triangles.first);
        const double drawn =
            std::min(static_cast<double>(slice.triangles.count), triangles - first);
        const double pixels = slice.rect.z * slice.rect.w * drawn / triangles;
        const double ms = 1e-6 * (pixels * msPerMegapixel + drawn * msPerMegatriangle);
        slice.shown = static_cast<std::uint64_t>(triangles);
        slice.complete = first + drawn >= triangles;
        if (slice.complete)
            for (int y = 0; y < slice.rect.w; ++y)
                for (int x = 0; x < slice.rect.z; ++x)
                    ++covered[static_cast<std::size_t>((slice.rect.y + y) * width + slice.rect.x +
                                                       x)];
        slicer.took(ms, slice);
        result.slowestMs = std::max(result.slowestMs, ms);
        ++result.slices;
    }
    for (const int times : covered)
        if (times != 1) {
            ADD_FAILURE() << "a pixel is drawn " << times << " times";
            break;
        }
    return result;
}

TEST(FrameSlicer, SlicesTakeWhatTheyMayAndCoverEveryPixelOnce) {
    FrameSlicer slicer;
    const Cut helmet = cut(slicer, 1920, 1080, 350.0, 70'000.0, 200.0, 30.0);
    EXPECT_LT(helmet.slowestMs, 50.0);
    EXPECT_LT(helmet.slices, 80); // 725 ms of pixels
    const Cut again = cut(slicer, 1920, 1080, 350.0, 70'000.0, 200.0, 30.0);
    EXPECT_LE(again.slices, helmet.slices);
    FrameSlicer other;
    const Cut million = cut(other, 1920, 1080, 350.0, 1e6, 300.0, 30.0);
    EXPECT_LT(million.slowestMs, 50.0);
    EXPECT_LT(million.slices, 400);
    EXPECT_EQ(cut(other, 64, 1, 350.0, 1.0, 1.0, 30.0).slices, 1);
}

} // namespace
} // namespace patina::render
