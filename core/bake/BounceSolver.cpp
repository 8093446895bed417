#include "core/bake/BounceSolver.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

// The maps of a mesh in the order a lookup wants them.
struct BounceSolver::MappedSurface {
    BakeSurface surface; // whose maps they are
    AlbedoTexels texels;
};

namespace {

Error cancelledError() {
    return {ErrorKind::Cancelled, "Following the bounces was cancelled.", {}, {}};
}

// Numbers of an element's row: K coefficients of red, of green, of blue; a single coefficient is
// padded to 16 bytes.
template <std::size_t K>
constexpr std::size_t kRow = K == 1 ? 4 : 3 * K;

struct Weights {
    float corner[3];
};

Weights weightsOf(const CachedHit& hit) {
    const float second = static_cast<float>(hit.second) * (1.0f / 65535.0f);
    const float third = static_cast<float>(hit.third) * (1.0f / 65535.0f);
    return {{1.0f - second - third, second, third}};
}

// One bounce for the elements of a chunk. `albedoOf(hit index, mesh)` is ρ.
template <std::size_t K, class AlbedoOf>
void gatherChunk(std::span<const CachedHit> hits, const BounceElements& elements,
                 const AlbedoOf& albedoOf, float scale, const float* from, float* to) {
    constexpr std::size_t row = kRow<K>;
    float sum[row] = {};
    for (std::size_t h = 0; h < hits.size(); ++h) {
        const CachedHit hit = hits[h];
        if (hit.triangle() != CachedHit::kNoTriangle) {
            const BounceElements::Triangle& triangle = elements.triangles()[hit.triangle()];
            const std::uint32_t side = hit.back() ? elements.meshes()[triangle.mesh].toBack : 0u;
            const Weights w = weightsOf(hit);
            const glm::vec3 albedo = albedoOf(h, triangle.mesh);
            const float* a = from + std::size_t{triangle.corners[0] + side} * row;
            const float* b = from + std::size_t{triangle.corners[1] + side} * row;
            const float* c = from + std::size_t{triangle.corners[2] + side} * row;
            if constexpr (K == 1) {
                for (std::size_t i = 0; i < 3; ++i)
                    sum[i] += albedo[static_cast<int>(i)] *
                              (w.corner[0] * a[i] + w.corner[1] * b[i] + w.corner[2] * c[i]);
            } else {
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const float rho = albedo[static_cast<int>(channel)];
                    const float wa = rho * w.corner[0], wb = rho * w.corner[1],
                                wc = rho * w.corner[2];
                    for (std::size_t i = channel * K; i < (channel + 1) * K; ++i)
                        sum[i] += wa * a[i] + wb * b[i] + wc * c[i];
                }
            }
        }
        if (!hit.last())
            continue;
        for (std::size_t i = 0; i < row; ++i) {
            to[i] = scale * sum[i];
            sum[i] = 0.0f;
        }
        to += row;
    }
}

} // namespace

BounceSolver::BounceSolver(HitSourcePtr hits)
    : m_hits(std::move(hits))
    , m_albedos(m_hits->elements().meshes().size(), DiffuseAlbedo(BakeSurface{}))
    , m_mapped(m_hits->elements().meshes().size()) {}

BounceSolver::~BounceSolver() = default;

void BounceSolver::setSurfaces(std::span<const BakeSurface> surfaces, const JobContext& job) {
    CHECK_EQ(surfaces.size(), m_albedos.size());
    bool changed = false;
    m_anyMapped = false;
    for (std::size_t m = 0; m < surfaces.size(); ++m) {
        m_albedos[m] = DiffuseAlbedo(surfaces[m]);
        if (!hasAlbedoMap(surfaces[m])) {
            changed |= m_mapped[m] != nullptr;
            m_mapped[m] = nullptr;
            continue;
        }
        m_anyMapped = true;
        if (m_mapped[m] && sameAlbedoMaps(m_mapped[m]->surface, surfaces[m]))
            continue;
        m_mapped[m] =
            std::make_unique<MappedSurface>(MappedSurface{surfaces[m], AlbedoTexels(surfaces[m])});
        changed = true;
    }
    if (!changed || !m_hits->kept())
        return;
    m_texels.clear();
    if (!m_anyMapped)
        return;
    m_texels.resize(m_hits->chunkCount());
    parallelFor(job, m_texels.size(), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<CachedHit> scratch;
        for (std::size_t chunk = begin; chunk < end; ++chunk)
            lookUp(m_hits->hits(chunk, scratch), m_texels[chunk]);
    });
    if (job.cancelled()) // incomplete: to be done again
        for (std::unique_ptr<MappedSurface>& mapped : m_mapped)
            mapped = nullptr;
}

