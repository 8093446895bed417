#include "core/bake/bounce/BounceSolver.h"

#include "core/bake/bounce/BounceGather.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

// What leaves every element: at once, after the last bounce, and after the next.
struct BounceSolver::Rows {
    std::vector<float> straight, leaving, next;
};

// The maps of a mesh in the order a lookup wants them.
struct BounceSolver::MappedSurface {
    BakeSurface surface; // whose maps they are
    AlbedoTexels texels;
};

namespace {

Error bouncesCancelled() {
    return {ErrorKind::Cancelled, "Following the bounces was cancelled.", {}, {}};
}

struct Weights {
    float corner[3];
};

Weights weightsOf(const CachedHit& hit) {
    const float second = static_cast<float>(hit.second) * (1.0f / 65535.0f);
    const float third = static_cast<float>(hit.third) * (1.0f / 65535.0f);
    return {{1.0f - second - third, second, third}};
}

} // namespace

BounceSolver::BounceSolver(HitSourcePtr hits)
    : m_hits(std::move(hits))
    , m_albedos(m_hits->elements().meshes().size(), DiffuseAlbedo(BakeSurface{}))
    , m_mapped(m_hits->elements().meshes().size()) {}

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
        m_mapped[m] = std::make_shared<const MappedSurface>(
            MappedSurface{surfaces[m], AlbedoTexels(surfaces[m])});
        changed = true;
    }
    if (!changed || !m_hits->kept())
        return;
    m_texels = nullptr;
    if (!m_anyMapped)
        return;
    const auto all = std::make_shared<Texels>(m_hits->chunkCount());
    parallelFor(job, all->size(), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<CachedHit> scratch;
        for (std::size_t chunk = begin; chunk < end; ++chunk)
            lookUp(m_hits->hits(chunk, scratch), (*all)[chunk]);
    });
    m_texels = all;
    if (job.cancelled()) // incomplete: to be done again
        for (std::shared_ptr<const MappedSurface>& mapped : m_mapped)
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
        return (*m_texels)[chunk];
    lookUp(hits, scratch);
    return scratch;
}

template <class Gather>
bool BounceSolver::forEachElement(std::size_t elements, const Gather& gather,
                                  const JobContext& job) const {
    const BounceElements& all = m_hits->elements();
    std::vector<detail::AlbedoPattern> uniform;
    for (const DiffuseAlbedo& albedo : m_albedos)
        uniform.emplace_back(albedo.uniform());
    parallelFor(
        job, (elements + kHitChunk - 1) / kHitChunk, 4, [&](std::size_t begin, std::size_t end) {
            std::vector<CachedHit> scratch;
            std::vector<std::uint32_t> texelScratch;
            std::vector<detail::GatherHit> found(
                static_cast<std::size_t>(m_hits->settings().samples));
            std::vector<detail::AlbedoPattern> mapped(m_anyMapped ? found.size() : 0);
            for (std::size_t chunk = begin; chunk < end; ++chunk) {
                const std::span<const CachedHit> hits = m_hits->hits(chunk, scratch);
                std::span<const std::uint32_t> colors;
                if (m_anyMapped)
                    colors = texels(chunk, hits, texelScratch);
                const std::size_t last = std::min((chunk + 1) * kHitChunk, elements);
                std::size_t h = 0;
                for (std::size_t element = chunk * kHitChunk; element < last; ++element) {
                    std::size_t count = 0;
                    for (bool ended = false; !ended; ++h) {
                        const CachedHit& hit = hits[h];
                        ended = hit.last();
                        if (hit.triangle() == CachedHit::kNoTriangle)
                            continue;
                        const BounceElements::Triangle& triangle = all.triangles()[hit.triangle()];
                        const std::uint32_t side =
                            hit.back() ? all.meshes()[triangle.mesh].toBack : 0u;
                        const Weights w = weightsOf(hit);
                        detail::GatherHit& to = found[count];
                        for (std::size_t i = 0; i < 3; ++i) {
                            to.corners[i] = triangle.corners[i] + side;
                            to.weights[i] = w.corner[i];
                        }
                        to.albedo = &uniform[triangle.mesh];
                        if (m_anyMapped) {
                            mapped[count] =
                                detail::AlbedoPattern(m_albedos[triangle.mesh].of(colors[h]));
                            to.albedo = &mapped[count];
                        }
                        ++count;
                    }
                    gather(element, std::span(found).first(count));
                }
            }
        });
    return !job.cancelled();
}

void BounceSolver::setOpen(std::span<const float> open) {
    const BounceElements& elements = m_hits->elements();
    CHECK_EQ(open.size(), elements.fronts());
    // Few hits that stand for much more than they saw would be noise.
    constexpr float kMostGain = 2.0f;
    const auto samples = static_cast<float>(m_hits->settings().samples);
    auto shares = std::make_shared<std::vector<float>>(elements.count(), 1.0f / samples);
    for (std::size_t e = 0; e < open.size(); ++e) {
        const float met = samples - static_cast<float>(m_hits->missed()[e]);
        if (met > 0.0f)
            (*shares)[e] =
                std::min((1.0f - std::clamp(open[e], 0.0f, 1.0f)) / met, kMostGain / samples);
    }
    m_shares = std::move(shares);
}

float BounceSolver::shareOf(std::size_t element) const {
    return m_shares ? (*m_shares)[element] : 1.0f / static_cast<float>(m_hits->settings().samples);
}

