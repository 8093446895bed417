// The solver's sums against plain ones over the same hits, and its sets of instructions against
// each other.
#include "core/bake/bounce/BounceGather.h"
#include "core/bake/bounce/Interreflection.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

// A floor of one colour, a two-sided ball of another, a wall with a map and without its colour.
BakeInputs colourfulScene() {
    Mesh wall = planeMesh(1.0, 6);
    for (std::size_t i = 0; i < wall.positions.size(); ++i) {
        const glm::vec3 p = wall.positions[i];
        wall.positions[i] = {p.x, p.z + 1.0f, -1.0f};
        wall.uvs.push_back({0.5f * p.x + 0.5f, 0.5f * p.z + 0.5f});
    }
    wall.normals.assign(wall.positions.size(), {0, 0, 1});
    BakeInputs inputs =
        sceneOf({planeMesh(2.0, 12), sphereMesh(0.5, 24, 12, {0, 0.6, 0}), std::move(wall)});
    inputs.meshes[0].surface.baseColor = {0.9f, 0.1f, 0.3f};
    inputs.meshes[1].surface.baseColor = {0.2f, 0.7f, 0.5f};
    inputs.meshes[1].doubleSided = true;
    auto image = std::make_shared<Image>(8, 8, 3, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t i = 0; i < image->u8().size(); ++i)
        image->u8()[i] = std::uint8_t(i * 89 % 256);
    inputs.meshes[2].surface.baseColorMap.image = image;
    return inputs;
}

// B_k of every coefficient and element, channel by channel in double precision, as
// core/bake/bounce/BounceSolver.h writes the sum.
std::vector<double> plainBounces(const HitSource& hits, const BakeInputs& inputs,
                                 std::span<const float> direct, int bounces) {
    const BounceElements& elements = hits.elements();
    const auto stride = std::size_t(hits.settings().order * hits.settings().order);
    const auto transfer = [&](std::size_t e, std::size_t i) {
        return double(e < elements.fronts()
                          ? direct[e * stride + i]
                          : hits.backTransfer()[(e - elements.fronts()) * stride + i]);
    };
    std::vector<double> bounced(elements.count() * stride * 3, 0.0), next(bounced.size());
    for (int bounce = 0; bounce < bounces; ++bounce) {
        std::fill(next.begin(), next.end(), 0.0);
        std::size_t element = 0;
        for (std::size_t chunk = 0; chunk < hits.chunkCount(); ++chunk) {
            std::vector<CachedHit> scratch;
            for (const CachedHit& hit : hits.hits(chunk, scratch)) {
                const std::size_t to = element;
                element += hit.last() ? 1 : 0;
                if (hit.triangle() == CachedHit::kNoTriangle)
                    continue;
                const BounceElements::Triangle& triangle = elements.triangles()[hit.triangle()];
                const BounceElements::MeshPart& part = elements.meshes()[triangle.mesh];
                const double second = hit.second / 65535.0, third = hit.third / 65535.0;
                const double weights[] = {1.0 - second - third, second, third};
                const BakeSurface& surface = inputs.meshes[triangle.mesh].surface;
                glm::vec3 albedo = DiffuseAlbedo(surface).uniform();
                if (hasAlbedoMap(surface)) {
                    glm::vec2 uv(0.0f);
                    for (std::size_t c = 0; c < 3; ++c)
                        uv += float(weights[c]) *
                              part.mesh->uvs[triangle.corners[c] - part.firstElement];
                    albedo = DiffuseAlbedo(surface).of(AlbedoTexels(surface).at(uv));
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::size_t from = triangle.corners[c] + (hit.back() ? part.toBack : 0u);
                    for (std::size_t i = 0; i < stride; ++i)
                        for (std::size_t channel = 0; channel < 3; ++channel)
                            next[(to * stride + i) * 3 + channel] +=
                                double(albedo[int(channel)]) / hits.settings().samples *
                                weights[c] *
                                (transfer(from, i) + bounced[(from * stride + i) * 3 + channel]);
                }
            }
        }
        EXPECT_EQ(element, elements.count());
        bounced.swap(next);
    }
    return bounced;
}

} // namespace

TEST(BounceSolver, ComesToThePlainSumInEveryBand) {
    const BakeInputs inputs = colourfulScene();
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    std::mt19937 random(3);
    for (int order = 1; order <= 8; ++order) {
        PrtSettings settings;
        settings.order = order;
        settings.transfer = TransferKind::Interreflected;
        settings.bounceSamples = 16;
        const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, settings, {});
        ASSERT_TRUE(hits.ok());
        BounceSolver solver(*hits);
        solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
        const std::size_t fronts = (*hits)->elements().fronts();
        std::vector<float> direct(fronts * std::size_t(order * order));
        for (float& value : direct)
            value = float(random() / 4294967296.0);
        for (const int bounces : {1, 3}) {
            const Result<std::vector<float>> solved = solver.solve(direct, bounces, {});
            ASSERT_TRUE(solved.ok());
            ASSERT_EQ(solved->size(), 3 * direct.size());
            const std::vector<double> plain = plainBounces(**hits, inputs, direct, bounces);
            for (std::size_t i = 0; i < solved->size(); ++i)
                ASSERT_NEAR((*solved)[i], plain[i], 4e-6)
                    << "order " << order << ", " << bounces << " bounces, number " << i;
        }
    }
}

// A machine with narrower instructions bakes the same bytes.
TEST(BounceSolver, EverySetOfInstructionsComesToTheSameBits) {
    const std::span<const detail::BounceGather> all = detail::bounceGathers();
    ASSERT_FALSE(all.empty());
    std::mt19937 random(5);
    const auto uniform = [&] { return float(random() / 4294967296.0); };
    constexpr std::size_t kElements = 40;
    std::vector<float> rows(kElements * 48);
    for (float& value : rows)
        value = uniform();
    std::vector<detail::AlbedoPattern> albedos;
    for (int i = 0; i < 5; ++i)
        albedos.emplace_back(glm::vec3(uniform(), uniform(), uniform()));
    std::vector<detail::GatherHit> hits(33);
    for (detail::GatherHit& hit : hits) {
        for (std::size_t c = 0; c < 3; ++c) {
            hit.corners[c] = std::uint32_t(random() % kElements);
            hit.weights[c] = uniform();
        }
        hit.albedo = &albedos[random() % albedos.size()];
    }
    for (std::size_t count = 1; count <= detail::kMaxGatherCoefficients; ++count) {
        std::vector<std::vector<float>> sums;
        for (const detail::BounceGather& gather : all) {
            std::vector<float>& mine = sums.emplace_back(96, -1.0f);
            gather.colored(hits, rows.data(), count, mine.data());
            std::fill(mine.begin() + std::ptrdiff_t(3 * count), mine.begin() + 48, 0.0f);
            gather.grey(hits, rows.data(), count, mine.data() + 48);
            EXPECT_EQ(mine, sums.front()) << count << " coefficients";
        }
        // What is grey is so in each of three colours.
        std::vector<float> triples(kElements * detail::gatherRow(3 * count)), expected(48);
        for (std::size_t e = 0; e < kElements; ++e)
            for (std::size_t i = 0; i < 3 * count; ++i)
                triples[e * detail::gatherRow(3 * count) + i] =
                    rows[e * detail::gatherRow(count) + i / 3];
        all.front().colored(hits, triples.data(), count, expected.data());
        for (std::size_t i = 0; i < 3 * count; ++i)
            EXPECT_FLOAT_EQ(sums.front()[48 + i], expected[i]) << count << " coefficients";
    }
}
