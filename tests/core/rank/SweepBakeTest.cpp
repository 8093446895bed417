// Which transfer a sweep reads.
#include "core/rank/SweepBake.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/edit/Edit.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"
#include "core/rank/SweepPixels.h"

#include <gtest/gtest.h>
#include <utility>

using namespace patina;

namespace {

Document smallBall() {
    Document document;
    Material& material = document.materials.emplace_back();
    material.id = document.takeId();
    MeshInstance& instance = document.meshes.emplace_back();
    instance.id = document.takeId();
    instance.material = material.id;
    Mesh mesh = library::makeSphere(16, 8);
    (void)sanitizeMesh(mesh);
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return document;
}

BakeArtifactPtr transferOf(const Document& document, BakeKind kind) {
    PrtSettings settings;
    settings.order = 3;
    settings.samples = 32;
    TileSink sink;
    const BakeInputs inputs = bakeInputs(document);
    Result<BakeArtifact> baked = kind == BakeKind::PrtVertex
                                     ? bakePrtVertex(inputs, settings, sink, {})
                                     : bakePrtTexel(inputs, settings, sink, {});
    EXPECT_TRUE(baked.ok());
    return baked ? std::make_shared<const BakeArtifact>(std::move(*baked)) : nullptr;
}

} // namespace

TEST(SweepBake, WithoutATransferAQuickOneIsMadeThatAPictureCanBeMadeOf) {
    const Document document = smallBall();
    EXPECT_EQ(attachedSweepBake(document), nullptr);
    const Result<SweepBake> chosen = chooseSweepBake(document, {});
    ASSERT_TRUE(chosen.ok());
    EXPECT_TRUE(chosen->quick);
    EXPECT_EQ(chosen->bake->order, kQuickSweepBands);
    EXPECT_GE(chosen->bake->samplesDone, kQuickSweepRays);
    const Camera camera = frameBounds({}, document.bounds(), 1.0f);
    const Result<SweepPixels> pixels =
        traceSweepPixels(document, chosen->bake.get(), camera, 16, 16, {});
    ASSERT_TRUE(pixels.ok());
    EXPECT_EQ(pixels->order, kQuickSweepBands);
}

TEST(SweepBake, TheDocumentsTransferIsTakenThatOfVerticesFirst) {
    Document document = smallBall();
    const BakeArtifactPtr texel = transferOf(document, BakeKind::PrtTexel);
    ASSERT_TRUE(texel);
    attachBake(document, texel);
    Result<SweepBake> chosen = chooseSweepBake(document, {});
    ASSERT_TRUE(chosen.ok());
    EXPECT_FALSE(chosen->quick);
    EXPECT_EQ(chosen->bake, texel);

    const BakeArtifactPtr vertex = transferOf(document, BakeKind::PrtVertex);
    ASSERT_TRUE(vertex);
    attachBake(document, vertex);
    chosen = chooseSweepBake(document, {});
    ASSERT_TRUE(chosen.ok());
    EXPECT_EQ(chosen->bake, vertex);
}

TEST(SweepBake, ABakeWhoseFileIsMissingIsNotTaken) {
    Document document = smallBall();
    BakeArtifact gone = *transferOf(document, BakeKind::PrtVertex);
    gone.missingFile = "gone.prt";
    attachBake(document, std::make_shared<const BakeArtifact>(std::move(gone)));
    EXPECT_EQ(attachedSweepBake(document), nullptr);
    const BakeArtifactPtr texel = transferOf(document, BakeKind::PrtTexel);
    attachBake(document, texel);
    EXPECT_EQ(attachedSweepBake(document), texel);
}

TEST(SweepBake, ACancelAndASceneWithoutTrianglesAreErrors) {
    JobControl control;
    control.cancel();
    const Result<SweepBake> cancelled = chooseSweepBake(smallBall(), control.context());
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
    const Result<SweepBake> empty = chooseSweepBake(Document(), {});
    ASSERT_FALSE(empty.ok());
    EXPECT_EQ(empty.error().kind, ErrorKind::InputBroken);
}
