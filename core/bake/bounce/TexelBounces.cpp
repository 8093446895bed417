#include "core/bake/bounce/TexelBounces.h"

#include "core/bake/bounce/HitCache.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/domain/GutterFill.h"
#include "core/bake/domain/HemisphereSamples.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/SphericalHarmonics.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace patina {
namespace {

constexpr std::uint32_t kTexelRays = 0x7e8e1b0cu; // other rays than those of the direct pass
constexpr std::uint32_t kNone = 0x7fffffffu;
constexpr std::uint32_t kLast = 1u << 31;   // of its row
constexpr std::size_t kRowsPerChunk = 64;   // traced and gathered together
constexpr std::size_t kMaxCoefficients = 8; // of a group: rows of all texels stay near the cores

// What light bounces between: a row for each texel of every material, then one for the back of each
// texel of two-sided ones.
class TexelRows {
  public:
    struct Part {
        const MaterialTexels* material = nullptr;
        std::uint32_t first = 0;          // row
        std::uint32_t toBack = 0;         // from a row to that of its back; 0: one-sided
        std::vector<std::uint32_t> place; // of every texel of the texture among `texels`, or kNone
        std::vector<glm::vec3> albedo;    // of `texels`; one: of all
    };

    TexelRows(const BakeGeometry& geometry, const TexelLayout& layout)
        : m_layout(layout) {
        const auto side = static_cast<std::size_t>(layout.size);
        for (const MaterialTexels& material : layout.parts) {
            Part& part = m_parts.emplace_back();
            part.material = &material;
            part.first = static_cast<std::uint32_t>(m_fronts);
            const std::vector<std::uint32_t>& texels = material.texels.texels;
            part.place.assign(side * side, kNone);
            for (std::size_t t = 0; t < texels.size(); ++t)
                part.place[texels[t]] = static_cast<std::uint32_t>(t);
            m_starts.push_back({m_fronts, m_parts.size() - 1, false});
            m_fronts += texels.size();
        }
        m_count = m_fronts;
        std::unordered_map<Id, std::size_t> partOf; // by material
        for (std::size_t p = 0; p < m_parts.size(); ++p)
            partOf.try_emplace(m_parts[p].material->material, p);
        m_partOfMesh.reserve(geometry.meshes.size());
        for (const BakeGeometryMesh& mesh : geometry.meshes) {
            const auto found = partOf.find(mesh.material);
            CHECK(found != partOf.end());
            m_partOfMesh.push_back(found->second);
            Part* part = &m_parts[found->second];
            if (part->albedo.empty())
                part->albedo = albedoOf(*part, mesh.surface);
            if (mesh.doubleSided && part->toBack == 0) {
                part->toBack = static_cast<std::uint32_t>(m_count) - part->first;
                m_starts.push_back({m_count, found->second, true});
                m_count += part->material->texels.texels.size();
            }
        }
    }

    [[nodiscard]] std::size_t count() const { return m_count; }
    [[nodiscard]] std::size_t fronts() const { return m_fronts; }
    [[nodiscard]] std::size_t chunkCount(std::size_t rows) const {
        return (rows + kRowsPerChunk - 1) / kRowsPerChunk;
    }
    [[nodiscard]] const std::vector<Part>& parts() const { return m_parts; }

    // A row's part and texel.
    struct Place {
        const Part* part;
        std::size_t texel;
        bool back;
    };
    [[nodiscard]] Place place(std::size_t row) const {
        CHECK_LT(row, m_count);
        // The last that begins at or before it: those without texels begin where the next does.
        const Start& start = *(std::ranges::upper_bound(m_starts, row, {}, &Start::row) - 1);
        return {&m_parts[start.part], row - start.row, start.back};
    }
    // Where the rays of a row start.
    void points(const Place& place, std::vector<BakePoint>& result) const {
        result.clear();
        const MaterialTexels& material = *place.part->material;
        for (std::size_t p = material.texels.firstPoint[place.texel];
             p < material.texels.firstPoint[place.texel + 1]; ++p) {
            const BakePoint& point = m_layout.points[material.firstPoint + p];
            result.push_back(place.back ? BakePoint{point.origin - 2.0f * kRayOffset * point.normal,
                                                    -point.normal}
                                        : point);
        }
    }
    [[nodiscard]] glm::vec3 albedo(const Place& place) const {
        const std::vector<glm::vec3>& all = place.part->albedo;
        return all[all.size() == 1 ? 0 : place.texel];
    }
    // The row that a ray ends in; kNone where it is absorbed.
    [[nodiscard]] std::uint32_t rowOf(const BakeGeometry& geometry,
                                      const ClosestRay& closest) const {
        const BakeGeometryMesh& mesh = geometry.meshes[closest.mesh];
        const Part& part = m_parts[m_partOfMesh[closest.mesh]];
        const bool back = meetsBack(mesh, closest);
        if (back && part.toBack == 0)
            return kNone;
        const std::uint32_t* corner = mesh.mesh->indices.data() + 3 * std::size_t{closest.triangle};
        const glm::vec2 uv = (1.0f - closest.u - closest.v) * mesh.mesh->uvs[corner[0]] +
                             closest.u * mesh.mesh->uvs[corner[1]] +
                             closest.v * mesh.mesh->uvs[corner[2]];
        const auto texel = [side = m_layout.size](float coordinate) {
            const float wrapped = coordinate - std::floor(coordinate);
            return static_cast<std::size_t>(
                std::clamp(static_cast<int>(wrapped * static_cast<float>(side)), 0, side - 1));
        };
        const std::uint32_t place =
            part.place[texel(uv.y) * static_cast<std::size_t>(m_layout.size) + texel(uv.x)];
        return place == kNone ? kNone : part.first + (back ? part.toBack : 0u) + place;
    }

