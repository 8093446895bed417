#include "core/document/Document.h"
#include "core/base/Utf8.h"
#include "core/document/Source.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/ProjectPath.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

using namespace patina;

namespace {

MeshPtr aTriangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    mesh.indices = {0, 1, 2};
    return std::make_shared<const Mesh>(std::move(mesh));
}

} // namespace

TEST(Document, BoundsAndCountsAreOfWhatIsVisible) {
    Document document;
    EXPECT_TRUE(document.bounds().empty());
    for (int i = 0; i < 3; ++i) {
        MeshInstance& mesh = document.meshes.emplace_back();
        mesh.id = document.takeId();
        mesh.mesh = aTriangle();
        mesh.placement = glm::translate(glm::mat4(1.0f), glm::vec3(10.0f * float(i), 0, -1));
    }
    document.meshes[2].visible = false;
    EXPECT_EQ(document.bounds(), (Bounds{{0, 0, -1}, {11, 2, -1}}));
    EXPECT_EQ(document.triangleCount(), 2u);
}

TEST(Document, ElementsAreFoundById) {
    Document document;
    document.materials.emplace_back().id = 4;
    document.materials.emplace_back().id = 9;
    EXPECT_EQ(document.material(9), &document.materials[1]);
    EXPECT_EQ(document.material(5), nullptr);
    EXPECT_EQ(document.light(4), nullptr);
    EXPECT_EQ(document.mesh(0), nullptr);
}

TEST(Light, TheDirectionFollowsAzimuthAndElevation) {
    Light light;
    const auto direction = [&](float azimuth, float elevation) {
        light.azimuthDeg = azimuth;
        light.elevationDeg = elevation;
        return light.directionToLight();
    };
    EXPECT_LT(glm::distance(direction(0, 0), glm::vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::distance(direction(90, 0), glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(direction(-90, 0), glm::vec3(-1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(direction(33, 90), glm::vec3(0, 1, 0)), 1e-6f);
    // sin 30° = 1/2, cos 30° = √3/2
    EXPECT_LT(glm::distance(direction(180, 30), glm::vec3(0, 0.5f, -0.8660254f)), 1e-6f);
}

TEST(Source, KnowsBuiltinsPathsAndEmbeddedImages) {
    EXPECT_TRUE(isBuiltin("builtin:studio"));
    EXPECT_FALSE(isBuiltin("/builtin:studio"));
    EXPECT_EQ(builtinName("builtin:wood/baseColor"), "wood/baseColor");
    EXPECT_EQ(normalizeSource("builtin:x/../y"), "builtin:x/../y");
    EXPECT_EQ(normalizeSource("/a/../b/./c.png"), "/b/c.png");
    EXPECT_EQ(normalizeSource("c.png"), (std::filesystem::current_path() / "c.png").string());
    EXPECT_EQ(normalizeSource(""), "");
    const auto embedded = parseEmbeddedSource("/a/b#c.glb#embedded:12");
    ASSERT_TRUE(embedded.has_value());
    EXPECT_EQ(embedded->model, "/a/b#c.glb");
    EXPECT_EQ(embedded->index, 12);
    EXPECT_EQ(formatEmbeddedSource(*embedded), "/a/b#c.glb#embedded:12");
    for (const char* text : {"/a.glb", "/a.glb#embedded:", "/a.glb#embedded:x", "#embedded:1x",
                             "/a.glb#embedded:-1", "/a.glb#embedded:99999999999"})
        EXPECT_FALSE(parseEmbeddedSource(text).has_value()) << text;
}

TEST(ProjectPath, IsRelativeReadableAndLosesNothing) {
    const std::filesystem::path project = "/p/q/x.patina";
    EXPECT_EQ(toProjectPath("/p/q/a/b.png", project), "a/b.png");
    EXPECT_EQ(toProjectPath("/p/b.png", project), "../b.png");
    EXPECT_EQ(toProjectPath("/p/q/r\xe9.png", project), "r%E9.png");
    EXPECT_EQ(toProjectPath("/p/q/50%.png", project), "50%25.png");
    EXPECT_EQ(toProjectPath("/p/q/grün.png", project), "grün.png");
    EXPECT_EQ(toProjectPath("/p/q/builtin:x", project), "./builtin:x");
    EXPECT_EQ(toProjectPath("builtin:x", project), "builtin:x");
    EXPECT_EQ(fromProjectPath("./builtin:x", project), "/p/q/builtin:x");
    EXPECT_EQ(fromProjectPath("/abs/olute.png", project), "/abs/olute.png");
    EXPECT_EQ(fromProjectPath("by hand 100%.png", project), "/p/q/by hand 100%.png");
    EXPECT_EQ(fromProjectPath("%e9%", project), "/p/q/\xe9%");
    EXPECT_EQ(fromProjectPath("a%00", project), std::nullopt);
}

// Unicode 15, table 3-7.
TEST(Utf8, AcceptsExactlyTheWellFormedSequences) {
    EXPECT_EQ(makeValidUtf8("aé€🎨"), "aé€🎨");
    const std::string bad = "\xef\xbf\xbd";
    EXPECT_EQ(makeValidUtf8("\xff"), bad);
    using namespace std::string_view_literals;
    EXPECT_EQ(utf8FromUtf16("plain"), std::nullopt);
    EXPECT_EQ(utf8FromUtf16("\xfe\xff\0a\x20\xac\xd8\x3c\xdf\xa8"sv), "a€🎨");
    EXPECT_EQ(utf8FromUtf16("\xff\xfe"
                            "a\0\xac\x20\x3c\xd8\xa8\xdf"sv),
              "a€🎨");
    EXPECT_EQ(utf8FromUtf16("\xfe\xff\xd8\x3c\0b"sv), bad + "b") << "half of a pair";
    EXPECT_EQ(utf8FromUtf16("\xff\xfe"
                            "a"sv),
              bad)
        << "half of a unit";
    EXPECT_EQ(makeValidUtf8("\x80x"), bad + "x");
    EXPECT_EQ(makeValidUtf8("\xc0\x80"), bad + bad);           // overlong
    EXPECT_EQ(makeValidUtf8("\xe0\x9f\xbf"), bad + bad + bad); // overlong
    EXPECT_EQ(makeValidUtf8("\xed\xa0\x80"), bad + bad + bad); // surrogate
    EXPECT_EQ(makeValidUtf8("\xf4\x90\x80\x80").size(), 12u);  // beyond U+10FFFF
    EXPECT_EQ(makeValidUtf8("\xf0\x8f\xbf\xbf").size(), 12u);  // overlong
    EXPECT_EQ(makeValidUtf8("\xe2\x82"), bad + bad);           // cut off
    EXPECT_EQ(utf8SequenceLength("\xf4\x8f\xbf\xbf"), 4u);
    EXPECT_EQ(utf8SequenceLength("\xed\x9f\xbf"), 3u);
    EXPECT_EQ(utf8SequenceLength("\xc2\x80"), 2u);
    EXPECT_EQ(utf8SequenceLength(""), 0u);
}
