#include "core/cells/Sequence.h"
#include "core/cells/SequenceWriter.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <cmath>
#include <gtest/gtest.h>

namespace patina {
namespace {

TEST(Sequence, TheCameraGoesOnceRoundItsTarget) {
    Document document = startDocument();
    document.view.camera.yawDeg = 100.0f;
    const Camera& start = document.view.camera;
    const float radius = glm::distance(start.position(), start.target);
    for (int i = 0; i < 8; ++i) {
        const Result<Document> shown =
            documentOf(document, sequenceCell(document, Turning::Camera, i, 8));
        ASSERT_TRUE(shown);
        const Camera& camera = shown->view.camera;
        EXPECT_NEAR(glm::distance(camera.position(), start.target), radius, 1e-4f);
        EXPECT_EQ(camera.pitchDeg, start.pitchDeg);
        EXPECT_LE(std::abs(camera.yawDeg), 180.0f);
        // Neighbours are one step apart, the last and the first, too.
        const Camera next =
            documentOf(document, sequenceCell(document, Turning::Camera, (i + 1) % 8, 8))
                ->view.camera;
        EXPECT_NEAR(std::remainder(next.yawDeg - camera.yawDeg, 360.0f), 45.0f, 1e-3f);
    }
    EXPECT_EQ(sequenceCell(document, Turning::Camera, 0, 8), Cell()) << "it begins as it is";
}

TEST(Sequence, TheEnvironmentTurnsAndNothingElse) {
    Document document = startDocument();
    document.environment().rotationDeg = 170.0f;
    const Document shown =
        *documentOf(document, sequenceCell(document, Turning::Environment, 1, 4));
    EXPECT_NEAR(shown.environment().rotationDeg, -100.0f, 1e-3f);
    EXPECT_EQ(shown.view.camera, document.view.camera);
}

TEST(Sequence, FilesAreNumberedFromOne) {
    EXPECT_EQ(sequenceFile("/a/turn.png", 0), "/a/turn-0001.png");
    EXPECT_EQ(sequenceFile("turn.v2.exr", 123), "turn.v2-0124.exr");
}

TEST(Sequence, PicturesAreWrittenUnderTheirNumbers) {
    test::TemporaryFolder folder;
    WorkerClient worker; // PNG needs none
    SequenceOutput output;
    output.file = folder / "turn.png";
    output.width = output.height = 2;
    Image picture(2, 2, 4, PixelType::U8, ColorEncoding::Srgb);
    const auto writer = SequenceWriter::create(worker, output);
    ASSERT_TRUE(writer) << writer.error().text();
    EXPECT_FALSE((*writer)->isLinear());
    for (int i = 1; i <= 2; ++i) {
        const auto written = (*writer)->add(picture, JobContext());
        ASSERT_TRUE(written) << written.error().text();
        EXPECT_EQ(*written, folder / ("turn-000" + std::to_string(i) + ".png"));
        EXPECT_EQ((*writer)->written(), i);
    }
    ASSERT_TRUE((*writer)->finish(JobContext()));
    EXPECT_EQ(folder.files(), (std::vector<std::string>{"turn-0001.png", "turn-0002.png"}));

    output.file = folder / "turn.exr";
    EXPECT_TRUE((*SequenceWriter::create(worker, output))->isLinear());
    output.file = folder / "turn.gif";
    const auto unknown = SequenceWriter::create(worker, output);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
    output.file = folder / "gone" / "turn.png";
    const auto failed = (*SequenceWriter::create(worker, output))->add(picture, JobContext());
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().file.filename(), "turn-0001.png");
}

} // namespace
} // namespace patina