// Where nothing is mapped the texel is white.
void BounceSolver::lookUp(std::span<const CachedHit> hits,
                          std::vector<std::uint32_t>& texels) const {
    const BounceElements& elements = m_hits->elements();
    texels.assign(hits.size(), 0xffffffffu);
    for (std::size_t h = 0; h < hits.size(); ++h) {
        if (hits[h].triangle() == CachedHit::kNoTriangle)
            continue;
        const BounceElements::Triangle& triangle = elements.triangles()[hits[h].triangle()];
        const MappedSurface* mapped = m_mapped[triangle.mesh].get();
        if (!mapped)
            continue;
        const BounceElements::MeshPart& part = elements.meshes()[triangle.mesh];
        const Weights w = weightsOf(hits[h]);
        glm::vec2 uv(0.0f);
        for (std::size_t i = 0; i < 3; ++i)
            uv += w.corner[i] * part.mesh->uvs[triangle.corners[i] - part.firstElement];
        texels[h] = mapped->texels.at(uv);
    }
}

std::span<const std::uint32_t> BounceSolver::texels(std::size_t chunk,
                                                    std::span<const CachedHit> hits,
                                                    std::vector<std::uint32_t>& scratch) const {
    if (m_hits->kept())
        return m_texels[chunk];
    lookUp(hits, scratch);
    return scratch;
}

template <std::size_t K>
bool BounceSolver::gather(const std::vector<float>& from, std::vector<float>& bounced,
                          const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    std::vector<glm::vec3> uniform;
    for (const DiffuseAlbedo& albedo : m_albedos)
        uniform.push_back(albedo.uniform());
    const float scale = 1.0f / static_cast<float>(m_hits->settings().samples);
    parallelFor(job, m_hits->chunkCount(), 4, [&](std::size_t begin, std::size_t end) {
        std::vector<CachedHit> scratch;
        std::vector<std::uint32_t> texelScratch;
        for (std::size_t chunk = begin; chunk < end; ++chunk) {
            const std::span<const CachedHit> hits = m_hits->hits(chunk, scratch);
            float* to = bounced.data() + chunk * kHitChunk * kRow<K>;
            if (!m_anyMapped) {
                gatherChunk<K>(
                    hits, elements, [&](std::size_t, std::uint32_t mesh) { return uniform[mesh]; },
                    scale, from.data(), to);
                continue;
            }
            const std::span<const std::uint32_t> colors = texels(chunk, hits, texelScratch);
            gatherChunk<K>(
                hits, elements,
                [&](std::size_t h, std::uint32_t mesh) { return m_albedos[mesh].of(colors[h]); },
                scale, from.data(), to);
        }
    });
    return !job.cancelled();
}

