// A solution per texel.
#include "core/radiosity/document/RadiosityLightMap.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"
#include "core/mesh/UvUnwrap.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

namespace patina::test {

using namespace radiosity;

namespace {

struct SolvedRoom {
    Document document;
    RadiositySettings settings;
    std::unique_ptr<RadiosityScene> scene;
    Solution solution;
};

// The Cornell box as a document, each of its materials a mesh.
SolvedRoom cornell() {
    SolvedRoom room;
    const TraceInputs inputs = cornellBox(kCornellWalls[0], true);
    room.document.materials = inputs.materials;
    for (std::size_t m = 0; m < inputs.materials.size(); ++m)
        room.document.materials[m].id = static_cast<Id>(m + 1);
    for (const TraceMesh& mesh : inputs.meshes) {
        MeshInstance& instance = room.document.meshes.emplace_back();
        instance.id = mesh.id;
        instance.mesh = mesh.mesh;
        instance.material = static_cast<Id>(mesh.material + 1);
    }
    room.settings.maxArea = 0.005;
    room.settings.factors.resolution = 64;
    auto scene = RadiosityScene::make(inputs, room.settings, {});
    EXPECT_TRUE(scene) << scene.error().text();
    room.scene = std::move(*scene);
    const auto solved = room.scene->solve(room.settings, {});
    EXPECT_TRUE(solved) << solved.error().text();
    room.solution = solved->solution;
    return room;
}

RadiosityLightMap lightMap(const SolvedRoom& room, int size, Look look = Look::Smooth) {
    RadiosityMapSettings settings;
    settings.size = size;
    settings.picture.look = look;
    auto map = radiosityLightMap(room.scene->surfaces(), room.solution, settings, {});
    EXPECT_TRUE(map) << map.error().text();
    return std::move(*map);
}

glm::vec3 texelOf(const RadiosityLightMap& map, const glm::vec2& uv) {
    const auto at = [&](float v) {
        return std::clamp(static_cast<int>(v * static_cast<float>(map.side)), 0, map.side - 1);
    };
    const float* texel = map.radiance->f32().data() + 3 * (at(uv.y) * map.side + at(uv.x));
    return {texel[0], texel[1], texel[2]};
}

// The mean of three corners, per triangle.
template <class Vector>
Vector middle(const std::vector<Vector>& of, const std::uint32_t* corner) {
    return (of[corner[0]] + of[corner[1]] + of[corner[2]]) / 3.0f;
}

} // namespace

TEST(RadiosityLightMap, HasTheLightThatVerticesHaveThere) {
    const SolvedRoom room = cornell();
    const RadiosityLightMap map = lightMap(room, 256);
    // The middle of each divided triangle, which lies in one of the undivided ones.
    double worst = 0.0, sum = 0.0;
    std::size_t count = 0;
    for (const LitPart& part : litParts(room.scene->surfaces(), room.solution)) {
        const auto surface = std::ranges::find_if(map.surfaces, [&](const LightMapSurface& s) {
            return s.instance == part.instance && s.back == part.back;
        });
        ASSERT_NE(surface, map.surfaces.end());
        for (std::size_t i = 0; i < part.mesh->indices.size(); i += 3) {
            const std::uint32_t* corner = part.mesh->indices.data() + i;
            const glm::vec3 place = middle(part.mesh->positions, corner),
                            wanted = middle(part.radiosity, corner) / std::numbers::pi_v<float>;
            const Mesh& whole = *surface->mesh;
            for (std::size_t k = 0; k < whole.indices.size(); k += 3) {
                const std::uint32_t* of = whole.indices.data() + k;
                const glm::dvec3 a(whole.positions[of[0]]), x(whole.positions[of[1]]),
                    y(whole.positions[of[2]]), p(place);
                const glm::dvec3 n = glm::cross(x - a, y - a);
                const double b = glm::dot(glm::cross(p - a, y - a), n) / glm::dot(n, n),
                             c = glm::dot(glm::cross(x - a, p - a), n) / glm::dot(n, n);
                if (std::abs(glm::dot(glm::normalize(n), p - a)) > 1e-5 || b < 0.0 || c < 0.0 ||
                    b + c > 1.0)
                    continue;
                const glm::vec2 uv = surface->uvs[of[0]] * static_cast<float>(1.0 - b - c) +
                                     surface->uvs[of[1]] * static_cast<float>(b) +
                                     surface->uvs[of[2]] * static_cast<float>(c);
                const double off = glm::length(texelOf(map, uv) - wanted) / glm::length(wanted);
                worst = std::max(worst, off);
                sum += off;
                ++count;
                break;
            }
        }
    }
    EXPECT_GT(count, 500u);
    EXPECT_LT(sum / static_cast<double>(count), 0.01);
    EXPECT_LT(worst, 0.15); // a texel is no point
}

TEST(RadiosityLightMap, KeepsChartsApartAndFillsWhatIsBetween) {
    const SolvedRoom room = cornell();
    const RadiosityLightMap map = lightMap(room, 128);
    Mesh all;
    for (const LightMapSurface& surface : map.surfaces) {
        ASSERT_EQ(surface.uvs.size(), surface.mesh->vertexCount());
        ASSERT_EQ(surface.mesh->uvs.size(), surface.mesh->vertexCount());
        for (const glm::vec2& uv : surface.uvs)
            ASSERT_TRUE(uv.x >= 0.0f && uv.y >= 0.0f && uv.x <= 1.0f && uv.y <= 1.0f);
        for (const std::uint32_t i : surface.mesh->indices)
            all.indices.push_back(static_cast<std::uint32_t>(all.uvs.size()) + i);
        all.uvs.insert(all.uvs.end(), surface.uvs.begin(), surface.uvs.end());
        all.positions.resize(all.uvs.size());
    }
    EXPECT_FALSE(hasOverlappingUvs(all, 128));
    EXPECT_FALSE(hasOverlappingUvs(all, 1024));
    // Between surfaces there is what they send.
    const auto lit = std::ranges::count(map.lit, std::uint8_t{1});
    EXPECT_GT(lit, 128 * 128 / 4);
    EXPECT_LT(lit, 128 * 128);
    const std::span<const float> values = map.radiance->f32();
    for (std::size_t t = 0; t < map.lit.size(); ++t)
        if (map.lit[t] == 0) {
            EXPECT_GT(values[3 * t], 0.0f) << t;
        }
    // One density: the texels of a surface go with its area.
    double least = 1e300, most = 0.0;
    for (const LightMapSurface& surface : map.surfaces)
        for (std::size_t i = 0; i < surface.mesh->indices.size(); i += 3) {
            const std::uint32_t* v = surface.mesh->indices.data() + i;
            const auto& p = surface.mesh->positions;
            const glm::vec2 x = surface.uvs[v[1]] - surface.uvs[v[0]],
                            y = surface.uvs[v[2]] - surface.uvs[v[0]];
            const double ratio =
                double{std::abs(x.x * y.y - x.y * y.x)} /
                double{glm::length(glm::cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]))};
            least = std::min(least, ratio);
            most = std::max(most, ratio);
        }
    EXPECT_NEAR(least / most, 1.0, 1e-3);
}

