// Documents whose meshes have their light at the vertices, and the files of them.
#include "core/radiosity/document/LitDocument.h"
#include "core/library/Library.h"
#include "core/radiosity/document/PlyFile.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace patina::test {

using namespace radiosity;

namespace {

// A square of two triangles that faces up and glows, and one across from it that reflects.
Document twoSquares(bool mapped, bool twoSided) {
    Document document;
    for (int i = 0; i < 2; ++i) {
        Mesh mesh;
        mesh.name = i == 0 ? "Lamp" : "Wall";
        const auto y = static_cast<float>(i);
        mesh.positions = {{0, y, 0}, {0, y, 1}, {1, y, 1}, {1, y, 0}};
        mesh.normals.assign(4, {0, i == 0 ? 1.0f : -1.0f, 0});
        mesh.tangents.assign(4, {1, 0, 0, 1});
        mesh.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        if (i == 1)
            mesh.indices = {0, 2, 1, 0, 3, 2};
        Material& material = document.materials.emplace_back();
        material.id = static_cast<Id>(i + 1);
        material.name = mesh.name;
        material.baseColor = i == 0 ? glm::vec3(0.0f) : glm::vec3(0.5f, 0.25f, 0.125f);
        material.emissive = glm::vec3(i == 0 ? 1.0f : 0.0f);
        material.doubleSided = i == 1 && twoSided;
        if (i == 1 && mapped) {
            Image image(2, 1, 3, PixelType::U8, ColorEncoding::Srgb);
            std::ranges::fill(image.u8(), std::uint8_t{255});
            material.baseColorMap.image = std::make_shared<const Image>(std::move(image));
        }
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = static_cast<Id>(i + 1);
        instance.name = mesh.name;
        instance.material = material.id;
        instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    }
    for (Environment& environment : document.environments)
        environment.enabled = false;
    return document;
}

struct Baked {
    std::vector<LitPart> parts;
    LitDocument lit;
};

Baked bake(const Document& document, std::optional<double> exposure) {
    RadiositySettings settings;
    settings.maxArea = 0.01;
    const auto scene = RadiosityScene::make(document, settings, {});
    EXPECT_TRUE(scene) << scene.error().text();
    const auto solved = (*scene)->solve(settings, {});
    EXPECT_TRUE(solved) << solved.error().text();
    Baked baked{litParts((*scene)->surfaces(), solved->solution), {}};
    baked.lit = litDocument(document, baked.parts, exposure);
    return baked;
}

TEST(LitDocument, HasTheLightOfItsSurfacesAtTheirVertices) {
    const Baked baked = bake(twoSquares(false, false), std::nullopt);
    ASSERT_EQ(baked.parts.size(), 2u);
    ASSERT_EQ(baked.lit.document.meshes.size(), 2u);
    const LitVertices& lamp = baked.lit.lit->at(baked.lit.document.meshes[0].id);
    for (const glm::vec3& radiance : lamp.radiance)
        EXPECT_NEAR(radiance.x, 1.0f, 1e-4f) << "glows, and is black";
    const LitVertices& wall = baked.lit.lit->at(baked.lit.document.meshes[1].id);
    const Mesh& mesh = *baked.lit.document.meshes[1].mesh;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        EXPECT_FLOAT_EQ(mesh.positions[v].y, 1.0f);
        EXPECT_FLOAT_EQ(mesh.normals[v].y, -1.0f);
        EXPECT_NEAR(wall.radiance[v].y, 0.5f * wall.radiance[v].x, 1e-5f);
        EXPECT_NEAR(wall.colors[v].x, wall.radiance[v].x, 1e-6f) << "as it is";
        EXPECT_EQ(wall.colors[v].w, 1.0f);
        // Howell B-3: from the middle a square at its own distance is .2394 of what is seen.
        if (glm::length(mesh.positions[v] - glm::vec3(0.5f, 1.0f, 0.5f)) < 0.01f) {
            EXPECT_NEAR(wall.radiance[v].x, 0.5f * 0.239457f, 0.003f);
        }
    }
}