  private:
    [[nodiscard]] std::vector<glm::vec3> albedoOf(const Part& part,
                                                  const BakeSurface& surface) const {
        const DiffuseAlbedo albedo(surface);
        if (!hasAlbedoMap(surface))
            return {albedo.uniform()};
        const AlbedoTexels texels(surface);
        std::vector<glm::vec3> result;
        result.reserve(part.material->texels.texels.size());
        const auto side = static_cast<std::uint32_t>(m_layout.size);
        for (const std::uint32_t texel : part.material->texels.texels) {
            const glm::vec2 centre(static_cast<float>(texel % side) + 0.5f,
                                   static_cast<float>(texel / side) + 0.5f);
            result.push_back(albedo.of(texels.at(centre / static_cast<float>(side))));
        }
        return result;
    }

    // Where the rows of a part's fronts or backs begin.
    struct Start {
        std::size_t row, part;
        bool back;
    };

    const TexelLayout& m_layout;
    std::vector<Part> m_parts;
    std::vector<Start> m_starts; // ascending, without gaps
    std::vector<std::size_t> m_partOfMesh;
    std::size_t m_fronts = 0, m_count = 0;
};

// Finds the rows that the rays of each row end in.
class TexelHits {
  public:
    TexelHits(const TexelRows& rows, const BakeGeometry& geometry, const RayScene& scene,
              const HitSettings& settings)
        : m_rows(rows)
        , m_geometry(geometry)
        , m_scene(scene)
        , m_settings(settings)
        , m_samples(settings.seed ^ kTexelRays, 0, static_cast<std::uint32_t>(settings.samples)) {}

    // Traces once: for the light that comes straight to the backs, and to keep what it may.
    // False when cancelled.
    [[nodiscard]] bool prepare(std::uint64_t budget, std::size_t points, const JobContext& job) {
        const std::uint64_t bytes = std::uint64_t{points} *
                                    static_cast<std::uint64_t>(m_settings.samples) *
                                    sizeof(std::uint32_t);
        const auto stride = static_cast<std::size_t>(m_settings.order * m_settings.order);
        const std::size_t backs = m_rows.count() - m_rows.fronts();
        const bool keeps = bytes <= budget;
        if (!keeps && backs == 0)
            return true;
        m_backTransfer.assign(backs * stride, 0.0f);
        std::vector<std::vector<std::uint32_t>> kept(m_rows.chunkCount(m_rows.count()));
        parallelFor(job, kept.size(), 1, [&](std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> hits;
            for (std::size_t chunk = begin; chunk < end; ++chunk) {
                trace(chunk, hits, m_backTransfer);
                if (keeps)
                    kept[chunk] = std::vector<std::uint32_t>(hits.begin(), hits.end());
            }
            job.addWork(static_cast<double>((end - begin) * kRowsPerChunk) * m_settings.samples,
                        "rays");
        });
        if (keeps)
            m_kept = std::move(kept);
        return !job.cancelled();
    }

    // Those of a chunk of rows, each row's last one marked.
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t chunk,
                                                    std::vector<std::uint32_t>& scratch) const {
        if (!m_kept.empty())
            return m_kept[chunk];
        trace(chunk, scratch, {});
        return scratch;
    }
    [[nodiscard]] const float* backTransfer(std::size_t row) const {
        return m_backTransfer.data() +
               (row - m_rows.fronts()) *
                   static_cast<std::size_t>(m_settings.order * m_settings.order);
    }
    [[nodiscard]] int samples() const { return m_settings.samples; }