TEST(RadiosityLightMap, IsTheSameForAnyNumberOfThreads) {
    const SolvedRoom room = cornell();
    for (const Look look : {Look::Smooth, Look::Gathered}) {
        RadiosityLightMap first;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            RadiosityLightMap map = lightMap(room, 48, look);
            if (threads == 1)
                first = std::move(map);
            else
                EXPECT_TRUE(std::ranges::equal(first.radiance->f32(), map.radiance->f32()));
        }
    }
}

TEST(RadiosityLightMap, GathersWhereTheLookAsksForIt) {
    const SolvedRoom room = cornell();
    const RadiosityLightMap smooth = lightMap(room, 48),
                            gathered = lightMap(room, 48, Look::Gathered);
    double difference = 0.0, sum = 0.0;
    std::size_t buried = 0;
    for (std::size_t t = 0; t < smooth.lit.size(); ++t) {
        buried += smooth.lit[t] != gathered.lit[t] ? 1 : 0;
        for (std::size_t c = 0; c < 3; ++c) {
            difference += gathered.radiance->f32()[3 * t + c] - smooth.radiance->f32()[3 * t + c];
            sum += smooth.radiance->f32()[3 * t + c];
        }
    }
    EXPECT_NE(difference, 0.0);
    EXPECT_LT(std::abs(difference / sum), 0.1) << "the same light";
    EXPECT_GT(buried, 0u) << "the floor below the blocks, which gathers nothing";
}

TEST(RadiosityLightMap, BecomesTheEmissionOfBlackSurfaces) {
    const SolvedRoom room = cornell();
    const RadiosityLightMap map = lightMap(room, 64);
    const LitDocument lit = litDocument(room.document, map, 2.0, 0.7);
    ASSERT_NE(lit.lightMap, nullptr);
    EXPECT_EQ(lit.lightMap->exposure, 2.0);
    EXPECT_EQ(lit.lightMap->automaticExposure, 0.7);
    EXPECT_EQ(lit.document.meshes.size(), map.surfaces.size());
    EXPECT_TRUE(lit.document.lights.empty());
    for (const Material& material : lit.document.materials) {
        EXPECT_EQ(material.baseColor, glm::vec3(0.0f));
        EXPECT_EQ(material.emissive, glm::vec3(1.0f));
        EXPECT_EQ(material.emissiveMap.image, lit.lightMap->shown);
    }
    const std::span<const float> light = map.radiance->f32();
    const std::span<const std::uint8_t> shown = lit.lightMap->shown->u8();
    ASSERT_EQ(light.size(), shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) // by 1/255, encoded
        ASSERT_NEAR(shown[i], 255.0f * shading::srgbEncode(1.0f - std::exp(-2.0f * light[i])),
                    0.51f);
}

TEST(RadiosityLightMap, SaysWhatIsWrongWithItsSize) {
    const SolvedRoom room = cornell();
    RadiosityMapSettings settings;
    for (const int size : {0, -1, kMaxRadiosityMapSize + 1}) {
        settings.size = size;
        const auto map = radiosityLightMap(room.scene->surfaces(), room.solution, settings, {});
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().kind, ErrorKind::Usage);
        EXPECT_THAT(map.error().message, testing::HasSubstr("1 to 4096 texels"));
    }
    settings.size = 4; // charts are many, and each keeps its margin
    const auto small = radiosityLightMap(room.scene->surfaces(), room.solution, settings, {});
    ASSERT_FALSE(small);
    EXPECT_EQ(small.error().kind, ErrorKind::Usage);
    EXPECT_THAT(small.error().message, testing::HasSubstr("use --size "));
    JobControl control;
    control.cancel();
    settings.size = 64;
    const auto cancelled =
        radiosityLightMap(room.scene->surfaces(), room.solution, settings, control.context());
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

} // namespace patina::test