TEST(LitDocument, OfATextureHasTheLightThatAWhiteSurfaceWouldSend) {
    const Baked plain = bake(twoSquares(false, false), 2.0),
                mapped = bake(twoSquares(true, false), 2.0);
    const LitVertices& light = mapped.lit.lit->at(2);
    EXPECT_EQ(mapped.lit.document.materials[1].baseColor, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(plain.lit.document.materials[1].baseColor, glm::vec3(1.0f));
    EXPECT_NE(mapped.lit.document.materials[1].baseColorMap.image, nullptr);
    for (std::size_t v = 0; v < light.colors.size(); ++v) {
        const float irradiance = mapped.parts[1].irradiance[v].x;
        EXPECT_NEAR(light.colors[v].x,
                    1.0f - std::exp(-2.0f * irradiance / std::numbers::pi_v<float>), 1e-5f);
        EXPECT_NEAR(light.colors[v].y, light.colors[v].x, 1e-5f) << "without its colour";
        EXPECT_NEAR(light.radiance[v].y, 0.5f * light.radiance[v].x, 1e-4f) << "with its colour";
    }
}

TEST(LitDocument, KeepsBothSidesOfWhatHasTwo) {
    const Baked baked = bake(twoSquares(false, true), std::nullopt);
    ASSERT_EQ(baked.parts.size(), 3u);
    EXPECT_TRUE(baked.parts[2].back);
    EXPECT_EQ(baked.lit.document.meshes[2].name, "Wall (back)");
    EXPECT_FLOAT_EQ(baked.lit.document.meshes[2].mesh->normals[0].y, 1.0f);
    for (const glm::vec3& radiance : baked.lit.lit->at(3).radiance)
        EXPECT_EQ(radiance, glm::vec3(0.0f)) << "no light comes from above";
    EXPECT_FALSE(baked.lit.document.materials[1].doubleSided) << "each side is a mesh";
    // At one place they would flicker where a program draws both.
    const float radius = twoSquares(false, true).bounds().radius();
    for (std::size_t v = 0; v < 4; ++v) {
        EXPECT_FLOAT_EQ(baked.lit.document.meshes[1].mesh->positions[v].y, 1.0f);
        EXPECT_NEAR(baked.lit.document.meshes[2].mesh->positions[v].y, 1.0f + 1e-3f * radius,
                    1e-6f);
    }
}

TEST(LitDocument, ShowsTheMedianAsMiddleGreyAndNoLampAtAll) {
    const Document document = twoSquares(false, false);
    const std::vector<LitPart> parts = bake(document, std::nullopt).parts;
    const double k = automaticExposure(document, parts);
    int below = 0, above = 0;
    for (const glm::vec3& light : parts[1].radiosity) {
        const float grey = shading::luminance(exposed(light / std::numbers::pi_v<float>, k));
        (grey < 0.18f ? below : above) += 1;
    }
    EXPECT_GT(below, 10);
    EXPECT_GT(above, 10);
    EXPECT_EQ(exposed(glm::vec3(0.0f), k), glm::vec3(0.0f));
    EXPECT_EQ(exposed(glm::vec3(1e30f), k), glm::vec3(1.0f));
}

TEST(LitDocument, AsAPlyHasEveryVertexOnce) {
    const Baked baked = bake(twoSquares(false, false), 1.0);
    const Bytes file = litPly(baked.lit);
    const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    const std::size_t end = text.find("end_header\n") + 11;
    std::size_t vertices = 0, triangles = 0;
    for (const MeshInstance& instance : baked.lit.document.meshes) {
        vertices += instance.mesh->vertexCount();
        triangles += instance.mesh->triangleCount();
    }
    EXPECT_EQ(file.size() - end, vertices * (11 * 4 + 3) + triangles * 13);
    EXPECT_EQ(litPly(bake(twoSquares(false, false), 1.0).lit), file) << "the same bytes";
}

TEST(RadiosityScene, DividesWhereTheLightChanges) {
    // A lamp just above a corner of a large floor.
    Document document = twoSquares(false, false);
    document.meshes[1].placement = glm::scale(glm::mat4(1.0f), glm::vec3(4.0f, 0.5f, 4.0f));
    RadiositySettings settings;
    settings.maxArea = 1.0;
    settings.adaptive = 0.3;
    const auto scene = RadiosityScene::make(document, settings, {});
    ASSERT_TRUE(scene);
    double near = 1.0, far = 0.0; // smallest edge near the lamp's centre, largest at the other end
    const ElementMesh& elements = (*scene)->elements();
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const glm::vec3 centre = (*scene)->scene().toWorld(glm::vec3(elements.centre(e)));
        if (elements.face(e).mesh != 1)
            continue;
        if (centre.x < 1.2f && centre.z < 1.2f)
            near = std::min(near, elements.area(e));
        if (centre.x > 3.0f && centre.z > 3.0f)
            far = std::max(far, elements.area(e));
    }
    EXPECT_LE(near, 1.0 / 16.0);
    EXPECT_NEAR(far, 1.0, 1e-6);
    settings.maxElements = 20;
    const auto limited = RadiosityScene::make(document, settings, {});
    ASSERT_FALSE(limited);
    EXPECT_EQ(limited.error().kind, ErrorKind::Usage);
}

