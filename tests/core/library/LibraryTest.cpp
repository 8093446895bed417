// The library's contract: names, cache, errors, determinism.
#include "core/library/Library.h"

#include "core/job/Parallel.h"
#include "core/library/MaterialRecipes.h"
#include "core/library/Meshes.h"
#include "core/library/Noise.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"
#include "core/math/PortableMath.h"

#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <thread>

using namespace patina;
using testing::HasSubstr;
using testing::IsSupersetOf;

namespace {

std::vector<std::string> names(const std::vector<library::Entry>& entries) {
    std::vector<std::string> result;
    for (const library::Entry& entry : entries) {
        EXPECT_FALSE(entry.title.empty());
        EXPECT_EQ(entry.help.back(), '.') << entry.name;
        result.push_back(entry.name);
    }
    return result;
}

Hash hashSurface(const library::SurfaceMaps& maps) {
    Hasher hasher;
    for (const ImagePtr& image :
         {maps.baseColor, maps.normal, maps.perceptualRoughness, maps.metallic, maps.occlusion})
        if (image)
            hasher.value(hashImage(*image));
    return hasher.finish();
}

} // namespace

// The names are fixed, so that scripts outlive versions.
TEST(Library, KeepsItsNames) {
    EXPECT_THAT(names(library::models()),
                testing::ElementsAre("sphere", "rounded-cube", "torus-knot", "shader-ball",
                                     "cornell-box", "cornell-reference", "wall", "chess", "gallery",
                                     "plane", "sphere-grid", "glass-spheres"));
    EXPECT_THAT(
        names(library::environments()),
        testing::ElementsAre("white", "clear-sky", "overcast", "studio", "sunset", "night"));
    EXPECT_THAT(names(library::materials()),
                IsSupersetOf({"worn-painted-metal", "gold", "brushed-steel", "rough-plastic",
                              "ceramic", "wood", "leather", "concrete"}));
}

TEST(Library, ReturnsTheSamePayloadsTheSecondTime) {
    const auto first = library::model("shader-ball"), second = library::model("shader-ball");
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_EQ(first->size(), second->size());
    for (std::size_t i = 0; i < first->size(); ++i) {
        EXPECT_EQ((*first)[i].mesh, (*second)[i].mesh);
        EXPECT_EQ((*first)[i].material, (*second)[i].material); // maps compare by identity
    }
    EXPECT_EQ(library::environment("studio").value(), library::environment("studio").value());
    EXPECT_EQ(library::material("wood").value(), library::material("wood").value());
    EXPECT_EQ(library::map("wood/normal").value(),
              library::material("wood").value().normalMap.image);
}

TEST(Library, KeepsWhatSomebodyUsesAndNothingElse) {
    ImagePtr sky = library::environment("night").value();
    const std::weak_ptr<const Image> lastSky = sky;
    sky.reset();
    EXPECT_TRUE(lastSky.expired());

    ImagePtr color = library::map("leather/baseColor").value();
    const std::weak_ptr<const Image> normal = library::map("leather/normal").value();
    EXPECT_FALSE(normal.expired()) << "made together, and one is in use";
    color.reset();
    EXPECT_TRUE(normal.expired());

    MeshPtr part = library::model("cornell-box").value().front().mesh;
    const std::weak_ptr<const Mesh> other = library::model("cornell-box").value().back().mesh;
    EXPECT_FALSE(other.expired());
    part.reset();
    EXPECT_TRUE(other.expired());
}

TEST(Library, ServesManyThreadsAtOnce) {
    std::vector<ImagePtr> images(6);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < images.size(); ++i)
        threads.emplace_back([&images, i] {
            images[i] = library::map(i % 2 ? "leather/normal" : "leather/baseColor").value();
        });
    for (std::thread& thread : threads)
        thread.join();
    for (std::size_t i = 2; i < images.size(); ++i)
        EXPECT_EQ(images[i], images[i % 2]);
}

// A sky is painted row by row: a cancel is noticed between rows, and what is unfinished is not kept
// for whoever asks next.
TEST(Library, ASkyThatIsCancelledIsNotMade) {
    JobControl before;
    before.cancel();
    for (const library::Entry& entry : library::environments()) {
        const auto sky = library::environment(entry.name, before.context());
        ASSERT_FALSE(sky.ok()) << entry.name;
        EXPECT_EQ(sky.error().kind, ErrorKind::Cancelled) << entry.name;
    }
    EXPECT_EQ(hashImage(**library::environment("white")),
              hashImage(*library::whiteSky(1.0, JobContext())))
        << "made anew";

    JobControl control;
    std::atomic<int> rows = 0;
    library::SkyCanvas canvas(control.context());
    canvas.forRows(0, library::kSkyHeight, [&](int) {
        control.cancel();
        ++rows;
    });
    EXPECT_LT(rows, library::kSkyHeight);
    EXPECT_EQ(canvas.finish(), nullptr);
}