  private:
    void trace(std::size_t chunk, std::vector<std::uint32_t>& hits,
               std::span<float> backTransfer) const {
        const FlushDenormals flush;
        const auto stride = static_cast<std::size_t>(m_settings.order * m_settings.order);
        hits.clear();
        std::vector<BakePoint> points;
        std::vector<ClosestRay> rays;
        std::vector<glm::vec3> scratch;
        std::vector<float> basis(stride);
        const std::size_t end = std::min((chunk + 1) * kRowsPerChunk, m_rows.count());
        for (std::size_t row = chunk * kRowsPerChunk; row < end; ++row) {
            m_rows.points(m_rows.place(row), points);
            rays.clear();
            for (std::size_t p = 0; p < points.size(); ++p) {
                const std::uint32_t seed =
                    seedFor(m_settings.seed ^ kTexelRays,
                            static_cast<std::uint32_t>(row * kMaxPointsPerTexel + p));
                const glm::mat3 frame = HemisphereSamples::frame(points[p].normal, seed);
                for (const glm::vec3& local : m_samples.directions(seed, scratch)) {
                    ClosestRay& closest = rays.emplace_back();
                    closest.ray.origin = points[p].origin;
                    closest.ray.direction = frame * local;
                }
            }
            // Points and normals are finite and unit by construction (core/trace/BakeGeometry.h).
            CHECK_EQ(m_scene.intersect(rays), std::size_t{0});
            const std::size_t begin = hits.size();
            float* straight = row >= m_rows.fronts() && !backTransfer.empty()
                                  ? backTransfer.data() + (row - m_rows.fronts()) * stride
                                  : nullptr;
            for (const ClosestRay& closest : rays) {
                if (closest.mesh != ClosestRay::kNothing) {
                    const std::uint32_t met = m_rows.rowOf(m_geometry, closest);
                    if (met != kNone)
                        hits.push_back(met);
                } else if (straight) {
                    evaluateSh(m_settings.order, closest.ray.direction, basis);
                    for (std::size_t i = 0; i < stride; ++i)
                        straight[i] += basis[i] / static_cast<float>(rays.size());
                }
            }
            if (hits.size() == begin)
                hits.push_back(kNone);
            hits.back() |= kLast;
        }
    }

    const TexelRows& m_rows;
    const BakeGeometry& m_geometry;
    const RayScene& m_scene;
    HitSettings m_settings;
    HemisphereSamples m_samples;
    std::vector<std::vector<std::uint32_t>> m_kept; // per chunk; empty: traced when asked for
    std::vector<float> m_backTransfer;              // order² for each back
};