TEST(RadiosityScene, SaysWhatIsMissing) {
    Document document = twoSquares(false, false);
    document.materials[0].emissive = glm::vec3(0.0f);
    RadiositySettings settings;
    const auto scene = RadiosityScene::make(document, settings, {});
    ASSERT_TRUE(scene);
    const auto dark = (*scene)->solve(settings, {});
    ASSERT_FALSE(dark);
    EXPECT_NE(dark.error().message.find("gives light"), std::string::npos);
    document.meshes.clear();
    const auto empty = RadiosityScene::make(document, settings, {});
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().kind, ErrorKind::InputBroken);
}

// Light falls on black surfaces, too: their light maps have it.
TEST(RadiosityScene, LightsBlackSurfaces) {
    Document document = twoSquares(false, false);
    for (Material& material : document.materials)
        material.baseColor = glm::vec3(0.0f);
    RadiositySettings settings;
    for (const Solver solver : {Solver::GaussSeidel, Solver::Progressive, Solver::Hierarchical}) {
        settings.solve.solver = solver;
        const auto scene = RadiosityScene::make(document, settings, {});
        ASSERT_TRUE(scene);
        const auto solved = (*scene)->solve(settings, {});
        ASSERT_TRUE(solved) << solved.error().text();
        EXPECT_TRUE(solved->report.converged);
        EXPECT_EQ(solved->report.residual, 0.0);
        double most = 0.0;
        for (std::uint32_t e = 0; e < (*scene)->elements().size(); ++e)
            most = std::max(most, (*scene)->lit().irradiance(solved->solution, e).y);
        EXPECT_GT(most, 0.0) << name(solver);
    }
}

TEST(RadiosityScene, EndsAtOnceWhenItIsCancelled) {
    const Document document = twoSquares(false, false);
    JobControl control;
    control.cancel();
    const auto scene = RadiosityScene::make(document, {}, control.context());
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().kind, ErrorKind::Cancelled);
    RadiositySettings settings;
    const auto ready = RadiosityScene::make(document, settings, {});
    for (const Solver solver : {Solver::Progressive, Solver::GaussSeidel, Solver::Direct}) {
        settings.solve.solver = solver;
        const auto solved = (*ready)->solve(settings, control.context());
        ASSERT_FALSE(solved);
        EXPECT_EQ(solved.error().kind, ErrorKind::Cancelled);
    }
}

TEST(RadiosityScene, KeepsWhatThereIsWhenItIsStopped) {
    const Document document = twoSquares(false, false);
    RadiositySettings settings;
    settings.solve.solver = Solver::Progressive;
    settings.solve.shotsPerStep = 1;
    settings.solve.residual = 1e-12;
    const auto scene = RadiosityScene::make(document, settings, {});
    ASSERT_TRUE(scene);
    JobControl control;
    const auto solved =
        (*scene)->solve(settings, control.context(), [&](std::uint64_t shots, double, const auto&) {
            if (shots == 5)
                control.stop();
            return true;
        });
    ASSERT_TRUE(solved);
    EXPECT_EQ(solved->report.iterations, 5u);
    EXPECT_FALSE(solved->report.converged);
    EXPECT_EQ(solved->report.history.size(), 5u);
    const auto limited = (*scene)->solve(
        settings, {}, [](std::uint64_t shots, double, const auto&) { return shots < 3; });
    EXPECT_EQ(limited->report.iterations, 3u);
}

} // namespace
} // namespace patina::test