TEST(Library, SaysWhatThereIsWhenANameIsUnknown) {
    const auto model = library::model("teapot");
    ASSERT_FALSE(model.ok());
    EXPECT_EQ(model.error().kind, ErrorKind::Usage);
    EXPECT_THAT(model.error().message, HasSubstr("'teapot'"));
    for (const library::Entry& entry : library::models())
        EXPECT_THAT(model.error().message, HasSubstr(entry.name));
    const auto sky = library::environment("");
    ASSERT_FALSE(sky.ok());
    for (const library::Entry& entry : library::environments())
        EXPECT_THAT(sky.error().message, HasSubstr(entry.name));
    const auto material = library::material("Gold");
    ASSERT_FALSE(material.ok());
    for (const library::Entry& entry : library::materials())
        EXPECT_THAT(material.error().message, HasSubstr(entry.name));
    EXPECT_THAT(library::map("mud/normal").error().message, HasSubstr("copper-patina"));
    // Gold is metallic all over: it has a number, not a map.
    for (const char* name : {"gold", "gold/", "gold/metallic", "gold/baseColor/x"}) {
        const auto map = library::map(name);
        ASSERT_FALSE(map.ok()) << name;
        EXPECT_EQ(map.error().kind, ErrorKind::Usage);
        EXPECT_THAT(map.error().message, HasSubstr("gold/perceptualRoughness"));
    }
}

TEST(Library, DoesNotDependOnTheThreadCount) {
    const auto hashAll = [](int threads) {
        const ThreadLimit limit(threads);
        std::vector<Hash> hashes;
        for (const library::MaterialRecipe& recipe : library::materialRecipes())
            hashes.push_back(hashSurface(library::finishSurface(recipe.make())));
        for (const library::SkyRecipe& recipe : library::skyRecipes())
            hashes.push_back(hashImage(*recipe.make(recipe.whiteFacingUp, JobContext())));
        for (const library::ModelRecipe& recipe : library::modelRecipes())
            for (const library::ModelPart& part : recipe.make())
                hashes.push_back(hashMesh(*part.mesh));
        return hashes;
    };
    EXPECT_EQ(hashAll(1), hashAll(4));
}

// The building blocks are pinned: other bytes here mean that another compiler or processor makes
// another library.
TEST(Library, MakesTheSameBytesOnEveryMachine) {
    const library::Field noise = library::fbm(64, {3, 5, 4, 0.55f, 7});
    const library::VoronoiCells cells = library::voronoi(64, 5, 4, 0.9f, 3);
    const library::Field lines = library::strokes(64, {9, 10.0f, 40.0f, 0.8f, 20.0f, 90.0f, 5});
    Hasher hasher;
    for (const library::Field* field : {&noise, &cells.edge, &cells.nearest, &lines})
        hasher.array(std::span<const float>(field->row(0), 64 * 64));
    for (int i = 0; i < 1000; ++i) {
        hasher.value(library::sinTurns(i * 0.0137 - 5.0));
        hasher.value(library::powPortable(0.001 + i * 0.01, 2.4));
    }
    EXPECT_EQ(hasher.finish().hex(), "bfe437426ef92f7c8aff164a61e59687");
}

TEST(Library, PortableMathAgreesWithTheStandardLibrary) {
    for (int i = -2000; i <= 2000; ++i) {
        const double x = i * 0.00731;
        EXPECT_NEAR(library::sinRad(x), std::sin(x), 1e-14);
        EXPECT_NEAR(library::cosRad(x), std::cos(x), 1e-14);
        EXPECT_NEAR(library::expPortable(x) / std::exp(x), 1.0, 1e-12);
        const double positive = std::exp2(x);
        EXPECT_NEAR(library::log2Portable(positive), x, 1e-12 * (1.0 + std::fabs(x)));
        EXPECT_NEAR(library::powPortable(positive, 0.45) / std::pow(positive, 0.45), 1.0, 1e-12);
        const double c = i / 2000.0;
        EXPECT_NEAR(library::acosPortable(c), std::acos(c), 4e-8);
    }
    EXPECT_EQ(library::powPortable(0.0, 2.4), 0.0);
    EXPECT_EQ(library::expPortable(-1e6), 0.0);
}

TEST(Library, NoiseTilesAndStaysInRange) {
    constexpr int n = 128;
    const library::Field noise = library::gradientNoise(n, 4, 4, 1);
    // A lattice noise whose cells divide the picture is continuous over the border: the second
    // difference there is as small as anywhere.
    const auto bend = [&](int x, int y) {
        return std::fabs(noise.at(x - 1, y) - 2.0f * noise.at(x, y) + noise.at(x + 1, y));
    };
    float inside = 0.0f, border = 0.0f, largest = 0.0f;
    for (int y = 0; y < n; ++y) {
        for (int x = 1; x + 1 < n; ++x)
            inside = std::max(inside, bend(x, y));
        border = std::max({border, bend(0, y), bend(n - 1, y)});
        for (int x = 0; x < n; ++x)
            largest = std::max(largest, std::fabs(noise.at(x, y)));
    }
    EXPECT_LE(border, inside);
    EXPECT_LE(largest, 1.0f);
    EXPECT_GT(largest, 0.5f);

    const library::VoronoiCells cells = library::voronoi(n, 6, 6, 1.0f, 2);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            ASSERT_GE(cells.edge.at(x, y), 0.0f);
            ASSERT_LT(cells.nearest.at(x, y), 1.5f);
            // Moving by one texel (6 / 128 cells) changes a distance by at most that much.
            ASSERT_LE(std::fabs(cells.nearest.at(x + 1, y) - cells.nearest.at(x, y)), 0.0470f);
        }
}