// B of every front texel, 3 order² each, laid out as TexelBake::bounced.
std::optional<std::vector<float>> follow(const TexelRows& rows, const TexelHits& hits,
                                         const PassState& direct, int order, int bounces,
                                         const JobContext& job) {
    const auto stride = static_cast<std::size_t>(order * order);
    std::vector<float> result(rows.fronts() * 3 * stride);
    std::vector<float> straight, leaving, next;
    const std::size_t groups = (stride + kMaxCoefficients - 1) / kMaxCoefficients;
    for (std::size_t group = 0; group < groups; ++group) {
        const std::size_t first = stride * group / groups,
                          count = stride * (group + 1) / groups - first, width = 3 * count;

        // What comes straight from the environment, and leaves again.
        straight.resize(rows.count() * count);
        leaving.resize(rows.count() * width);
        next.resize(leaving.size());
        const auto leave = [&](std::size_t row, const glm::vec3& albedo, const float* bounced,
                               float* to) {
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    to[3 * i + c] =
                        albedo[static_cast<int>(c)] *
                        (straight[row * count + i] + (bounced ? bounced[3 * i + c] : 0.0f));
        };
        parallelFor(job, rows.count(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const TexelRows::Place place = rows.place(row);
                const MaterialTexels& material = *place.part->material;
                const std::size_t from = material.texels.firstPoint[place.texel],
                                  to = material.texels.firstPoint[place.texel + 1];
                for (std::size_t i = 0; i < count; ++i) {
                    float& value = straight[row * count + i];
                    if (place.back) {
                        value = hits.backTransfer(row)[first + i];
                        continue;
                    }
                    value = 0.0f;
                    for (std::size_t p = from; p < to; ++p)
                        value += direct.values[(material.firstPoint + p) * stride + first + i];
                    value /= static_cast<float>(to - from);
                }
                leave(row, rows.albedo(place), nullptr, leaving.data() + row * width);
            }
        });

        for (int bounce = 1; bounce <= bounces; ++bounce) {
            const bool last = bounce == bounces; // which lights no other
            const std::size_t asked = last ? rows.fronts() : rows.count();
            parallelFor(job, rows.chunkCount(asked), 4, [&](std::size_t begin, std::size_t end) {
                std::vector<std::uint32_t> scratch;
                for (std::size_t chunk = begin; chunk < end; ++chunk) {
                    const std::uint32_t* hit = hits.of(chunk, scratch).data();
                    const std::size_t stop = std::min((chunk + 1) * kRowsPerChunk, asked);
                    for (std::size_t row = chunk * kRowsPerChunk; row < stop; ++row) {
                        float sum[3 * kMaxCoefficients] = {};
                        for (bool ended = false; !ended; ++hit) {
                            ended = (*hit & kLast) != 0;
                            const std::uint32_t met = *hit & ~kLast;
                            if (met == kNone)
                                continue;
                            const float* from = leaving.data() + std::size_t{met} * width;
                            for (std::size_t i = 0; i < width; ++i)
                                sum[i] += from[i];
                        }
                        const TexelRows::Place place = rows.place(row);
                        const std::vector<std::uint32_t>& points =
                            place.part->material->texels.firstPoint;
                        const float scale =
                            1.0f /
                            static_cast<float>((points[place.texel + 1] - points[place.texel]) *
                                               static_cast<std::uint32_t>(hits.samples()));
                        for (float& value : sum)
                            value *= scale;
                        if (last)
                            std::copy_n(sum, width, result.data() + (row * stride + first) * 3);
                        else
                            leave(row, rows.albedo(place), sum, next.data() + row * width);
                    }
                }
            });
            if (job.cancelled())
                return std::nullopt;
            leaving.swap(next);
        }
    }
    return result;
}

} // namespace

std::optional<Error> addTexelInterreflection(BakeArtifact& artifact, const BakeInputs& inputs,
                                             const BakeGeometry& geometry, const RayScene& scene,
                                             const TexelLayout& layout, const PassState& direct,
                                             const PrtSettings& settings, const JobContext& job) {
    const Result<HitSettings> hitSetting = hitSettings(settings);
    if (!hitSetting)
        return hitSetting.error();
    const TexelRows rows(geometry, layout);
    if (rows.count() >= kNone)
        return Error{ErrorKind::Usage,
                     "There are too many texels to follow bounces; bake smaller textures.",
                     {},
                     {}};
    job.setActivity("tracing bounces");
    TexelHits hits(rows, geometry, scene, *hitSetting);
    const std::size_t most = layout.points.size() * (rows.count() > rows.fronts() ? 2 : 1);
    if (!hits.prepare(settings.hitBudget, most, job))
        return bakeCancelled();
    job.setActivity("following bounces");
    const std::optional<std::vector<float>> bounced =
        follow(rows, hits, direct, settings.order, settings.bounces, job);
    if (!bounced)
        return bakeCancelled();

    const auto side = static_cast<std::size_t>(layout.size);
    const auto width = static_cast<std::size_t>(3 * settings.order * settings.order);
    const std::vector<float> dark(width, 0.0f);
    std::unordered_map<Id, std::vector<TexelBake>::iterator> bakes; // by material
    for (auto bake = artifact.texels.begin(); bake != artifact.texels.end(); ++bake)
        bakes.try_emplace(bake->material, bake);
    for (const TexelRows::Part& part : rows.parts()) {
        const auto found = bakes.find(part.material->material);
        CHECK(found != bakes.end());
        const auto bake = found->second;
        const std::vector<std::uint32_t>& texels = part.material->texels.texels;
        bake->bounced.assign(side * side * width, 0.0f);
        std::vector<std::uint8_t> known(side * side, 0);
        for (std::size_t t = 0; t < texels.size(); ++t) {
            std::copy_n(bounced->begin() + static_cast<std::ptrdiff_t>((part.first + t) * width),
                        width,
                        bake->bounced.begin() + static_cast<std::ptrdiff_t>(texels[t] * width));
            known[texels[t]] = 1;
        }
        fillGutters(bake->bounced, std::move(known), layout.size, dark);
    }
    artifact.albedo = hashBakeAlbedo(inputs);
    artifact.transfer = TransferKind::Interreflected;
    artifact.bounces = settings.bounces;
    return std::nullopt;
}

} // namespace patina