Result<std::vector<glm::vec3>> BounceSolver::solveLight(std::span<const glm::vec3> direct,
                                                        std::span<const glm::vec3> environment,
                                                        int bounces, const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    CHECK_EQ(direct.size(), elements.fronts());
    const detail::BounceGather& kernel = detail::bounceGathers().front();
    constexpr std::size_t row = detail::gatherRow(3);
    std::vector<float> straight(elements.count() * row, 0.0f);
    for (std::size_t e = 0; e < direct.size(); ++e)
        for (int c = 0; c < 3; ++c)
            straight[e * row + static_cast<std::size_t>(c)] = direct[e][c];
    const std::size_t backStride =
        static_cast<std::size_t>(m_hits->settings().order * m_hits->settings().order);
    const std::size_t stride = std::min(environment.size(), backStride);
    for (std::size_t e = elements.fronts(); e < elements.count(); ++e) {
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < stride; ++i)
            sum +=
                m_hits->backTransfer()[(e - elements.fronts()) * backStride + i] * environment[i];
        for (int c = 0; c < 3; ++c)
            straight[e * row + static_cast<std::size_t>(c)] = sum[c];
    }
    std::vector<float> leaving = straight, next(straight.size());
    std::vector<glm::vec3> result(elements.fronts());
    for (int bounce = 1; bounce <= bounces; ++bounce) {
        const bool last = bounce == bounces; // which lights no other
        const auto gather = [&](std::size_t e, std::span<const detail::GatherHit> hits) {
            float sums[row];
            const float scale = shareOf(e);
            kernel.colored(hits, leaving.data(), 1, sums);
            if (last) {
                result[e] = scale * glm::vec3(sums[0], sums[1], sums[2]);
                return;
            }
            for (std::size_t i = 0; i < 3; ++i)
                next[e * row + i] = straight[e * row + i] + scale * sums[i];
        };
        if (!forEachElement(last ? elements.fronts() : elements.count(), gather, job))
            return bouncesCancelled();
        leaving.swap(next);
    }
    return result;
}

Result<std::vector<float>> BounceSolver::solve(std::span<const float> direct, int bounces,
                                               const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    const int order = m_hits->settings().order;
    const auto stride = static_cast<std::size_t>(order * order);
    CHECK_EQ(direct.size(), elements.fronts() * stride);
    std::vector<float> result(elements.fronts() * 3 * stride);
    Rows rows;

    // A few coefficients at a time: their rows of all elements stay in the cache, and what is
    // needed beside the result is small.
    const std::size_t groups =
        (stride + detail::kMaxGatherCoefficients - 1) / detail::kMaxGatherCoefficients;
    for (std::size_t group = 0; group < groups; ++group) {
        const std::size_t first = stride * group / groups;
        if (!solveGroup(direct, bounces, first, stride * (group + 1) / groups - first, rows, result,
                        job))
            return bouncesCancelled();
    }
    return result;
}

bool BounceSolver::solveGroup(std::span<const float> direct, int bounces, std::size_t first,
                              std::size_t count, Rows& rows, std::vector<float>& result,
                              const JobContext& job) const {
    const BounceElements& elements = m_hits->elements();
    const detail::BounceGather& kernel = detail::bounceGathers().front();
    const auto stride =
        static_cast<std::size_t>(m_hits->settings().order * m_hits->settings().order);

    // What comes straight from the environment has no colour yet: the first bounce reads one
    // number for each coefficient, not three.
    const std::size_t greyRow = detail::gatherRow(count);
    auto& straight = rows.straight;
    auto& leaving = rows.leaving;
    auto& next = rows.next;
    straight.resize(elements.count() * greyRow); // what pads the rows is never looked at
    parallelFor(job, elements.count(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e)
            for (std::size_t i = 0; i < count; ++i)
                straight[e * greyRow + i] =
                    e < elements.fronts()
                        ? direct[e * stride + first + i]
                        : m_hits->backTransfer()[(e - elements.fronts()) * stride + first + i];
    });

    const std::size_t row = detail::gatherRow(3 * count);
    for (int bounce = 1; bounce <= bounces; ++bounce) {
        const bool last = bounce == bounces; // which lights no other
        next.resize(elements.count() * row);
        const auto gather = [&](std::size_t e, std::span<const detail::GatherHit> hits) {
            float sums[detail::gatherRow(3 * detail::kMaxGatherCoefficients)];
            const float scale = shareOf(e);
            if (bounce == 1)
                kernel.grey(hits, straight.data(), count, sums);
            else
                kernel.colored(hits, leaving.data(), count, sums);
            if (last) {
                float* to = result.data() + (e * stride + first) * 3;
                for (std::size_t i = 0; i < 3 * count; ++i)
                    to[i] = scale * sums[i];
                return;
            }
            float* to = next.data() + e * row;
            const float* from = straight.data() + e * greyRow;
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t channel = 0; channel < 3; ++channel)
                    to[3 * i + channel] = from[i] + scale * sums[3 * i + channel];
        };
        if (!forEachElement(last ? elements.fronts() : elements.count(), gather, job))
            return false;
        leaving.swap(next);
    }
    return true;
}

std::size_t BounceSolver::memoryBytes() const {
    std::size_t bytes = m_hits->elements().memoryBytes();
    if (m_texels)
        for (const std::vector<std::uint32_t>& texels : *m_texels)
            bytes += texels.capacity() * sizeof(std::uint32_t);
    return bytes;
}

} // namespace patina