Result<std::vector<glm::vec3>> BounceSolver::solveLight(std::span<const glm::vec3> direct,
                                                        std::span<const glm::vec3> surroundings,
                                                        int bounces, const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    CHECK_EQ(direct.size(), elements.fronts());
    constexpr std::size_t row = kRow<1>;
    std::vector<float> straight(elements.count() * row, 0.0f);
    for (std::size_t e = 0; e < direct.size(); ++e)
        for (int c = 0; c < 3; ++c)
            straight[e * row + static_cast<std::size_t>(c)] = direct[e][c];
    const std::size_t stride =
        std::min(surroundings.size(),
                 static_cast<std::size_t>(m_hits->settings().order * m_hits->settings().order));
    const std::size_t backStride =
        static_cast<std::size_t>(m_hits->settings().order * m_hits->settings().order);
    for (std::size_t e = elements.fronts(); e < elements.count(); ++e) {
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < stride; ++i)
            sum +=
                m_hits->backTransfer()[(e - elements.fronts()) * backStride + i] * surroundings[i];
        for (int c = 0; c < 3; ++c)
            straight[e * row + static_cast<std::size_t>(c)] = sum[c];
    }
    std::vector<float> leaving = straight, bounced(straight.size());
    for (int bounce = 0; bounce < bounces; ++bounce) {
        if (!gather<1>(leaving, bounced, job))
            return cancelledError();
        for (std::size_t i = 0; i < leaving.size(); ++i)
            leaving[i] = straight[i] + bounced[i];
    }
    std::vector<glm::vec3> result(elements.fronts());
    for (std::size_t e = 0; e < result.size(); ++e)
        result[e] = {bounced[e * row], bounced[e * row + 1], bounced[e * row + 2]};
    return result;
}

Result<std::vector<float>> BounceSolver::solve(std::span<const float> direct, int bounces,
                                               const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    const int order = m_hits->settings().order;
    const auto stride = static_cast<std::size_t>(order * order);
    CHECK_EQ(direct.size(), elements.fronts() * stride);
    std::vector<float> result(elements.fronts() * 3 * stride);

    // A few coefficients at a time: their rows of all elements fit the cache, and what is needed
    // beside the result is small.
    bool complete = true;
    const auto solveGroup = [&]<std::size_t K>(std::integral_constant<std::size_t, K>,
                                               std::size_t first) {
        constexpr std::size_t row = kRow<K>;
        const auto transfer = [&](std::size_t e, std::size_t i) {
            return e < elements.fronts()
                       ? direct[e * stride + i]
                       : m_hits->backTransfer()[(e - elements.fronts()) * stride + i];
        };
        std::vector<float> leaving(elements.count() * row, 0.0f), bounced(leaving.size());
        const auto addDirect = [&] {
            parallelFor(job, elements.count(), 4096, [&](std::size_t begin, std::size_t end) {
                for (std::size_t e = begin; e < end; ++e)
                    for (std::size_t i = 0; i < K; ++i) {
                        const float t = transfer(e, first + i);
                        for (std::size_t channel = 0; channel < 3; ++channel)
                            leaving[e * row + channel * K + i] =
                                t + bounced[e * row + channel * K + i];
                    }
            });
        };
        addDirect();
        for (int bounce = 0; bounce < bounces; ++bounce) {
            if (bounce > 0)
                addDirect();
            if (!gather<K>(leaving, bounced, job))
                return false;
        }
        for (std::size_t e = 0; e < elements.fronts(); ++e)
            for (std::size_t i = 0; i < K; ++i)
                for (std::size_t channel = 0; channel < 3; ++channel)
                    result[(e * stride + first + i) * 3 + channel] =
                        bounced[e * row + channel * K + i];
        return true;
    };
    for (std::size_t first = 0; first < stride && complete;) {
        const std::size_t left = stride - first;
        if (left >= 8) {
            complete = solveGroup(std::integral_constant<std::size_t, 8>{}, first);
            first += 8;
        } else if (left >= 4) {
            complete = solveGroup(std::integral_constant<std::size_t, 4>{}, first);
            first += 4;
        } else {
            complete = solveGroup(std::integral_constant<std::size_t, 1>{}, first);
            first += 1;
        }
    }
    if (!complete)
        return cancelledError();
    return result;
}

std::size_t BounceSolver::memoryBytes() const {
    std::size_t bytes = m_hits->elements().memoryBytes();
    for (const std::vector<std::uint32_t>& texels : m_texels)
        bytes += texels.capacity() * sizeof(std::uint32_t);
    return bytes;
}

} // namespace patina
